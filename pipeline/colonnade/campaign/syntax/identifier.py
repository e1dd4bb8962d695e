"""Ids: names of tests, specimens, setups, recorders and channels that every file system can hold."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Annotated

from pydantic import BeforeValidator, WithJsonSchema

from colonnade.campaign.syntax.fields import shown

ID_PATTERN = r"^[A-Za-z0-9][A-Za-z0-9._-]*$"
_DEVICES = {"con", "prn", "aux", "nul", "conin$", "conout$"} | {
    f"{port}{n}" for port in ("com", "lpt") for n in range(10)
}
_LONGEST = 100


def identifier(value: object) -> str:
    """
    Take an id.

    Raises
    ------
    ValueError
        If it is not text, has characters that a file name may not have everywhere, or is a Windows device's name.
    """
    if not isinstance(value, str):
        raise ValueError(f'{shown(value)} was found. An id in quotes was expected, such as "free-01".')
    if not re.fullmatch(ID_PATTERN[1:-1], value):
        raise ValueError(
            f"{shown(value)} cannot be an id. Letters and digits without accents, '.', '_' and '-' were expected, "
            "the first a letter or digit."
        )
    if value.split(".")[0].casefold() in _DEVICES:
        raise ValueError(f"{shown(value)} is the name of a device on Windows. Choose another id.")
    if len(value) > _LONGEST:
        raise ValueError(
            f"An id of {len(value)} characters is too long for a file name. At most {_LONGEST} were expected."
        )
    return value


def clashes(ids: Iterable[str], *, as_variables: bool = False) -> list[tuple[int, str, str]]:
    """
    Find ids that a file system, or a results file, takes for the same.

    Parameters
    ----------
    ids : iterable of str
    as_variables : bool, optional
        Whether ``.``, ``-`` and ``_`` count as the same too, as in the name of a variable.

    Returns
    -------
    clashes : list of (int, str, str)
        Index of the later one, the later one, the earlier one.

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


Identifier = Annotated[str, BeforeValidator(identifier), WithJsonSchema({"type": "string", "pattern": ID_PATTERN})]
