"""The scripts of the report: our own as one file, and the plotting library's, copied from its installed wheel."""

from __future__ import annotations

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
        library = {address: (folder / Path(address).name).read_text(encoding="utf-8") for address in LIBRARY}
    except OSError as error:
        raise StoreError(
            f"{error.filename}: the report's plots need this script of the package bokeh. Install it again: "
            "`pip install --force-reinstall bokeh`."
        ) from error
    own = "".join((FOLDER / f"{name}.js").read_text(encoding="utf-8") for name in PARTS)
    return {**{address: _ended(text) for address, text in library.items()}, OWN: own}


def _ended(text: str) -> str:
    return text if text.endswith("\n") else text + "\n"
