"""Channels of a drafted setup: for each column what it measures, why, and what has to be asked."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from colonnade import units
from colonnade.campaign.channel import MAIN
from colonnade.campaign.draft.lines import Line, comment, value
from colonnade.campaign.draft.meaning import PLACE_OF, Meaning, meaning
from colonnade.campaign.draft.naming import unique
from colonnade.campaign.draft.survey import Column
from colonnade.campaign.draft.vocabulary import AXES, plain, words
from colonnade.readers.text.heading import LETTERED

MOST_UNKNOWN = 12
"""Unknown columns are asked about one by one up to this many."""

_FIRST_POINT = (
    "the point that it follows, [x, y, z] from the centre of the specimen's base: "
    'x along the shaking, y across, z up, such as ["43 mm", "0 mm", "440 mm"]'
)
_SENSING = {
    "laser": (
        ("sensing", '"surface"', "it follows its line of sight"),
        ("normal", '"?"', "outward normal of the face that it looks at, such as [1, 0, 0]; none for a round specimen"),
    ),
    "wire": (
        ("sensing", '"wire"', "it follows its wire"),
        ("anchor", '["? mm", "0 mm", "? mm"]', "the fixed end of the wire"),
    ),
}
_WIRES = {"seilzug": "wire", "stringpot": "wire", "string": "wire"}


@dataclass(frozen=True)
class DraftChannel:
    """
    A channel.

    Attributes
    ----------
    id : str
    recorder : str
    meaning : Meaning
    lines : tuple of Line or str
        Its keys, and comments.
    """

    id: str
    recorder: str
    meaning: Meaning
    lines: tuple[Line | str, ...]


@dataclass(frozen=True)
class DraftChannels:
    """Channels of a setup, and the columns that are not channels: recorder, heading and reason."""

    channels: tuple[DraftChannel, ...]
    left_out: tuple[tuple[str, str, str], ...]


def draft_channels(recorders: dict[str, Sequence[Column]]) -> DraftChannels:
    """
    Draft the channels of a setup.

    Parameters
    ----------
    recorders : dict of str to sequence of Column
        Columns of one file of each recorder, the main one under "main"; a column counts as dead if it is in all.
    """
    taken, left_out = _chosen(recorders)
    names = unique(("_".join(_id_parts(each.column.name)) for _, each in taken), "channel", as_variables=True)
    called = {recorder: [column.name for column in columns] for recorder, columns in recorders.items()}
    channels = []
    for name, (recorder, each) in zip(names, taken, strict=True):
        alone = called[recorder].count(each.column.name) == 1
        column = each.column.name if alone and each.column.name.strip() else each.column.number
        # One column is labelled (V), as vertical; several of them are in volts.
        is_volts = [other.unit for other in recorders[recorder]].count("V") > 1
        channels.append(DraftChannel(name, recorder, each, tuple(_lines(each, recorder, column, is_volts=is_volts))))
    return DraftChannels(tuple(channels), tuple(left_out))


def _chosen(recorders: dict[str, Sequence[Column]]) -> tuple[list[tuple[str, Meaning]], list[tuple[str, str, str]]]:
    """Columns that become channels, by recorder, and the others: recorder, heading and reason."""
    meanings = [(recorder, meaning(column)) for recorder, columns in recorders.items() for column in columns]
    known = any(each.quantity is not None for _, each in meanings)
    taken: list[tuple[str, Meaning]] = []
    left_out = []
    for recorder, each in meanings:
        if each.left_out:
            left_out.append((recorder, each.column.heading, each.left_out))
        elif each.quantity is None and (known or len(taken) >= MOST_UNKNOWN):
            unit = f'its unit is "{each.column.unit}" and its name' if each.column.unit else "its name"
            left_out.append((recorder, each.column.heading, f"{unit} does not show what it measures"))
        else:
            taken.append((recorder, each))
    return taken, left_out


def _id_parts(name: str) -> list[str]:
    """
    Split a name into its parts for an id.

    Examples
    --------
    >>> _id_parts("LVDT 1"), _id_parts("Weg [oben]")
    (['lvdt', '1'], ['weg', 'oben'])
    """
    return re.findall(r"[a-z0-9]+", plain(name))


def _lines(each: Meaning, recorder: str, column: str | int, *, is_volts: bool) -> list[Line | str]:
    lines: list[Line | str] = [Line("column", value(column))]
    if recorder != MAIN:
        lines.append(Line("recorder", value(recorder)))
    if each.quantity is None:
        choices = ", ".join(f'"{quantity}"' for quantity in units.QUANTITY_DIMENSIONS)
        question = f"what it measures: {choices}; or delete these lines"
        return [*lines, Line("quantity", '"?"', question=question), *_unit(each, is_volts=is_volts), *_place(each)]
    lines.append(Line("quantity", value(each.quantity), each.because, each.conflict))
    lines += _unit(each, is_volts=is_volts)
    return lines + _place(each)


def _unit(each: Meaning, *, is_volts: bool) -> list[Line]:
    column = each.column
    dimension = units.QUANTITY_DIMENSIONS[each.quantity or "other"]
    if not column.unit:
        usual = units.DIMENSIONS[dimension or "length"][1]
        question = (
            f'the file gives no unit: write one such as "{usual}", or "V" with a line gain = "10 {usual}/V" below it'
        )
        return [Line("unit", '"?"', question=question)]
    is_letter = LETTERED.fullmatch(column.heading) is not None and not each.is_physical
    if is_letter and not (is_volts and column.unit == "V"):
        question = f'is "({column.unit})" a label? Write the unit of the values, or "{column.unit}" with its line gain'
        return [Line("unit", '"?"', question=question)]
    if not each.unit_known:
        return [Line("unit", '"?"', question=f'the file says "{column.unit}", which is not a known unit')]
    lines = [Line("unit", value(column.unit), "as in the file")]
    if dimension is not None and not each.is_physical:
        recorded = units.normalise_unit(column.unit)
        below = f"({recorded})" if {"/", " "} & set(recorded) else recorded
        gain = f"? {units.DIMENSIONS[dimension][1]}/{below}"
        lines.append(Line("gain", value(gain), question="from its calibration sheet"))
    return lines


def _place(each: Meaning) -> list[Line | str]:
    if each.quantity == "force":
        return []
    place = each.place or (PLACE_OF.get(each.quantity, "specimen") if each.quantity else None)
    if place is None:
        question = 'what it is fixed to or looks at: "specimen", "table" or "ground"'
        return [Line("on", '"?"', question=question), _direction(each)]
    doubt = "" if each.place else 'or "table", "ground"' if place == "specimen" else 'or "specimen", "ground"'
    lines: list[Line | str] = [Line("on", value(place), each.place_word, doubt)]
    if each.quantity == "displacement" and place == "specimen":
        lines.append(Line("at", '["? mm", "0 mm", "? mm"]', question=_FIRST_POINT))
        fixed = 'where it is fixed: "table" if it moves with the table, else "ground"'
        lines.append(Line("relative_to", '"?"', question=fixed))
    if each.quantity == "acceleration" and place == "specimen":
        where = "where it is fixed; two or more along x at different heights improve the angle"
        lines.append(comment(f'at = ["43 mm", "0 mm", "440 mm"]      {where}'))
    lines.append(_direction(each))
    if each.quantity == "displacement" and place == "specimen":
        lines += _sensing(each)
    return lines


def _sensing(each: Meaning) -> list[Line]:
    """Lines of a transducer whose name says that it follows no material point."""
    for part in words(each.column.name):
        kind = _WIRES.get(part, part)
        if kind in _SENSING:
            (key, content, because), (asked, unknown, question) = _SENSING[kind]
            reason = f'from "{part}" in its name: {because}'
            return [Line(key, content, reason), Line(asked, unknown, question=question)]
    return []


def _direction(each: Meaning) -> Line:
    along = "axis" if each.quantity in ("angle", "angular_velocity") else "direction"
    direction = AXES[each.axis] if each.axis else (0, 1, 0) if along == "axis" else (1, 0, 0)
    reason = f'from "{each.axis}" in its name' if each.axis else ""
    negative = ", ".join(str(-part or 0) for part in direction)
    question = f"of a positive reading; [{negative}] if it is reversed"
    return Line("direction", value(direction), reason, question)
