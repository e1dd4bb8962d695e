"""The script from which an open page of the report learns that something changed; pages on disk cannot ask a server."""

from __future__ import annotations

import json
import time

from colonnade.errors import StoreError
from colonnade.store import files
from colonnade.store.layout import Layout

EVERY = 5.0
"""Seconds between two signs of life of the watch, when nothing else changes."""


def write_state(layout: Layout, *, is_watched: bool, shown: str = "", line: str = "") -> None:
    """
    Write the state script.

    Parameters
    ----------
    layout : Layout
    is_watched : bool
        Whether a watch goes on: pages ask again only then.
    shown : str, optional
        What the report shows: a page that was opened with another value loads itself again.
    line : str, optional
        The last line of the watch.
    """
    state = {"watched": is_watched, "written": round(time.time(), 1), "every": EVERY, "shown": shown, "line": line}
    text = json.dumps(state, ensure_ascii=True).replace("<", "\\u003c")
    try:
        files.write_text(layout.state, f"colonnadeState({text});\n")
    except StoreError:  # the watch goes on; a page that is open keeps what it shows
        return


def shown_now(layout: Layout) -> str:
    """Give a mark of what the report shows: that of its overview."""
    try:
        status = layout.report.stat()
    except OSError:
        return ""
    return f"{status.st_mtime_ns:x}-{status.st_size:x}"
