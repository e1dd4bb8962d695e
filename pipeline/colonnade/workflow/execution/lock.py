"""One run at a time in a campaign, by a lock of the operating system, which is freed even by a crash."""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from uuid import uuid4

from filelock import FileLock, Timeout

from colonnade.errors import RunEndedError, StoreError
from colonnade.store.files import remove, sweep, write_text
from colonnade.store.layout import Layout
from colonnade.store.own_files import own_files


@contextmanager
def only_run(layout: Layout) -> Iterator[str]:
    """
    Hold a campaign's lock, and remove what a killed run left half-written.

    Yields
    ------
    run_id : str
        Name of the run, by which other processes ask whether it still goes on (`expect_run`).

    Raises
    ------
    StoreError
        If another run holds it, or the folders of results cannot be written or lead elsewhere through a link.
    """
    for folder in _folders(layout):
        own_files(folder)
    try:
        if layout.lock.is_symlink():
            layout.lock.unlink()
        layout.processed.mkdir(parents=True, exist_ok=True)
        lock = FileLock(layout.lock)
        lock.acquire(timeout=0)
    except Timeout:
        raise StoreError(_held(layout)) from None
    except OSError as error:
        raise StoreError(
            f"{layout.processed}: results cannot be written here ({error.strerror or error}). A writable folder with "
            "free space was expected; free some space, or give another folder with --results."
        ) from error
    run_id = uuid4().hex
    after_a_kill = layout.lock_holder.exists()
    try:
        _sweep(layout)
        holder = {
            "run": run_id,
            "process": os.getpid(),
            "host": platform.node(),
            "since": datetime.now().astimezone().isoformat("T", "seconds"),
        }
        write_text(layout.lock_holder, json.dumps(holder) + "\n")
        yield run_id
    finally:
        try:
            remove(layout.lock_holder)
            if after_a_kill:  # its workers may have lived on for a moment
                _sweep(layout)
        finally:
            lock.release()


def expect_run(layout: Layout, run_id: str) -> None:
    """
    Check that a run still goes on: a worker of a cluster may outlive it, and its threads cannot be stopped.

    Raises
    ------
    RunEndedError
        If it has ended, or another has begun.
    """
    try:
        holder = json.loads(layout.lock_holder.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        holder = None
    if not isinstance(holder, dict) or holder.get("run") != run_id:
        raise RunEndedError(f"{layout.home}: the run that asked for this has ended; nothing more is written for it.")


def _folders(layout: Layout) -> tuple[Path, Path]:
    return layout.processed, layout.report.parent


def _sweep(layout: Layout) -> None:
    for folder in _folders(layout):
        sweep(folder)


def _held(layout: Layout) -> str:
    try:
        holder = json.loads(layout.lock_holder.read_text(encoding="utf-8"))
        who = f"process {holder['process']} on {holder['host']}, since {holder['since']}"
    except (OSError, ValueError, KeyError, TypeError):
        who = "another process"
    return (
        f"{layout.folder}: this campaign is already being run, by {who}. Wait for that run to end, or stop it: "
        "only one run at a time may write results."
    )
