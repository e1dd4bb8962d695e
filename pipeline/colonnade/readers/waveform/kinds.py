"""The seismic format of a file by its first bytes, without ObsPy."""

from __future__ import annotations

import struct
from pathlib import Path

HEAD = 640
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
RECOGNISED = frozenset(STARTS.values()) | {"SLIST", "TSPAIR", "WAV", "MSEED", "KINEMETRICS_EVT", "SAC"}
"""All that `kind_of_waveform` names."""


def kind_of_waveform(path: Path) -> str | None:
    """
    Name the kind of a seismic file.

    Returns
    -------
    kind : str or None
        As ObsPy calls it; None if the first bytes are none of those known here. Other kinds that ObsPy reads have
        no sign that separates them from text or noise.
    """
    with path.open("rb") as stream:
        head = stream.read(HEAD)
    for start, kind in STARTS.items():
        if head.startswith(start):
            return kind
    if head.startswith(b"TIMESERIES "):
        first = head.split(b"\n", 1)[0]
        return next((kind for kind in ("SLIST", "TSPAIR") if kind.encode() in first), None)
    if head.startswith(b"RIFF") and head[8:12] == b"WAVE":
        return "WAV"
    for looks, kind in ((_is_mini_seed, "MSEED"), (_is_kinemetrics, "KINEMETRICS_EVT"), (_is_sac, "SAC")):
        if looks(head):
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
