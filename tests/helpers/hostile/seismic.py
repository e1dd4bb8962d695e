"""Hostile files of seismology."""

import pickle

from hostile.place import COUNTS, Hostile, Program


def seismic_pickle(place):
    """ObsPy, PICKLE: runs a program."""
    path = place.folder / "r.pickle"
    path.write_bytes(pickle.dumps(Program(place.victim)))
    return Hostile(path, "waveform")


def mini_seed(place):
    """ObsPy's library in C: sound, to be damaged."""
    return _recorded(place.folder / "r.mseed", format="MSEED", encoding="STEIM2")


def gse(place):
    """ObsPy's other library in C: sound, to be damaged."""
    return _recorded(place.folder / "r.gse", format="GSE2")


def _recorded(path, **how):
    import obspy

    header = {"station": "TABLE", "channel": "ACC", "delta": 0.01}
    obspy.Stream([obspy.Trace(COUNTS.astype("i4"), header)]).write(str(path), **how)
    return Hostile(path)
