"""One run at a time in a campaign, by a lock of the operating system, which is freed even by a crash."""

from __future__ import annotations

import os
import platform
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from uuid import uuid4

from filelock import FileLock, Timeout

from colonnade.errors import RunEndedError, StoreError
from colonnade.store.files import half_written, remove, write_text
from colonnade.store.layout import Layout

_RUNNING = "this campaign is already being run"


def is_refusal(said: str) -> bool:
    """Whether a message says that another run holds the campaign: the same may succeed later."""
    return _RUNNING in said


@contextmanager
def only_run(layout: Layout) -> Iterator[str]:
    """
    Hold a campaign's lock, and remove what a killed run left half-written.

    Yields
    ------
    run_id : str
        The name of the run, by which other processes ask whether it still goes on (`expect_run`).

    Raises
    ------
    StoreError
        If another run holds it, or the folders of results cannot be written or lead elsewhere through a link.
    """
    left = [*half_written(layout.processed), *half_written(layout.report.parent)]  # refuses a folder that is a link
    try:
        if layout.lock.is_symlink():
            layout.lock.unlink()
        layout.processed.mkdir(parents=True, exist_ok=True)
        lock = FileLock(layout.lock)
        lock.acquire(timeout=0)
    except Timeout:
        _, _, who = _said_by(layout.lock_holder).partition(" ")
        raise StoreError(
            f"{layout.folder}: {_RUNNING}, by {who or 'another process'}. Wait for that run to end, or stop it: only "
            "one run at a time may write results."
        ) from None
    except OSError as error:
        raise StoreError(
            f"{layout.processed}: results cannot be written here ({error.strerror or error}). A writable folder with "
            "free space was expected; free some space, or give another folder with --results."
        ) from error
    run_id = uuid4().hex
    try:
        _expect_own(layout)
        since = datetime.now().astimezone().isoformat("T", "seconds")
        write_text(layout.lock_holder, f"{run_id} process {os.getpid()} on {platform.node()}, since {since}\n")
        for each in left:
            remove(each)
        yield run_id
    finally:
        try:
            remove(layout.lock_holder)
        finally:
            lock.release()


def _expect_own(layout: Layout) -> None:
    """
    Refuse a folder of results of another campaign, if its file is still where it was; else note whose it is.

    A campaign in whose own folder they are is noted by the name of its file: a copy of the folder is a campaign too.
    """
    own = layout.folder / layout.file
    noted = layout.home / (_said_by(layout.owner) or own)
    if noted != own and noted.is_file():
        raise StoreError(
            f"{layout.home}: the results of another campaign, {noted}, are in this folder and would be overwritten. "
            "Give each campaign a folder of its own with --results."
        )
    write_text(layout.owner, f"{own if layout.results else own.name}\n")


def expect_run(layout: Layout, run_id: str) -> None:
    """
    Check that a run still goes on: a worker of a cluster may outlive it, and its threads cannot be stopped.

    Raises
    ------
    RunEndedError
        If it has ended, or another has begun.
    """
    if not _said_by(layout.lock_holder).startswith(run_id):
        raise RunEndedError(
            f"{layout.home}: the run that asked for this has ended, or {platform.node()} does not see this folder; "
            "nothing more is written for it. A cluster's workers share it, and the campaign's, under the same paths."
        )


def _said_by(note: Path) -> str:
    """Read a line of text; empty if it is not there."""
    try:
        return note.read_text(encoding="utf-8").strip()
    except (OSError, ValueError):
        return ""
