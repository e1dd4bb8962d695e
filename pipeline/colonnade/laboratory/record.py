"""The earthquake record that the virtual table plays."""

from __future__ import annotations

from pathlib import Path

from colonnade.dynamics.motion import Motion
from colonnade.errors import ReadError
from colonnade.readers.motion import EL_CENTRO, el_centro


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
