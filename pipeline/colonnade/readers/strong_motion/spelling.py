"""Units as the networks spell them: `CM/SEC/SEC`, `cm/sec2`."""

from __future__ import annotations

from colonnade import units
from colonnade.errors import UnitError


def spelled(unit: str) -> str:
    """
    Give a unit's usual spelling; one that is not known as it is, in lower case.

    Examples
    --------
    >>> [spelled(unit) for unit in ("CM/SEC/SEC", "cm/sec2", "G", "counts/volt")]
    ['cm/s^2', 'cm/s^2', 'g', 'count/V']
    """
    try:
        return units.normalise_unit(unit.casefold())
    except UnitError:
        return unit.casefold()
