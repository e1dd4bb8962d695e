"""Words that laboratories use in the names of columns and files, in several languages."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping

_LATIN = "a v g d e z i th i k l m n x o p r s s t y f ch ps o"
GREEK = dict(zip("αβγδεζηθικλμνξοπρσςτυφχψω", _LATIN.split(" "), strict=True))

# A word of five letters or more may stand anywhere in a part of a name, one of four at its beginning or end; a shorter
# one is the whole of it, or all but an axis or a plural's s.
QUANTITIES: dict[str, tuple[str, ...]] = {
    "angular_velocity": ("gyro", "omega", "angularvel", "winkelgeschw", "drehrate"),
    "angle": ("incl", "angle", "neigung", "winkel", "angolo", "gonia", "rotation"),
    "displacement": (
        *("lvdt", "dcdt", "disp", "dis", "weg", "laser", "verschieb", "spost", "deplac", "desplaz", "metatop"),
        *("stringpot", "seilzug", "wire", "stroke", "hub", "posit", "pos", "act", "actuator", "potent", "bewegung"),
    ),
    "acceleration": ("acc", "accel", "besch", "epitach", "acel", "accelero"),
    "velocity": ("vel", "velo", "speed", "geschw", "taxyt", "vitesse"),
    "force": ("force", "load", "kraft", "forza", "loadcell", "dynam", "dynami"),
}
"""Quantity: words in the names of columns that record it."""

PLACES: dict[str, tuple[str, ...]] = {
    "table": (
        *("table", "shak", "tisch", "ruett", "rutt", "tavol", "trapez", "mesa", "plate", "platf", "platt"),
        *("act", "actuator", "piston", "zylinderweg", "base", "foundation", "sockel"),
    ),
    "specimen": (
        *("block", "speci", "column", "col", "saule", "saeule", "colonna", "stil", "korper", "koerper", "probe"),
        *("pruf", "drum", "statue", "top", "bottom", "oben", "unten", "alto", "basso", "sopra", "sotto", "pano"),
        *("kato", "kopf", "tip", "prism", "cylind", "cone", "rocking", "corpo", "blocco"),
    ),
    "ground": ("ground", "floor", "boden", "edafos", "suolo", "terreno"),
}
"""What a transducer is on: words that say so."""

LEFT_OUT: dict[str, tuple[str, ...]] = {
    "a synchronisation signal": ("sync", "trig", "led", "light", "photo", "marker", "event", "licht"),
    "a running number": ("index", "sample", "scan", "row", "count", "counter", "nr", "no", "number", "nummer"),
    "a command to the table, not a measurement": (
        *("output", "command", "cmd", "soll", "drive", "setpoint", "demand", "target", "generator"),
    ),
    "a temperature": ("temp", "temperatur", "thermo"),
    "a supply": ("supply", "battery", "batt", "excit", "speisung"),
}
"""What is not a measurement of the motion: words that say so."""

KINDS: dict[str, tuple[str, ...]] = {
    "free-vibration": ("free", "frei", "libera", "release", "snap", "decay", "elefther", "eleuth", "loslassen", "fv"),
    "pulse": ("pulse", "puls", "ricker", "impuls", "impulso"),
    "sine": ("sine", "sin", "sinus", "sinew", "harmonic", "harm", "sinu", "armonic"),
    "noise": ("noise", "random", "white", "rausch", "rumore", "whitenoise"),
    "tilt": ("tilt", "slowtilt", "kipp", "inclin"),
    "earthquake": (
        *("earthquake", "earthq", "eq", "quake", "erdbeben", "sisma", "sism", "seism", "span", "centro", "elcentro"),
        *("kobe", "northridge", "taft", "aegion", "aigio", "kalamata", "lefkada", "tohoku", "chichi", "loma", "prieta"),
    ),
}
"""Kind of test: words in the names of its files."""

MOTIONS: dict[str, tuple[str, ...]] = {
    "El Centro": ("centro",),
    "Kobe": ("kobe",),
    "Northridge": ("northridge",),
    "Taft": ("taft",),
    "Aegion": ("aegion", "aigio"),
    "Kalamata": ("kalamata",),
    "Lefkada": ("lefkada",),
    "Tohoku": ("tohoku",),
    "Chi-Chi": ("chichi",),
    "Loma Prieta": ("loma",),
}
"""Earthquakes that files are named after."""

SHAPES: dict[str, tuple[str, ...]] = {
    "prism": ("prism", "prisma"),
    "cylinder": ("cylind", "zylind", "cilind", "kylind"),
    "cone": ("cone", "kegel", "cono", "konos"),
}
"""Shapes of specimens that files are named after."""

_SHORT_ENDINGS = ("weg", "acc")  # as in Tischweg, tableacc

AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}


def plain(name: str) -> str:
    """
    Write a name in small Latin letters.

    Examples
    --------
    >>> plain("Säule"), plain("Επιτάχυνση")
    ('saule', 'epitachynsi')
    """
    folded = unicodedata.normalize("NFKD", name.replace("ß", "ss")).casefold()
    return "".join(GREEK.get(sign, sign) for sign in folded if not unicodedata.combining(sign))


def words(name: str) -> list[str]:
    """
    Split a name into its parts, in small Latin letters, without numbers.

    Examples
    --------
    >>> words("ACC_X1"), words("tableAccel"), words("Weg 1 oben")
    (['acc', 'x'], ['table', 'accel'], ['weg', 'oben'])
    """
    spaced = re.sub(r"(?<=[a-zα-ω])(?=[A-ZΑ-Ω])", " ", unicodedata.normalize("NFC", name))
    return re.findall(r"[a-z]+", plain(spaced))


def find(parts: Iterable[str], meanings: Mapping[str, tuple[str, ...]]) -> tuple[str, str] | None:
    """
    Find the first meaning that a part of a name has.

    Returns
    -------
    found : (str, str) or None
        The meaning and the part of the name that has it.

    Examples
    --------
    >>> find(words("LVDT 2"), QUANTITIES), find(words("Voltage_27"), QUANTITIES)
    (('displacement', 'lvdt'), None)
    >>> find(words("Tischweg"), QUANTITIES), find(words("Tischweg"), PLACES)
    (('displacement', 'tischweg'), ('table', 'tischweg'))
    """
    parts = list(parts)
    for meaning, beginnings in meanings.items():
        for part in parts:
            if any(_is_in(part, beginning) for beginning in beginnings):
                return meaning, part
    return None


def axis(name: str) -> str | None:
    """
    Find the axis in a column's name.

    Examples
    --------
    >>> axis("ACC_X"), axis("AccZ 2"), axis("LVDT 1")
    ('x', 'z', None)
    """
    for part in words(name):
        if part in AXES:
            return part
        if part[-1] in AXES and any(part[:-1] == word for group in QUANTITIES.values() for word in (*group, "a", "u")):
            return part[-1]
    return None


def _is_in(part: str, word: str) -> bool:
    if len(word) >= 5:
        return word in part
    if len(word) == 4:
        return part.startswith(word) or part.endswith(word)
    plural = len(part) == len(word) + 1 and part.startswith(word) and part[-1] in (*AXES, "s")
    return part == word or plural or (word in _SHORT_ENDINGS and part.endswith(word))
