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
    import obspy

    path = place.folder / "r.mseed"
    header = {"station": "TABLE", "channel": "ACC", "delta": 0.01}
    obspy.Stream([obspy.Trace(COUNTS.astype("i4"), header)]).write(str(path), format="MSEED", encoding="STEIM2")
    return Hostile(path)
