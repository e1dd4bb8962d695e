"""A set of ground motions, a folder or a list of files of any format, as records of up to three components."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from colonnade.dynamics.motion import Motion
from colonnade.errors import ColonnadeError, ReadError
from colonnade.readers.files import in_one_line
from colonnade.readers.ground_motions.files import Component, LeftOut, components_of, in_folder, read_list
from colonnade.readers.registry import companions

MOST_FILES = 2000
MOST_SAMPLES = 20_000_000
"""Of all motions of a set together: 160 MB."""
SAME_STEP = 1e-3
"""Largest difference of the steps of the components of a record, as a share."""


@dataclass(frozen=True)
class GroundMotion:
    """
    A record.

    Attributes
    ----------
    name : str
    motion : Motion
        m/s², with the files' own signs: `acceleration` is the first horizontal component, `transverse` the second.
    components : tuple of str
        What the components are called, in the order acceleration, transverse, vertical of those that are there: x, y,
        z, or an azimuth; empty if nothing says it.
    files : tuple of (str, str)
        Name of each file, and its SHA-256.
    magnitude, distance : float or None
        Of the earthquake; m.
    """

    name: str
    motion: Motion
    components: tuple[str, ...]
    files: tuple[tuple[str, str], ...]
    magnitude: float | None = None
    distance: float | None = None


@dataclass(frozen=True)
class RecordSet:
    """
    Ground motions, what was left out of them, and what else is to be said.

    Attributes
    ----------
    records : tuple of GroundMotion
        By name.
    left_out : tuple of LeftOut
        Files, rows and records, each with the reason.
    notes : tuple of str
    """

    records: tuple[GroundMotion, ...]
    left_out: tuple[LeftOut, ...]
    notes: tuple[str, ...]


def files_of(path: Path) -> list[Path]:
    """
    List the files of a set of ground motions: the list itself, and the other files that a record is in, too.

    Raises
    ------
    ReadError
        If there is no such folder or list, or the list is none.
    """
    if path.is_dir():
        return [entry.path for entry in in_folder(path)[0]]
    listed = [path, *(entry.path for entry in read_list(path)[0])]
    for each in listed[1:]:
        with suppress(ReadError, OSError):
            listed += companions(each)
    return list(dict.fromkeys(listed))


def read_record_set(path: Path | str) -> RecordSet:
    """
    Read a set of ground motions.

    Parameters
    ----------
    path : Path or str
        A folder, whose files of any format are read, or a CSV list, see `files.read_list`. In a folder the names of
        the files, or of their columns, say which belong together: `lefkada_x`, `I-ELC180`, `AOM001.EW`, `KRP.HNE`.

    Returns
    -------
    records : RecordSet
        What cannot be used is left out, by name and with its reason; the rest is not affected.

    Raises
    ------
    ReadError
        If there is no such folder or list, the list is none, or it has more than `MOST_FILES` files.

    Notes
    -----
    Components of a record are cut to the shortest of them. Of a record without a direction in its name, its one
    component is taken as the first horizontal one.
    """
    path = Path(path)
    entries, left_out, notes = in_folder(path) if path.is_dir() else read_list(path)
    if len(entries) > MOST_FILES:
        raise ReadError(f"{path.name}: {len(entries)} files are too many; a set of at most {MOST_FILES} was expected.")
    grouped: dict[str, list[Component]] = {}
    samples = 0
    for entry in entries:
        try:
            found = list(components_of(entry, notes)) if samples <= MOST_SAMPLES else []
            samples += sum(component.motion.acceleration.size for component in found)
            if samples > MOST_SAMPLES:
                raise ReadError(f"with it the set has more than {MOST_SAMPLES:.3g} samples. Divide the set.")
            for component in found:
                grouped.setdefault(component.entry.record, []).append(component)
        except (ColonnadeError, ValueError, OSError, MemoryError) as error:
            said = str(error) if isinstance(error, (ColonnadeError, ValueError)) else in_one_line(error)
            left_out.append(LeftOut(entry.place, said))
    records = []
    for name, members in grouped.items():
        try:
            records.append(_joined(name, members, left_out, notes))
        except ReadError as error:
            left_out.append(LeftOut(name, str(error)))
    return RecordSet(tuple(sorted(records, key=lambda record: record.name)), tuple(left_out), tuple(notes))


def _joined(name: str, members: list[Component], left_out: list[LeftOut], notes: list[str]) -> GroundMotion:
    """Make a record of its components."""
    vertical: list[Component] = []
    horizontal: list[Component] = []
    for member in sorted(members, key=lambda each: each.entry.component):
        kept = vertical if member.entry.component == "z" else horizontal
        if any(other.entry.component == member.entry.component for other in kept) or len(kept) == 2:
            left_out.append(
                LeftOut(member.entry.place, f'record "{name}" has this component already. Give it a name of its own.')
            )
            continue
        kept.append(member)
    if not horizontal:
        raise ReadError("it has no horizontal component; one is needed for a column to rock.")
    used = [*horizontal, *vertical]
    step = used[0].motion.dt
    for member in used[1:]:
        if abs(member.motion.dt - step) > SAME_STEP * step:
            raise ReadError(
                f"the steps of its components differ ({step:.6g} s and {member.motion.dt:.6g} s). Resample one of them."
            )
    shortest = min(member.motion.acceleration.size for member in used)
    if any(member.motion.acceleration.size > shortest for member in used):
        notes.append(f'Record "{name}": its components differ in length; all are cut to {shortest * step:.4g} s.')
    along = [member.motion.acceleration[:shortest] for member in used]
    motion = Motion(along[0], step, along[-1] if vertical else None, along[1] if len(horizontal) == 2 else None)
    magnitude, distance = (
        next((value for member in used if (value := getattr(member.entry, key)) is not None), None)
        for key in ("magnitude", "distance")
    )
    files = tuple(dict.fromkeys(file for member in used for file in member.files))
    return GroundMotion(name, motion, tuple(member.entry.component for member in used), files, magnitude, distance)
