"""What columns and tests are, by units and names: keys with the reason of each guess, and what is asked."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from colonnade import units
from colonnade.campaign.channel import MAIN, Channel
from colonnade.campaign.draft.survey import Column
from colonnade.campaign.draft.words import AXES, asked, axis, comment, find, line, plain, unique
from colonnade.campaign.setup import Marker
from colonnade.campaign.syntax.table import purpose
from colonnade.campaign.test import Test

# What readers say themselves: a column that has no name, a block of a file.
_NUMBERED = re.compile(r"^(?:column \d+$|block \d+: )")
# A separate word: "usp000hzq8" is not a frequency.
_FREQUENCY = re.compile(r"(?<![\d.,])(\d{1,6}(?:[.,p]\d{1,6})?)[ _-]?hz(?![a-z0-9])")
_MARKER = re.compile(r"(.+?)[ _.:-]*([xyz])", re.IGNORECASE)

_USUAL_PLACE = {None: "?", "acceleration": "table", "velocity": "table"}


@dataclass(frozen=True)
class Meaning:
    """What a column measures, None where nothing shows it, and on what; and what shows each."""

    column: Column
    recorder: str
    quantity: str | None
    because: str
    place: str
    place_word: str
    axis: str | None


def meaning(column: Column, recorder: str = MAIN) -> Meaning | str:
    """Find out what a column is, from its unit, else from its name; or why it is not a channel."""
    name, unit = _NUMBERED.sub("", column.name), column.unit or ""
    by_unit = next((each for each, dim in units.QUANTITY_DIMENSIONS.items() if dim and units.is_of(unit, dim)), None)
    by_name, word = find(name, "quantities") or (None, "")
    other = find(name, "left_out")
    if column.is_clock:
        return "the clock"
    if column.spread <= 0.0:
        return f"{'it never changes' if column.spread == 0.0 else 'it holds no number'} in any of these files"
    if by_unit is None and by_name is None and other:
        return f"{other[0]}, {_from(other[1])}"
    quantity = by_unit or by_name
    because = f'from its unit "{unit}"' if by_unit else _from(word)
    place, place_word = find(name, "places") or (_USUAL_PLACE.get(quantity, "specimen"), "")
    return Meaning(column, recorder, quantity, because, place, _from(place_word), axis(column.name))


def _from(word: str) -> str:
    return f'from "{word}" in its name' if word else ""


def draft_channels(recorders: Mapping[str, Sequence[Column]]) -> tuple[dict[str, Meaning], dict[str, list[str]]]:
    """Draft the channels of the columns of each recorder, by id; and the headings of the others by the reason."""
    found = [(column, meaning(column, recorder)) for recorder, columns in recorders.items() for column in columns]
    known = any(isinstance(each, Meaning) and each.quantity is not None for _, each in found)
    taken: list[Meaning] = []
    left_out: defaultdict[str, list[str]] = defaultdict(list)
    for column, each in found:
        if isinstance(each, str):
            left_out[each].append(column.heading)
        elif each.quantity is None and known:
            left_out["neither its unit nor its name shows what it measures"].append(column.heading)
        else:
            taken.append(each)
    ids = unique((each.column.name for each in taken), "channel", as_variables=True)
    return dict(zip(ids, taken, strict=True)), left_out


def markers_of(channels: Iterable[Meaning]) -> dict[str, list[Meaning]]:
    """Find markers of an optical system, by id: three displacements whose names differ in a last x, y and z alone."""
    alike: defaultdict[tuple[str, str, str | None], dict[str, Meaning]] = defaultdict(dict)
    for each in channels:
        found = _MARKER.fullmatch(each.column.name.strip())
        is_length = units.is_of(each.column.unit or "", "length")
        if found and each.quantity == "displacement" and is_length and each.place != "table":
            alike[each.recorder, found[1], each.column.unit][found[2].casefold()] = each
    whole = {name: [axes[axis] for axis in AXES] for (_, name, _), axes in alike.items() if len(axes) == len(AXES)}
    return dict(zip(unique(whole, "marker", as_variables=True), whole.values(), strict=True))


def marker_lines(marker: Sequence[Meaning], others: Sequence[Column]) -> Iterator[str]:
    """Give the lines of a marker's keys; `others` are the columns of its recorder."""
    yield line("columns", [_named(each.column, others) for each in marker])
    yield from _recorder_and_unit(marker[0])
    yield asked(Marker, "on", "?")
    yield asked(Marker, "at", ["? mm", "? mm", "? mm"])


def _named(column: Column, others: Sequence[Column]) -> str | int:
    """Give what a column is called in the draft: its name where that is its own, else its number."""
    alone = column.name.strip() and [other.name for other in others].count(column.name) == 1
    return column.name if alone else column.number


def channel_lines(each: Meaning, others: Sequence[Column]) -> Iterator[str]:
    """Give the lines of a channel's keys; `others` are the columns of its recorder."""
    quantity = each.quantity
    yield line("column", _named(each.column, others))
    yield line("quantity", quantity, each.because) if quantity else asked(Channel, "quantity", "?")
    yield from _recorder_and_unit(each)
    if quantity == "force":
        return
    yield line("on", each.place, each.place_word) if each.place_word else asked(Channel, "on", each.place)
    if each.place == "specimen" and quantity == "displacement":
        yield asked(Channel, "at", ["? mm", "0 mm", "? mm"])
        yield asked(Channel, "relative_to", "?")
    direction = AXES[each.axis or ("y" if quantity in ("angle", "angular_velocity") else "x")]
    question = f"of a positive reading; {[-part or 0 for part in direction]} if it is reversed"
    yield line("direction", direction, "from its name" if each.axis else "", question)


def _recorder_and_unit(each: Meaning) -> Iterator[str]:
    if each.recorder != MAIN:
        yield line("recorder", each.recorder)
    unit, dimension = each.column.unit or "", units.QUANTITY_DIMENSIONS[each.quantity or "other"]
    usual, found = units.DIMENSIONS[dimension or "length"][1], units.find_unit(unit) if unit else None
    if found is None:
        given = f'"{unit}", which is not a known unit' if unit else "no unit"
        question = f'the file gives {given}: write one such as "{usual}", or "V" with a line gain = "10 {usual}/V"'
        yield line("unit", "?", question=question)
        return
    yield line("unit", unit, "as in the file")
    if dimension is not None and not units.is_of(unit, dimension):
        below = f"({found.symbol})" if {"/", " "} & set(found.symbol) else found.symbol
        yield line("gain", f"? {usual}/{below}", question="from its calibration sheet")


def kind_lines(name: str) -> Iterator[str]:
    """Guess the kind of a test, and its frequency, from the name of its file."""
    found = _FREQUENCY.search(plain(name))
    frequency = float(re.sub("[,p]", ".", found[1])) if found else 0.0
    kind, word = find(name, "kinds") or (("sine", f"{frequency:g} Hz") if frequency else ("other", ""))
    doubt = f'its name does not show {purpose(Test, "kind").rstrip(".")}; "other" has no prediction'
    yield line("kind", kind, _from(word), "" if word else doubt)
    if kind in ("sine", "pulse") and frequency:
        yield line("frequency", f"{frequency:g} Hz", "from its name")
    elif kind == "earthquake":
        yield comment('motion = "El Centro 1940 NS", span = 2.0      what the table was given, and how strongly')
