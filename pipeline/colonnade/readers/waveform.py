"""Seismic waveforms in all formats that ObsPy reads: miniSEED, SAC, K-NET, Kinemetrics, GSE2 and others."""

from __future__ import annotations

import glob
import warnings
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from colonnade.errors import ReadError, nearest
from colonnade.readers.clock import even_times
from colonnade.readers.recording import Array, RecordedChannel, Recording
from colonnade.readers.registry import Format, Recognition
from colonnade.readers.waveform_companions import companions_of
from colonnade.readers.waveform_kinds import kind_of_waveform

UNITS = {"KNET": "m/s^2", "KINEMETRICS_EVT": "m/s^2"}
"""Units of kinds whose header gives the factor to them."""
UNSAFE = frozenset({"PICKLE"})
"""Kinds that can run code as they are read."""
LARGEST_GAP = 10.0
"""Gaps, as a multiple of what was recorded, that are still filled with missing values."""
ROUNDED = 1e-6
"""Relative difference to a rate of three decimals, in Hz, within which a step in single precision is meant to be it."""


class WaveformOptions(BaseModel):
    """What can be said about a seismic file."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    kind: str | None = Field(
        default=None, description='As ObsPy calls it, such as "SEGY" or "CSS", where the first bytes do not tell it.'
    )


def recognise(path: Path) -> Recognition:
    """Say whether the first bytes are those of a seismic format."""
    kind = kind_of_waveform(path)
    if kind is not None:
        return Recognition(True, f"its first bytes are those of {kind}")
    return Recognition(False, "its first bytes are those of no seismic format (others of ObsPy's need `kind`)")


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
    companions_of(path, kind)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        stream = _stream(path, kind)
    told = list(dict.fromkeys(f"ObsPy: {' '.join(str(warning.message).split())}" for warning in caught))
    told = [text for text in told if "eprecat" not in text]
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
        notes += [note] if note not in notes and note else []
        told += found
        if kind in UNITS:
            values = values * float(traces[0].stats.calib)
        channels.append(RecordedChannel(name, UNITS.get(kind), values, time))
        calibration = float(traces[0].stats.calib)
        if kind not in UNITS and calibration != 1.0:
            notes.append(f'"{name}": the header gives a calibration of {calibration:g}, which is not applied')
    start = _start(origin)
    if start is None:
        notes.append("the file tells no date: times count from its earliest sample")
    return Recording(path, "waveform", tuple(channels), start, tuple(notes), tuple(told))


def companions(path: Path, options: WaveformOptions) -> tuple[str, ...]:
    """Names of the files with the samples, where the kind has them in files of their own."""
    return companions_of(path, _kind(path, options))


def _kind(path: Path, options: WaveformOptions) -> str:
    from obspy.core.util.base import ENTRY_POINTS

    known = [kind for kind in ENTRY_POINTS["waveform"] if kind not in UNSAFE]
    kind = (options.kind or kind_of_waveform(path) or "").upper()
    if not kind:
        raise ReadError(
            f'{path.name}: its first bytes do not tell its kind. Say it, for example kind = "SEGY". '
            f"ObsPy knows {', '.join(known)}."
        )
    if kind not in known:
        raise ReadError(f'{path.name}: ObsPy has no kind "{kind}" that is safe to read.{nearest(kind, known)}')
    return kind


def _stream(path: Path, kind: str) -> Any:
    import obspy

    settings = {"round_sampling_interval": False} if kind == "SAC" else {}
    try:
        # The name is taken as a pattern, and an archive would be unpacked whatever its size.
        return obspy.read(glob.escape(str(path.resolve())), format=kind, check_compression=False, **settings)
    except MemoryError:
        raise
    except Exception as error:
        said = " ".join(str(error).split())[:200]
        raise ReadError(
            f"{path.name}: ObsPy cannot read it as {kind} ({type(error).__name__}: {said}). The file was cut off or is "
            "damaged; copy it from the recorder again."
        ) from error


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
    rates_differ = any(abs(trace.stats.delta / traces[0].stats.delta - 1) > ROUNDED for trace in traces)
    if rates_differ or total > (1 + LARGEST_GAP) * sum(sizes):
        time = np.concatenate([even_times(size, step, begin) for begin, size in zip(begins, sizes, strict=True)])
        told.append(f'"{name}": its {len(traces)} pieces differ in rate or lie far apart; the gaps are not filled')
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
        told.append(f'"{name}": its pieces overlap by {overlaps} samples; the earlier ones are taken')
    late = max(abs(begin - begins[0] - place * step) for begin, place in zip(begins, places, strict=True))
    if late > 0.1 * step:
        told.append(f'"{name}": a piece lies {late:g} s beside the steps of the first one')
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
    companions=companions,
    modules=("obspy",),
    package="obspy",
    extra="seismic",
)
