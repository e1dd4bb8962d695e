"""Names that every file system can hold: ids, and paths inside the folder of the campaign file."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

from pydantic import BeforeValidator, WithJsonSchema

from colonnade.campaign.syntax.fields import shown
from colonnade.readers import files

ID_PATTERN = r"^[A-Za-z0-9][A-Za-z0-9._-]*$"
_DEVICES = {"con", "prn", "aux", "nul", "conin$", "conout$"} | {
    f"{port}{n}" for port in ("com", "lpt") for n in range(10)
}
_LONGEST = 100
_EXAMPLE = 'A path from the folder of the campaign file was expected, such as "raw/free-01.csv"'


def identifier(value: object) -> str:
    """Take an id; ValueError if it is no text, or a file cannot have that name everywhere."""
    if not isinstance(value, str):
        raise ValueError(f'{shown(value)} was found. An id in quotes was expected, such as "free-01".')
    if not re.fullmatch(ID_PATTERN[1:-1], value):
        raise ValueError(
            f"{shown(value)} cannot be an id. Letters and digits without accents, '.', '_' and '-' were expected, "
            "the first a letter or digit."
        )
    if value.split(".")[0].casefold() in _DEVICES or len(value) > _LONGEST:
        raise ValueError(
            f"{shown(value)} cannot be a file name everywhere: it has more than {_LONGEST} characters, or is a device "
            "on Windows. Choose another id."
        )
    return value


def clashes(ids: Iterable[str], *, as_variables: bool = False) -> list[tuple[int, str, str]]:
    """
    Find ids that a file system takes for the same, or a results file: as variables ``.``, ``-`` and ``_`` are the same.

    Of each clash the index of the later one, the later one and the earlier one.

    Examples
    --------
    >>> clashes(["a-1", "A-1", "a_1"])
    [(1, 'A-1', 'a-1')]
    """
    seen: dict[str, str] = {}
    found = []
    for index, name in enumerate(ids):
        same = folded(name, as_variables=as_variables)
        if same in seen:
            found.append((index, name, seen[same]))
        seen.setdefault(same, name)
    return found


def folded(name: str, *, as_variables: bool = False) -> str:
    """Reduce an id to what has to differ from other ids'; see `clashes`."""
    plain = name.casefold().rstrip(".")
    return re.sub(r"[.-]", "_", plain) if as_variables else plain


def inside(folder: Path, value: object) -> Path:
    """
    Make a path of the campaign file absolute, from its resolved folder; the file itself need not exist.

    Raises
    ------
    ValueError
        If it is not a relative path, or leaves the folder, be it through a link.
    """
    if not isinstance(value, str) or not value.strip():
        raise ValueError(f"{shown(value)} was found. {_EXAMPLE}.")
    if "\\" in value:
        raise ValueError(f"{shown(value)} has a backslash. {_EXAMPLE}, with / between folders on every system.")
    try:
        return files.inside(folder, value, "the campaign's folder")
    except ValueError as error:
        raise ValueError(f"{error} {_EXAMPLE}.") from None


Identifier = Annotated[str, BeforeValidator(identifier), WithJsonSchema({"type": "string", "pattern": ID_PATTERN})]
