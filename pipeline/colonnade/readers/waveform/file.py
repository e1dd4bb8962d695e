"""Seismic waveforms in all formats that ObsPy reads: miniSEED, SAC, K-NET, Kinemetrics, GSE2 and others."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import Field

from colonnade.arrays import Array
from colonnade.errors import ReadError, nearest
from colonnade.readers.clock import even_times
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.recording import RecordedChannel, Recording
from colonnade.readers.refusal import refusing
from colonnade.readers.waveform.kinds import kind_of_waveform

UNITS = {"KNET": "m/s^2", "KINEMETRICS_EVT": "m/s^2"}
"""Units of kinds whose header gives the factor to them."""
LARGEST_GAP = 10.0
"""Gaps, as a multiple of what was recorded, that are still filled with missing values."""
ROUNDED = 1e-6
"""Relative difference to a rate of three decimals, in Hz, within which a step in single precision is meant to be it."""


class WaveformOptions(Options):
    """What can be said about a seismic file."""

    kind: str | None = Field(
        default=None, description='Its name in ObsPy, such as "SEGY" or "AH", if the first bytes do not show it.'
    )


def recognise(path: Path) -> Recognition:
    """Say whether the first bytes are those of a seismic format."""
    kind = kind_of_waveform(path)
    if kind is not None:
        return Recognition(True, f"its first bytes are those of {kind}")
    return Recognition(False, "its first bytes match no seismic format (ObsPy's other formats need `kind`)")


def read(path: Path, options: WaveformOptions) -> Recording:
    """
    Read a seismic file with ObsPy.

    Each channel keeps its own clock; pieces of one channel are joined, with missing values in the gaps.

    Raises
    ------
    ReadError
        If ObsPy does not know the kind or cannot read it, or it holds no samples.
    """
    path.stat()  # ObsPy has no message of its own for a file that is not there
    kind = _kind(path, options)
    stream, told = _stream(path, kind)
    grouped: dict[str, list[Any]] = {}
    for trace in stream:
        if trace.stats.npts:
            grouped.setdefault(trace.id.strip("."), []).append(trace)
    if not grouped:
        raise ReadError(f"{path.name}: ObsPy finds no samples in it as {kind}.")
    origin = min(trace.stats.starttime for traces in grouped.values() for trace in traces)
    channels, notes = [], [f"{kind}, read by ObsPy"]
    for name, traces in grouped.items():
        traces.sort(key=lambda trace: trace.stats.starttime)
        step, note = _step(traces, kind)
        time, values, found = _joined(name, traces, step, origin)
        calibration = float(traces[0].stats.calib)
        if kind in UNITS:
            values = values * calibration
        channels.append(RecordedChannel(name, UNITS.get(kind), values, time))
        told += found
        notes += [note] if note else []
        if kind not in UNITS and calibration != 1.0:
            notes.append(f'"{name}": the header gives a calibration of {calibration:g}, which is not applied')
    start = _start(origin)
    if start is None:
        notes.append("the file gives no date: times count from its earliest sample")
    return Recording(path, "waveform", tuple(channels), start, tuple(dict.fromkeys(notes)), tuple(told))


def _kind(path: Path, options: WaveformOptions) -> str:
    from colonnade.readers.waveform.plugins import IN_OTHER_FILES, KINDS

    kind = (options.kind or kind_of_waveform(path) or "").upper()
    if not kind:
        raise ReadError(
            f'{path.name}: its first bytes do not show its format. Give it, for example kind = "SEGY". '
            f"ObsPy knows {', '.join(KINDS)}."
        )
    if kind in IN_OTHER_FILES:
        raise ReadError(
            f"{path.name}: {kind} has its samples in other files and is not read here. Convert it to miniSEED, for "
            f'example with ObsPy: obspy.read("{path.name}", format="{kind}").write("{path.stem}.mseed").'
        )
    if kind not in KINDS:
        raise ReadError(f'{path.name}: ObsPy has no format "{kind}" that is safe to read.{nearest(kind, KINDS)}')
    return kind


def _stream(path: Path, kind: str) -> tuple[Any, list[str]]:
    """Have ObsPy read a file, and say what it warned of."""
    from colonnade.readers.waveform.plugins import reader_of

    settings = {"round_sampling_interval": False} if kind == "SAC" else {}
    with refusing(path, kind), warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        # Not by obspy.read, which takes a name as a pattern, and would unpack an archive whatever its size.
        stream = reader_of(kind)(str(path.resolve()), **settings)
    told = dict.fromkeys(f"ObsPy: {' '.join(str(warning.message).split())}" for warning in caught)
    return stream, [text for text in told if "eprecat" not in text]


def _step(traces: Sequence[Any], kind: str) -> tuple[float, str]:
    """Time step of a channel, s, and what was mended of it."""
    step = float(traces[0].stats.delta)
    if kind != "SAC":
        return step, ""
    # A step in single precision: 1/2048 s is exact in it, 1/100 s is not.
    rate = round(1 / step, 3)
    if rate > 0 and abs(step * rate - 1) < ROUNDED:
        return 1 / rate, f"step {1 / rate:.10g} s: {rate:g} Hz, which the header's single precision allows"
    return step, f"step {step:.10g} s, in the header's single precision"


def _joined(name: str, traces: Sequence[Any], step: float, origin: Any) -> tuple[Array, Array, list[str]]:
    """Join the pieces of one channel, on a clock from the recording's first sample on."""
    begins = [float(trace.stats.starttime - origin) for trace in traces]
    pieces = [np.ma.filled(np.ma.asarray(trace.data, dtype=np.float64), np.nan) for trace in traces]
    told = []
    places = [round((begin - begins[0]) / step) for begin in begins]
    sizes = [piece.size for piece in pieces]
    total = max(place + size for place, size in zip(places, sizes, strict=True))
    steps = [float(trace.stats.delta) for trace in traces]
    rates_differ = any(abs(each / steps[0] - 1) > ROUNDED for each in steps)
    if rates_differ or total > (1 + LARGEST_GAP) * sum(sizes):
        time = np.concatenate([even_times(*each) for each in zip(sizes, steps, begins, strict=True)])
        rates = " and ".join(f"{1 / each:.6g} Hz" for each in dict.fromkeys(steps))
        what = f"have rates of {rates}; each has its own times" if rates_differ else "are far apart"
        told.append(f'"{name}": its {len(traces)} pieces {what}; the gaps are not filled')
        return time, np.concatenate(pieces), told
    values = np.full(total, np.nan)
    overlaps = 0
    for place, piece in zip(places, pieces, strict=True):
        part = values[place : place + piece.size]
        overlaps += int(np.isfinite(part).sum())
        part[:] = np.where(np.isfinite(part), part, piece)
    if missing := int(np.isnan(values).sum()):
        told.append(
            f'"{name}": {len(traces)} pieces with gaps of {missing} samples ({missing * step:g} s) in all; missing'
        )
    if overlaps:
        told.append(f'"{name}": its pieces overlap by {overlaps} samples; the earlier ones are used')
    late = max(abs(begin - begins[0] - place * step) for begin, place in zip(begins, places, strict=True))
    if late > 0.1 * step:
        told.append(f'"{name}": a piece is {late:g} s off the steps of the first one')
    return even_times(total, step, begins[0]), values, told


def _start(origin: Any) -> datetime | None:
    """Date and time of the first sample; none where ObsPy has put 1970 in its place."""
    moment: datetime = origin.datetime
    return None if moment.year <= 1970 else moment.replace(tzinfo=UTC)


FORMAT = Format(
    name="waveform",
    summary="Seismic waveforms of all kinds that ObsPy reads: miniSEED, SAC, K-NET, Kinemetrics, GSE2 …",
    suffixes=(".mseed", ".sac", ".evt", ".gse", ".sg2"),
    options=WaveformOptions,
    recognise=recognise,
    read=read,
    modules=("colonnade.readers.waveform.plugins", "numpy.ma"),
)
