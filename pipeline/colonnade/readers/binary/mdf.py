"""ASAM MDF measurement data (.mdf, .mf4), read by asammdf."""

from __future__ import annotations

from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.readers.binary.magic import by_mark
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.recording import RecordedChannel, Recording

SIGNATURES = (b"MDF     ", b"UnFinMF ")
"""First bytes of a file that was closed, and of one that was not."""
MASTER_CHANNELS = (2, 3)
"""Kinds of channels that hold the times of their group: recorded and virtual."""
REMOTE_MASTER = 1 << 3
"""Flag of a group of version 4 that has the clock of another one."""

RANGES_TO_NUMBERS, RANGES_TO_BLOCKS = 6, 8
"""Kinds of conversions of version 4 that tell whole numbers from others: only of them a range holds its upper end."""
KNOWN_OF_4 = frozenset(range(12))
KNOWN_OF_3 = frozenset((0, 1, 2, *range(6, 13), 65535))
"""Kinds of conversions; 65535 is none."""


class NoNumbersError(ValueError):
    """A channel or conversion that gives no numbers; its text is the reason."""


class NotComputedError(NoNumbersError):
    """A conversion that might give numbers, but is not computed."""


def recognise(path: Path) -> Recognition:
    """Say whether the first bytes are those of an MDF file."""
    return by_mark(path, SIGNATURES, '"MDF" or "UnFinMF", the marks of ASAM MDF')


def read(path: Path, options: Options) -> Recording:
    """Read an MDF file; each group of channels keeps its own clock."""
    with path.open("rb") as stream:
        finished = stream.read(8) == SIGNATURES[0]
        stream.seek(0)
        recording, texts = _content(path, stream)
    warnings = [] if finished else ["the recorder did not close the file: its end may be missing"]
    warnings += [f'"{name}" is left out: {reason}' for name, reason in recording.left_out] + list(recording.warnings)
    notes = (f"no numbers in {', '.join(texts[:8])}: left out",) if texts else ()
    return replace(recording, notes=recording.notes + notes, warnings=tuple(warnings))


def _content(path: Path, stream: Any) -> tuple[Recording, list[str]]:
    """Read all channels of numbers from their raw values, and name those without numbers."""
    channels: list[RecordedChannel] = []
    texts: list[str] = []
    left_out: list[tuple[str, str]] = []
    warnings: list[str] = []
    # A stream, since a file that it is given by name it may unpack, or take away.
    with _asammdf().MDF(stream, process_bus_logging=False) as file:
        raw = _RawFile(file)
        for group_number, group in enumerate(file.groups):
            try:
                time = raw.clock(group_number)
            except NoNumbersError as reason:
                time = None
                warnings.append(f"the clock of group {group_number + 1} is left out: {reason}; give the sampling rate")
            for number, channel in enumerate(group.channels):
                if channel.channel_type in MASTER_CHANNELS or (not raw.is_version_4 and channel.channel_type == 1):
                    continue
                try:
                    values = raw.values(group_number, number)
                except NotComputedError as reason:
                    left_out.append((channel.name, str(reason)))
                    continue
                except NoNumbersError:
                    texts.append(f'"{channel.name}"')
                    continue
                channels.append(
                    RecordedChannel(
                        channel.name,
                        raw.unit(group_number, number),
                        values,
                        time if time is not None and time.size == values.size else None,
                        heading=f"{channel.name} (group {group_number + 1})",
                    )
                )
        notes = (f"MDF {file.version}, read by asammdf", "clock: each group's own master channel")
        start, told = file.start_time, tuple(warnings)
        return Recording(path, "mdf", tuple(channels), start, notes, told, left_out=tuple(left_out)), texts


def _asammdf() -> Any:
    """asammdf for reading alone: it cannot evaluate a formula or write a file."""
    import asammdf
    from asammdf.blocks import mdf_v3, mdf_v4, v2_v3_blocks, v4_blocks

    replaced = {"evaluate": _never, "lambdify": None, "NamedTemporaryFile": lambda *rest, **settings: BytesIO()}
    for module in (mdf_v3, mdf_v4, v2_v3_blocks, v4_blocks):
        for name in replaced.keys() & vars(module).keys():
            setattr(module, name, replaced[name])
    return asammdf


def _never(*rest: Any, **settings: Any) -> Any:
    raise TypeError("a formula in text is never evaluated")  # after which asammdf computes its own ones with NumPy


