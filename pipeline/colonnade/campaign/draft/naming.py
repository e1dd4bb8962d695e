"""Unique ids from the names of files and columns, valid in every file system."""

from __future__ import annotations

import re
from collections.abc import Iterable

from colonnade.campaign.draft.vocabulary import plain
from colonnade.campaign.syntax.identifier import folded, identifier


def unique(names: Iterable[str], otherwise: str, *, as_variables: bool = False) -> list[str]:
    """
    Make ids that differ.

    Parameters
    ----------
    names : iterable of str
    otherwise : str
        What a name becomes if none of its letters and digits can be kept.
    as_variables : bool, optional
        Whether ids that differ in ``.``, ``-`` and ``_`` alone count as the same.

    Examples
    --------
    >>> unique(["span 2.0", "Span 2.0", "con", "°"], "test")
    ['span-2.0', 'Span-2.0-2', 'con-test', 'test']
    """
    ids: dict[str, str] = {}
    for name in names:
        made = as_id(name, otherwise)
        number, candidate = 1, made
        while folded(candidate, as_variables=as_variables) in ids:
            number += 1
            candidate = f"{made}-{number}"
        ids[folded(candidate, as_variables=as_variables)] = candidate
    return list(ids.values())


def as_id(name: str, otherwise: str) -> str:
    """
    Make an id of a name.

    Examples
    --------
    >>> as_id("El Centro (Süd)", "test"), as_id("__", "test")
    ('El-Centro-Sud', 'test')
    """
    kept = "".join(sign if sign.isascii() else plain(sign) for sign in name)
    made = re.sub(r"[^A-Za-z0-9._]+", "-", kept).strip("-._")[:80] or otherwise
    try:
        return identifier(made)
    except ValueError:
        return f"{made.replace('.', '-')}-{otherwise}"
