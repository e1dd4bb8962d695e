"""Who is told of a watch: a command, which gets each line as JSON on its stdin, and the open pages of the report."""

from __future__ import annotations

import json
import shlex
import subprocess
import time
from collections.abc import Mapping, Sequence
from typing import Any

from colonnade.errors import CampaignError, StoreError
from colonnade.report.interactive.state import state_script
from colonnade.store import files
from colonnade.store.layout import Layout

PATIENCE = 10.0
"""Seconds after which the command is ended."""


def command_of(text: str) -> list[str]:
    """
    Split a command into program and arguments; no shell reads it.

    Raises
    ------
    CampaignError
        If it is empty or a quote is not closed.

    Examples
    --------
    >>> command_of("notify-send 'A test'")
    ['notify-send', 'A test']
    """
    try:
        parts = shlex.split(text)
    except ValueError as error:
        raise CampaignError(f"--notify {text!r}: this is not a command ({error}).") from None
    if not parts:
        raise CampaignError("--notify: it is empty. A program and its arguments were expected.")
    return parts


def notify(command: Sequence[str], line: Mapping[str, Any]) -> str:
    """Give a line to a command, and wait for it; return what went wrong, empty if nothing did."""
    try:
        done = subprocess.run(
            command,
            input=json.dumps(line, ensure_ascii=False),
            encoding="utf-8",
            errors="replace",
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            timeout=PATIENCE,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return f"{command[0]} was ended: it took longer than {PATIENCE:g} s."
    except OSError as error:
        return f"{command[0]} could not be started ({error.strerror or error})."
    if done.returncode:
        said = (done.stderr or "").strip().splitlines()
        return f"{command[0]} ended with {done.returncode}{f': {said[-1][:200]}' if said else ''}."
    return ""


def write_state(
    layout: Layout, *, is_watched: bool, shown: str = "", line: str = "", line_written: float = 0.0
) -> None:
    """Write the state script, see `state_script`, as a sign of life of now."""
    text = state_script(is_watched=is_watched, written=time.time(), shown=shown, line=line, line_written=line_written)
    try:
        files.write_text(layout.state, text)
    except StoreError:  # the watch goes on; a page that is open keeps what it shows
        return


def shown_now(layout: Layout) -> str:
    """
    Give a mark of what the report shows: that of its overview.

    The overview is the last page that is written, so the mark changes when all pages are there.
    """
    try:
        status = layout.report.stat()
    except OSError:
        return ""
    return f"{status.st_mtime_ns:x}-{status.st_size:x}"
