"""The scripts of the report: our own as one file, the plotting library's from its wheel, and the state script."""

from __future__ import annotations

import json
from importlib.util import find_spec
from pathlib import Path

from colonnade.errors import StoreError
from colonnade.report.addresses import LIBRARY, OWN

PARTS = ("samples", "kept", "panel", "moving", "downloads", "page", "overview", "watched")
"""Our scripts in the order in which they are joined: what a later one uses is in an earlier one."""

FOLDER = Path(__file__).parents[1] / "scripts"


def scripts() -> dict[str, str]:
    """
    Return the text of each script by its address in the report.

    Raises
    ------
    StoreError
        If the plotting library is not installed as it should be.
    """
    found = find_spec("bokeh")
    folder = Path(*(found.submodule_search_locations or [""])[:1] if found else "") / "server" / "static" / "js"
    try:
        library = {address: (folder / Path(address).name).read_text(encoding="utf-8") + "\n" for address in LIBRARY}
    except OSError as error:
        raise StoreError(
            f"{error.filename}: the report's plots need this script of the package bokeh. Install it again: "
            "`pip install --force-reinstall bokeh`."
        ) from error
    own = "".join((FOLDER / f"{name}.js").read_text(encoding="utf-8") for name in PARTS)
    return library | {OWN: own}


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
