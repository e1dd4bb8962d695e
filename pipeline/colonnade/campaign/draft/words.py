"""Names of columns and files: what their words mean, ids made of them; and the lines of a draft."""

from __future__ import annotations

import re
import tomllib
import unicodedata
from collections.abc import Iterable
from pathlib import Path

from colonnade.campaign.syntax.document import toml_value
from colonnade.campaign.syntax.fields import one_line
from colonnade.campaign.syntax.names import folded, identifier
from colonnade.campaign.syntax.table import Table, purpose

WORDS: dict[str, dict[str, str]] = tomllib.loads(Path(__file__).with_name("words.toml").read_text(encoding="utf-8"))
"""Words in the names of columns and files, by what they are about and what they mean."""

AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}

_LATIN = "a v g d e z i th i k l m n x o p r s s t y f ch ps o"
_GREEK = dict(zip("αβγδεζηθικλμνξοπρσςτυφχψω", _LATIN.split(" "), strict=True))


def line(key: str, value: object, reason: str = "", question: str = "") -> str:
    """Write one key of the draft: a person has to replace a "?" in its value and to check what is in question."""
    said = f"? {question}{reason and f' ({reason})'}" if question else reason
    written = toml_value(value).replace("# ?", r"\u0023 ?")  # no name of a file or column looks like a question
    return f"{key} = {written}" + (f"    # {one_line(said)}" if said else "")


def asked(table: type[Table], key: str, value: object, reason: str = "") -> str:
    """Ask for a key by what its model says of it."""
    return line(key, value, reason, purpose(table, key).rstrip("."))


def comment(text: str) -> str:
    """Write a line of comment."""
    return f"# {one_line(text)}"


def plain(name: str) -> str:
    """
    Write a name in small Latin letters.

    Examples
    --------
    >>> plain("Säule"), plain("Επιτάχυνση")
    ('saule', 'epitachynsi')
    """
    folded = unicodedata.normalize("NFKD", name.replace("ß", "ss")).casefold()
    return "".join(_GREEK.get(sign, sign) for sign in folded if not unicodedata.combining(sign))


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


def find(name: str, about: str) -> tuple[str, str] | None:
    """
    Find the first meaning that a part of a name has in a table of words.toml; and that part.

    Examples
    --------
    >>> find("LVDT 2", "quantities"), find("Voltage_27", "quantities"), find("Tischweg", "places")
    (('displacement', 'lvdt'), None, ('table', 'tischweg'))
    """
    parts = words(name)
    for meaning, known in WORDS[about].items():
        for part in parts:
            if any(_is_in(part, word) for word in known.split()):
                return meaning, part
    return None


def _is_in(part: str, word: str) -> bool:
    if len(word) >= 5:
        return word in part
    if len(word) == 4:
        return part.startswith(word) or part.endswith(word)
    plural = len(part) == len(word) + 1 and part.startswith(word) and part[-1] in (*AXES, "s")
    return part == word or plural


def axis(name: str) -> str | None:
    """
    Find the axis in a column's name.

    Examples
    --------
    >>> axis("ACC_X"), axis("AccZ 2"), axis("Table vertical"), axis("LVDT 1")
    ('x', 'z', 'z', None)
    """
    before = {"", "a", "u", *" ".join(WORDS["quantities"].values()).split()}
    meant = find(name, "axes")
    return next((part[-1] for part in words(name) if part[-1] in AXES and part[:-1] in before), meant and meant[0])


def unique(names: Iterable[str], otherwise: str, *, as_variables: bool = False) -> list[str]:
    """
    Make ids that differ: `otherwise` where nothing of a name can be kept; as variables of a-z, 0-9 and _ alone.

    Examples
    --------
    >>> unique(["span 2.0", "Span 2.0", "con", "°"], "test")
    ['span-2.0', 'Span-2.0-2', 'con-test', 'test']
    """
    ids: dict[str, str] = {}
    for name in names:
        made = as_id("_".join(re.findall("[a-z0-9]+", plain(name))) if as_variables else name, otherwise)
        number, candidate = 1, made
        while folded(candidate, as_variables=as_variables) in ids:
            number += 1
            candidate = f"{made}-{number}"
        ids[folded(candidate, as_variables=as_variables)] = candidate
    return list(ids.values())


def as_id(name: str, otherwise: str) -> str:
    """
    Make an id of a name.

    Examples
    --------
    >>> as_id("El Centro (Süd)", "test"), as_id("__", "test")
    ('El-Centro-Sud', 'test')
    """
    kept = "".join(sign if sign.isascii() else plain(sign) for sign in name)
    made = re.sub(r"[^A-Za-z0-9._]+", "-", kept).strip("-._")[:80] or otherwise
    try:
        return identifier(made)
    except ValueError:
        return f"{made.replace('.', '-')}-{otherwise}"
