"""What open pages of the report learn of the watch: that it goes on, its last line, and that the report changed."""

from __future__ import annotations

import time

from colonnade.errors import StoreError
from colonnade.report.interactive.state import state_script
from colonnade.store import files
from colonnade.store.layout import Layout


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
