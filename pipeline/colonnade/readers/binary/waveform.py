"""Seismic waveforms of ten kinds, recognised by their first bytes, read by ObsPy: miniSEED, SAC, K-NET and others."""

from __future__ import annotations

import re
import struct
import warnings
from datetime import UTC
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from colonnade.errors import ReadError
from colonnade.readers.clock import even_times
from colonnade.readers.files import refusing
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.head import Head, from_head
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
    "KNET": rb"Origin Time",
    "GSE1": rb"WID1 |XW01 ",
    "GSE2": rb"WID2 |BEGIN GSE2|BEGIN IMS",
    "SEG2": rb"\x55\x3a|\x3a\x55",
    "SLIST": rb"TIMESERIES [^\n]*SLIST",
    "TSPAIR": rb"TIMESERIES [^\n]*TSPAIR",
    "WAV": rb"RIFF.{4}WAVE",
    # A number of six digits or blanks, a letter for the kind of record, a blank; then a year of two bytes, or the
    # volume's first blockette.
    "MSEED": rb"[0-9 \0]{6}(?:[DRQM][ \0].{12}(?:[\x07\x08].|.[\x07\x08]).{26}|V.010.{36})",
    # A tag: K, byte order, then a file header (type 1) of one of two lengths.
    "KINEMETRICS_EVT": rb"K(?:\x01..\0\0\0\x01(?:\x07\xf8|\x0a\xb0)|\0..\x01\0\0\0(?:\xf8\x07|\xb0\x0a)).{6}",
}
"""What files of a kind, as ObsPy names it, start with; of SAC a few numbers of the header can be looked at."""
IN_METRES = ("KNET", "KINEMETRICS_EVT")
"""Kinds whose header gives the factor to m/s²."""


@from_head
def recognise(head: Head) -> Recognition:
    """Say whether the first bytes are those of a seismic format."""
    kind = kind_of_waveform(head)
    if kind is not None:
        return Recognition(True, f"its first bytes are those of {kind}")
    return Recognition(
        False, f"its first bytes are not those of {', '.join(READERS)}; convert other seismic files to miniSEED"
    )


def read(path: Path, options: Options) -> Recording:
    """
    Read a seismic file with ObsPy; ReadError if it cannot read it, or it holds no samples.

    Each channel keeps its own clock, and each piece of a channel its own times: gaps are not filled.
    """
    kind = kind_of_waveform(recognise.expected(path)) or ""
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
        pieces = [np.ma.filled(np.ma.asarray(trace.data, dtype=np.float64), np.nan) for trace in traces]
        values = np.concatenate(pieces)
        times = [
            even_times(trace.stats.npts, _step(trace, kind), float(trace.stats.starttime - origin)) for trace in traces
        ]
        if len(pieces) > 1:
            notes.append(f'"{name}": {len(pieces)} pieces, each with its own times; gaps are not filled')
        calibration = float(traces[0].stats.calib)
        if kind in IN_METRES:
            values = values * calibration
        elif calibration != 1.0:
            notes.append(f'"{name}": the header gives a calibration of {calibration:g}, which is not applied')
        unit = "m/s^2" if kind in IN_METRES else None
        channels.append(RecordedChannel(name, unit, values, np.concatenate(times)))
    # What ObsPy puts in the place of a date that is not known is in 1970.
    start = origin.datetime.replace(tzinfo=UTC) if origin.year > 1970 else None
    return Recording(path, "waveform", tuple(channels), start, tuple(notes), tuple(told))


def _step(trace: Any, kind: str) -> float:
    """Sampling interval; the one of SAC is in single precision, in which 1/100 s is 0.01 to as many digits."""
    return float(str(np.float32(trace.stats.delta))) if kind == "SAC" else float(trace.stats.delta)


def kind_of_waveform(head: Head) -> str | None:
    """Name the kind of a seismic file as ObsPy calls it; None if its first bytes are none of those known here."""
    known = (kind for kind, start in STARTS.items() if re.match(start, head.content, re.DOTALL))
    return next(known, "SAC" if _is_sac(head.content) else None)


def _is_sac(head: bytes) -> bool:
    """Header version 6 or 7 at its place, with a step and a number of points that can be."""
    if len(head) < 632:
        return False
    numbers = (struct.unpack_from(order + "f300xi8xi", head) for order in "<>")
    return any(version in (6, 7) and 0 < step < LONGEST_STEP and points > 0 for step, version, points in numbers)


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


FORMAT = Format(
    name="waveform",
    summary="Seismic waveforms: miniSEED, SAC, K-NET, Kinemetrics, GSE1, GSE2, SEG-2, WAV, SLIST, TSPAIR.",
    suffixes=(".mseed", ".sac", ".evt", ".gse", ".sg2"),
    recognise=recognise,
    read=read,
    modules=(*sorted({reader.partition(":")[0] for reader in READERS.values()}), "numpy.ma"),
)
