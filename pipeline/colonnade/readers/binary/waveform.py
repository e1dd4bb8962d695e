"""Seismic waveforms of ten kinds, recognised by their first bytes, read by ObsPy: miniSEED, SAC, K-NET and others."""

from __future__ import annotations

import struct
import warnings
from collections.abc import Sequence
from datetime import UTC, datetime
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import Field

from colonnade.arrays import Array
from colonnade.errors import ReadError, nearest
from colonnade.readers.clock import even_times
from colonnade.readers.files import refusing
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import Head, from_head, head_of
from colonnade.readers.recording import RecordedChannel, Recording

READERS = {
    "GSE1": "obspy.io.gse2.core:_read_gse1",
    "GSE2": "obspy.io.gse2.core:_read_gse2",
    "KINEMETRICS_EVT": "obspy.io.kinemetrics.core:read_evt",
    "KNET": "obspy.io.nied.knet:_read_knet_ascii",
    "MSEED": "obspy.io.mseed.core:_read_mseed",
    "SAC": "obspy.io.sac.core:_read_sac",
    "SEG2": "obspy.io.seg2.seg2:_read_seg2",
    "SLIST": "obspy.io.ascii.core:_read_slist",
    "TSPAIR": "obspy.io.ascii.core:_read_tspair",
    "WAV": "obspy.io.wav.core:_read_wav",
}
"""ObsPy's functions by kind; none follows what a file says to another file, or runs what it holds."""
LONGEST_STEP = 1e5
"""Seconds; a header with a larger one is none of SAC's."""
STARTS = {
    b"Origin Time": "KNET",
    b"WID2 ": "GSE2",
    b"BEGIN GSE2": "GSE2",
    b"BEGIN IMS": "GSE2",
    b"WID1 ": "GSE1",
    b"XW01 ": "GSE1",
    b"\x55\x3a": "SEG2",
    b"\x3a\x55": "SEG2",
}
"""Kinds, as ObsPy names them, by what their files start with."""
UNITS = {"KNET": "m/s^2", "KINEMETRICS_EVT": "m/s^2"}
"""Units of kinds whose header gives the factor to them."""
LARGEST_GAP = 10.0
"""Gaps, as a multiple of what was recorded, that are still filled with missing values."""
ROUNDED = 1e-6
"""Relative difference to a rate of three decimals, in Hz, within which a step in single precision is meant to be it."""


class WaveformOptions(Options):
    """What can be said about a seismic file."""

    kind: str | None = Field(
        default=None, description='Its name in ObsPy, such as "SAC", if the first bytes do not show it.'
    )


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether the first bytes are those of a seismic format."""
    kind = kind_of_waveform(head)
    if kind is not None:
        return Recognition(True, f"its first bytes are those of {kind}")
    return Recognition(False, "its first bytes match no seismic format that is read")


def read(path: Path, options: WaveformOptions) -> Recording:
    """
    Read a seismic file with ObsPy.

    Each channel keeps its own clock; pieces of one channel are joined, with missing values in the gaps.

    Raises
    ------
    ReadError
        If the kind is not known, ObsPy cannot read it, or it holds no samples.
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


def kind_of_waveform(head: Head) -> str | None:
    """
    Name the kind of a seismic file.

    Returns
    -------
    kind : str or None
        As ObsPy calls it; None if the first bytes are none of those known here. Other kinds that ObsPy reads have
        no sign that separates them from text or noise.
    """
    first = head.content
    for start, kind in STARTS.items():
        if first.startswith(start):
            return kind
    if first.startswith(b"TIMESERIES "):
        first = first.split(b"\n", 1)[0]
        return next((kind for kind in ("SLIST", "TSPAIR") if kind.encode() in first), None)
    if first.startswith(b"RIFF") and first[8:12] == b"WAVE":
        return "WAV"
    for looks, kind in ((_is_mini_seed, "MSEED"), (_is_kinemetrics, "KINEMETRICS_EVT"), (_is_sac, "SAC")):
        if looks(first):
            return kind
    return None


def _is_mini_seed(head: bytes) -> bool:
    """Six digits or blanks, a letter for the kind of record, a blank; then a year, or the volume's first blockette."""
    if len(head) < 48 or not all(byte in b"0123456789 \0" for byte in head[:6]):
        return False
    if head[6:7] == b"V":
        return head[8:11] == b"010"
    years = (struct.unpack_from(order + "H", head, 20)[0] for order in "<>")
    return (
        head[6:7] in (b"D", b"R", b"Q", b"M")
        and head[7:8] in (b" ", b"\0")
        and any(1900 < year < 2200 for year in years)
    )


def _is_kinemetrics(head: bytes) -> bool:
    """A tag: K, byte order, then a file header (type 1) of one of two lengths."""
    if len(head) < 16 or head[:1] != b"K" or head[1] not in (0, 1):
        return False
    kind, length = struct.unpack_from((">" if head[1] else "<") + "LH", head, 4)
    return kind == 1 and length in (2040, 2736)


def _is_sac(head: bytes) -> bool:
    """Header version 6 or 7 at its place, with a step and a number of points that can be."""
    if len(head) < 632:
        return False
    for order in "<>":
        step = struct.unpack_from(order + "f", head)[0]
        version, points = struct.unpack_from(order + "i", head, 304)[0], struct.unpack_from(order + "i", head, 316)[0]
        if version in (6, 7) and 0 < step < LONGEST_STEP and points > 0:
            return True
    return False


def _kind(path: Path, options: WaveformOptions) -> str:
    kind = (options.kind or kind_of_waveform(head_of(path)) or "").upper()
    if not kind:
        raise ReadError(
            f'{path.name}: its first bytes do not show its format. Give it, for example kind = "SAC"; '
            f"{', '.join(READERS)} are read."
        )
    if kind not in READERS:
        convert = f'obspy.read("{path.name}", format="{kind}").write("{path.stem}.mseed")'
        advice = f" Convert the file to miniSEED, for example with ObsPy: {convert}." if kind != "PICKLE" else ""
        raise ReadError(f"{path.name}: ObsPy's format {kind} is not read here.{nearest(kind, READERS)}{advice}")
    return kind


def _stream(path: Path, kind: str) -> tuple[Any, list[str]]:
    """Have ObsPy read a file, and say what it warned of."""
    module, _, function = READERS[kind].partition(":")
    settings = {"round_sampling_interval": False} if kind == "SAC" else {}
    with refusing(path, kind), warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        # Not by obspy.read, which takes a name as a pattern, and would unpack an archive whatever its size.
        stream = getattr(import_module(module), function)(str(path.resolve()), **settings)
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
    summary="Seismic waveforms: miniSEED, SAC, K-NET, Kinemetrics, GSE1, GSE2, SEG-2, WAV, SLIST, TSPAIR.",
    suffixes=(".mseed", ".sac", ".evt", ".gse", ".sg2"),
    options=WaveformOptions,
    recognise=recognise,
    read=read,
    modules=(*sorted({reader.partition(":")[0] for reader in READERS.values()}), "numpy.ma"),
)
