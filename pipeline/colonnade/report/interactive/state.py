"""The state script: pages on disk cannot ask a server, but they can load a script again while somebody watches."""

from __future__ import annotations

import json

EVERY = 5.0
"""Seconds between two signs of life of a watch, when nothing else changes."""


def state_script(
    *, is_watched: bool, written: float = 0.0, shown: str = "", line: str = "", line_written: float = 0.0
) -> str:
    """
    Return the text of the state script.

    Parameters
    ----------
    is_watched : bool
        Whether a watch goes on: open pages load the script again only then.
    written : float, optional
        When the watch gave this sign of life, s since 1970; 0 in a report that was never watched.
    shown : str, optional
        A mark of what the report shows: a page that was opened with another loads itself again.
    line : str, optional
        The last line of the watch.
    line_written : float, optional
        When it said that, s since 1970.

    Returns
    -------
    text : str
        A call of the function `colonnadeState` of the report's own script.

    Examples
    --------
    >>> state_script(is_watched=True, written=1.7e9, line="free-01: rocking").partition('"every"')[0]
    'colonnadeState({"watched": true, "written": 1700000000.0, '
    """
    state = {
        "watched": is_watched,
        "written": round(written, 1),
        "every": EVERY,
        "shown": shown,
        "line": line,
        "line_written": round(line_written, 1),
    }
    return f"colonnadeState({json.dumps(state)});\n".replace("<", "\\u003c")


UNWATCHED = state_script(is_watched=False)
"""The script of a report that nobody watches."""