class _RawFile:
    """A file without its conversions, so that asammdf gives raw values, also of the clocks; they are kept here."""

    def __init__(self, file: Any) -> None:
        self._file = file
        self.is_version_4 = str(file.version) >= "4"
        self._conversions: dict[tuple[int, int], Any] = {}
        for group_number, group in enumerate(file.groups):
            for number, channel in enumerate(group.channels):
                self._conversions[group_number, number] = channel.conversion
                channel.conversion = None

    def clock(self, group_number: int) -> Array:
        """Times of a group; NoNumbersError if they cannot be computed."""
        owner = group_number
        # A group may take the clock of another one; a chain of more groups than there are is a circle.
        for _ in self._file.groups if self.is_version_4 else ():
            described = self._file.groups[owner].channel_group
            if not described.flags & REMOTE_MASTER:
                break
            owner = int(described.cg_master_index)
        else:
            if self.is_version_4:
                raise ValueError("the clocks of its groups refer to one another in a circle")
        raw = np.asarray(self._file.get_master(group_number))
        return self._converted(raw, owner, self._file.masters_db.get(owner, -1))

    def values(self, group_number: int, number: int) -> Array:
        """Physical values of a channel; NoNumbersError where it holds text or arrays."""
        samples, invalid = self._file.get(group=group_number, index=number, samples_only=True, raw=True)
        raw = np.asarray(samples)
        if raw.dtype.kind not in "biuf" or raw.ndim != 1 or not raw.size:
            raise NoNumbersError("no numbers")
        values = self._converted(raw, group_number, number)
        if invalid is not None:
            values[np.asarray(invalid, dtype=bool)] = np.nan
        return values

    def unit(self, group_number: int, number: int) -> str | None:
        """Unit of a channel, of its conversion or its own."""
        conversion, channel = self._conversions[group_number, number], self._file.groups[group_number].channels[number]
        return (conversion is not None and conversion.unit) or getattr(channel, "unit", "") or None

    def _converted(self, raw: NDArray[Any], group_number: int, number: int) -> Array:
        """
        Physical values of raw ones, as asammdf computes them; NaN where the conversion has no finite number.

        Raises
        ------
        NoNumbersError
            If the conversion gives text only; NotComputedError if it is a formula in text, which is never evaluated:
            what can compute any formula can do other things too.
        """
        conversion = self._conversions.get((group_number, number))
        if conversion is None:
            values = raw.astype(np.float64)
        else:
            kind = int(conversion.conversion_type)
            if kind not in (KNOWN_OF_4 if self.is_version_4 else KNOWN_OF_3):
                raise NotComputedError(f"its conversion is of kind {kind}, which is not read")
            if (formula := _formula(conversion)) is not None:
                shown = formula if len(formula) <= 40 else formula[:40] + "…"
                raise NotComputedError(f'its conversion is a formula in text ("{shown}"), which is never evaluated')
            values = _computed(raw, conversion, kind if self.is_version_4 else -1)
        values[~np.isfinite(values)] = np.nan
        return values


def _computed(raw: NDArray[Any], conversion: Any, kind: int) -> Array:
    is_whole = raw.dtype.kind != "f"
    if kind == RANGES_TO_NUMBERS and is_whole:  # asammdf 8.8 gives the default for all but the upper end of a range
        values = np.full(raw.size, float(conversion.default))
        for n in reversed(range((conversion.val_param_nr - 1) // 3)):
            inside = (raw >= conversion[f"lower_{n}"]) & (raw <= conversion[f"upper_{n}"])
            values[inside] = conversion[f"phys_{n}"]
        return values
    try:
        with np.errstate(all="ignore"):
            # Wide numbers, as a square may be computed of them.
            wide = raw.astype(np.int64 if kind == RANGES_TO_BLOCKS and is_whole else np.float64)
            given = np.asarray(conversion.convert(wide))
    except MemoryError:
        raise
    except Exception as error:
        raise NotComputedError(f"its conversion cannot be computed ({error})") from error
    numbers = (
        [np.nan if isinstance(each, (bytes, str)) else each for each in given] if given.dtype.kind == "O" else given
    )
    if given.dtype.kind in "SU" or (given.dtype.kind == "O" and np.isnan(numbers).all()):
        raise NoNumbersError("its values are text labels")
    return np.asarray(numbers, dtype=np.float64)


def _formula(conversion: Any) -> str | None:
    """The formula in text of a conversion, or of one that it refers to."""
    if formula := getattr(conversion, "formula", None):
        return " ".join(str(formula).split())
    referenced = (getattr(conversion, "referenced_blocks", None) or {}).values()
    inner = (_formula(each) for each in referenced if not isinstance(each, bytes) and each is not None)
    return next((formula for formula in inner if formula is not None), None)


FORMAT = Format(
    name="mdf",
    summary="ASAM MDF measurement data, versions 2 to 4.",
    suffixes=(".mdf", ".mf4", ".dat"),
    recognise=recognise,
    read=read,
    modules=("asammdf",),
)
