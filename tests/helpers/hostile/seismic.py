"""Hostile files of seismology."""

from __future__ import annotations

import pickle
from pathlib import Path

from hostile.place import COUNTS, Hostile, Place, Program


def _seismic(path: Path, kind: str, folder: str, name: str) -> Hostile:
    shift = int(kind == "NNSA_KB_CORE")
    line = bytearray(b" " * (283 + 4 * shift))
    for start, text in (
        *((0, "TABLE"), (7, "ACC"), (16, f"{1366970100.0:17.5f}"), (61 + shift, f"{1366970101.0:17.5f}")),
        *((79 + shift, f"{100:8d}"), (88 + shift, f"{100.0:11.4f}"), (100 + shift, f"{1.0:16.6f}")),
        *((117 + shift, f"{1.0:16.6f}"), (143 + shift, "i4"), (148 + shift, folder), (213 + shift, name)),
        (246 + shift, f"{0:10d}"),
    ):
        line[start : start + len(text)] = text.encode()
    path.write_bytes(bytes(line) + b"\n")
    return Hostile(path, "waveform", {"kind": kind})


def css_above(place: Place) -> Hostile:
    """ObsPy, CSS: reads a file elsewhere."""
    return _seismic(place.folder / "r.wfdisc", "CSS", "../secrets", "secret")


def nnsa_above(place: Place) -> Hostile:
    """ObsPy, NNSA KB Core: reads a file elsewhere."""
    return _seismic(place.folder / "r.wf", "NNSA_KB_CORE", "../secrets", "secret")


def seismic_pickle(place: Place) -> Hostile:
    """ObsPy, PICKLE: runs a program."""
    path = place.folder / "r.pickle"
    path.write_bytes(pickle.dumps(Program(place.victim)))
    return Hostile(path, "waveform", {"kind": "PICKLE"})


def mini_seed(place: Place) -> Hostile:
    """ObsPy's library in C: sound, to be damaged."""
    import obspy

    path = place.folder / "r.mseed"
    header = {"station": "TABLE", "channel": "ACC", "delta": 0.01}
    obspy.Stream([obspy.Trace(COUNTS.astype("i4"), header)]).write(str(path), format="MSEED", encoding="STEIM2")
    return Hostile(path)


def gse(place: Place) -> Hostile:
    """ObsPy's other library in C: sound, to be damaged."""
    import obspy

    path = place.folder / "r.gse"
    header = {"station": "TABLE", "channel": "ACC", "delta": 0.01}
    obspy.Stream([obspy.Trace(COUNTS.astype("i4"), header)]).write(str(path), format="GSE2")
    return Hostile(path)
