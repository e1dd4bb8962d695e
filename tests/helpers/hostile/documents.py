"""Hostile text and workbooks."""

import pickle

from hostile.place import TIME, Hostile, Place, Program
from workbooks import ods, sheet_xml, xls, xlsx


def pickle_as_text(place):
    """A pickle by the name of a text file: runs a program."""
    path = place.folder / "r.csv"
    path.write_bytes(pickle.dumps(Program(place.victim), protocol=0))
    return Hostile(path)


def workbook_entity(place):
    """calamine: an entity that is another file, and one that swells."""
    spread = "".join(f'<!ENTITY e{n} "{f"&e{n - 1};" * 10}">' for n in range(1, 10))
    entities = f'<!DOCTYPE x [<!ENTITY s SYSTEM "{_secret(place)}"><!ENTITY e0 "1">{spread}]>'
    rows = sheet_xml([[n, "=→&s;&e9;"] for n in range(1, 50)])
    return Hostile(xlsx(place.folder / "r.xlsx", a=entities + rows))


def open_document_entity(place):
    """calamine, OpenDocument: an entity that is another file."""
    entity = f'<!DOCTYPE x [<!ENTITY s SYSTEM "{_secret(place)}">]>'
    return Hostile(ods(place.folder / "r.ods", [["&s;"]], head=entity))


def _secret(place: Place) -> str:
    return (place.secrets / "secret.txt").as_uri()


def workbook_of_97(place):
    """calamine, Excel 97: sound, to be damaged."""
    return Hostile(xls(place.folder / "r.xls", [[float(value), float(value) * 2] for value in TIME]))


def text_formulas(place):
    """pandas and own parsers of text: cells, names and units that are programs."""
    path = place.folder / "r.txt"
    program = f"__import__('os').mkdir('{place.victim}')"
    units = ["9**9**9**9", "m^9^9^9^9", "@" + str(place.secrets / "secret.txt")]
    rows = [f"{n};{n * 0.5};=1+1;{program if n == 20 else n}" for n in range(200)]
    path.write_text("\n".join([f"t [s];a [{units[0]}];b [{units[1]}];c [{units[2]}]", *rows, ""]), encoding="utf-8")
    return Hostile(path)
