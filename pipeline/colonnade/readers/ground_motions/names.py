"""What the names of files and columns say of a component: its direction, and the record that it is of."""

from __future__ import annotations

import re
from typing import NamedTuple


class Named(NamedTuple):
    """
    What a name says.

    Attributes
    ----------
    record : str
        The name without its direction.
    direction : str
        x, y or z; an azimuth in degrees, such as "180"; empty if it says none.
    """

    record: str
    direction: str


_DIRECTIONS = {
    **dict.fromkeys(("x", "ew", "e-w", "we", "e", "east", "h1", "lon", "long", "longitudinal", "l"), "x"),
    **dict.fromkeys(("y", "ns", "n-s", "sn", "n", "north", "h2", "tra", "tran", "trans", "transverse", "t"), "y"),
    **dict.fromkeys(("z", "ud", "u-d", "up", "v", "ver", "vert", "vertical", "dwn", "down"), "z"),
}
_WORDS = "|".join(sorted(map(re.escape, _DIRECTIONS), key=len, reverse=True))
_SEPARATED = re.compile(rf"(?P<record>.*[^A-Za-z])(?P<direction>{_WORDS})|(?P<alone>{_WORDS})", re.IGNORECASE)
"""`lefkada_x`, `I-ELC-UP`, `station 3 NS`."""
_CHANNEL = re.compile(r"(?P<record>(?:.*[-_. ])?[BCEHLMS][HLGNP])(?P<direction>[ENZ])(?P<rest>[-_. ].*|)")
"""Codes of seismic channels, `KRP.HNE`."""
_AZIMUTH = re.compile(r"(?P<record>.*[^0-9])(?P<direction>\d{3})")
"""PEER's `RSN6_IMPVALL.I_I-ELC180`."""
_SUFFIX = re.compile(r"(?P<record>.+)\.(?P<direction>EW|NS|UD)(?P<rest>[12]?)", re.IGNORECASE)
"""K-NET's `AOM0011903.EW`; with 1 or 2 KiK-net's, in the borehole and at the surface."""


def named(file_name: str) -> Named:
    """
    Read the name of a file.

    Examples
    --------
    >>> named("RSN6_I-ELC180.AT2"), named("RSN6_I-ELC-UP.AT2")
    (Named(record='RSN6_I-ELC', direction='180'), Named(record='RSN6_I-ELC', direction='z'))
    >>> named("AOM0011903.EW"), named("pulse.csv")
    (Named(record='AOM0011903', direction='x'), Named(record='pulse', direction=''))
    """
    if found := _SUFFIX.fullmatch(file_name):
        return Named(found["record"] + found["rest"], _DIRECTIONS[found["direction"].casefold()])
    stem, _, suffix = file_name.rpartition(".")
    stem = stem or suffix
    direction, record = direction_of(stem)
    if direction:
        return Named(record or stem, direction)
    if suffix.casefold() == "at2" and (azimuth := _AZIMUTH.fullmatch(stem)):
        return Named(azimuth["record"].rstrip("-_. "), azimuth["direction"])
    return Named(stem, "")


def direction_of(text: str) -> tuple[str, str]:
    """Return the direction in a name, x, y, z or empty, and the rest of the name."""
    bare = re.sub(r"\s*[\[(][^\])]*[\])]\s*$", "", text).strip()
    if found := _SEPARATED.fullmatch(bare):
        word = found["direction"] or found["alone"]
        return _DIRECTIONS[word.casefold()], (found["record"] or "").rstrip("-_. ")
    if found := _CHANNEL.fullmatch(bare):
        direction = {"E": "x", "N": "y", "Z": "z"}[found["direction"]]
        return direction, found["record"] + found["rest"]
    return "", bare
