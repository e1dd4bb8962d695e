"""What columns and files are, by units, names and signals, and which files belong to one test: guesses with reasons."""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import PurePosixPath

from colonnade import units
from colonnade.campaign.channel import MAIN
from colonnade.campaign.draft.survey import Column, RawFile
from colonnade.campaign.draft.words import AXES, Line, as_id, axis, comment, find, plain, unique, words
from colonnade.campaign.syntax.document import toml_value
from colonnade.campaign.test import KINDS
from colonnade.errors import UnitError
from colonnade.readers.text.heading import LETTERED

MOST_UNKNOWN = 12
"""Unknown columns are asked about one by one up to this many."""

STILL = 0.05
"""A table that moves by less than this fraction of its motion in another test is still."""

SAME_FREQUENCY = 0.05
"""A frequency in a name that is further off the recorded one than this fraction is doubted."""


# What readers say themselves: a column that has no name, a block of a file.
_NUMBERED = re.compile(r"^(?:column \d+$|block \d+: )")
# A separate word: "usp000hzq8" is not a frequency.
_FREQUENCY = re.compile(r"(?<![\d.,])(\d{1,6}(?:[.,p]\d{1,6})?)[ _-]?hz(?![a-z0-9])")
_SPAN = re.compile(r"(?<![a-z])span[ _=-]?(\d{1,6}(?:[.,p]\d{1,6})?)(?![\d.,])")

_USUAL_PLACE = {"displacement": "specimen", "acceleration": "table", "velocity": "table"}
_FIRST_POINT = (
    "the point that it follows, [x, y, z] from the centre of the specimen's base: "
    'x along the shaking, y across, z up, such as ["43 mm", "0 mm", "440 mm"]'
)
_WIRES = ("wire", "seilzug", "stringpot", "string")


@dataclass(frozen=True)
class Meaning:
    """
    The meaning given to a column.

    Attributes
    ----------
    column : Column
    left_out : str
        Why it is not a channel; empty if it is one.
    quantity, place, axis : str or None
        None if nothing shows it.
    because, place_word : str
        What shows the quantity, and the place.
    unit_known, is_physical : bool
        Whether the file's unit is known and is a unit of the quantity, not of a voltage.
    conflict : str
        How name and unit contradict each other.
    """

    column: Column
    left_out: str = ""
    quantity: str | None = None
    place: str | None = None
    axis: str | None = None
    because: str = ""
    place_word: str = ""
    unit_known: bool = False
    is_physical: bool = False
    conflict: str = ""

    @property
    def is_of_table(self) -> bool:
        """Whether it shows how the table moves."""
        place = self.place or ("table" if self.quantity == "acceleration" else "")
        return place == "table" and self.quantity in ("acceleration", "displacement")


def meaning(column: Column) -> Meaning:
    """Find out what a column is from its unit, its name and what its signal looks like."""
    if column.is_clock:
        return Meaning(column, "the clock")
    if column.shape.is_dead:
        held = "it never changes" if column.shape.spread == 0.0 else "it holds no number"
        return Meaning(column, f"{held} in any of these files")
    name = _NUMBERED.sub("", column.name)
    by_name, place = find(name, "quantities"), find(name, "places")
    by_unit, known = _of_unit(column.unit)
    if by_unit is None and column.shape.counts:
        return Meaning(column, "a running number: it rises by one from sample to sample")
    if by_unit is None and by_name is None and (other := find(name, "left_out")):
        return Meaning(column, f'{other[0]}, from "{other[1]}" in its name')
    conflict, because = "", f'from its unit "{column.unit}"' if by_unit else ""
    if by_name and not by_unit:
        because = f'from "{by_name[1]}" in its name'
    elif by_name and by_unit != by_name[0]:
        conflict = f'its unit "{column.unit}" says {by_unit}, its name "{by_name[1]}" {by_name[0]}'
    return Meaning(
        column,
        quantity=by_unit or (by_name[0] if by_name else None),
        place=place[0] if place else None,
        axis=axis(column.name),
        because=because,
        place_word=f'from "{place[1]}" in its name' if place else "",
        unit_known=known,
        is_physical=by_unit is not None,
        conflict=conflict,
    )


def _of_unit(unit: str | None) -> tuple[str | None, bool]:
    """Quantity of which a unit is, and whether it is known."""
    try:
        recorded = units.si_factor(unit)[1] if unit else ""
    except UnitError:
        return None, False
    for quantity, dimension in units.QUANTITY_DIMENSIONS.items():
        if dimension and recorded == units.si_factor(units.DIMENSIONS[dimension][0])[1]:
            return quantity, True
    return None, bool(unit)


@dataclass(frozen=True)
class DraftChannel:
    """A channel: its id, recorder and meaning, and the lines of its keys with comments."""

    id: str
    recorder: str
    meaning: Meaning
    lines: tuple[Line | str, ...]


@dataclass(frozen=True)
class DraftChannels:
    """Channels of a setup, and the columns that are not channels: recorder, heading and reason."""

    channels: tuple[DraftChannel, ...] = ()
    left_out: tuple[tuple[str, str, str], ...] = ()


def draft_channels(recorders: Mapping[str, Sequence[Column]]) -> DraftChannels:
    """
    Draft the channels of a setup.

    Parameters
    ----------
    recorders : mapping of str to sequence of Column
        Columns of one file of each recorder, the main one under "main"; a column counts as dead if it is in all.
    """
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
    names = ("_".join(re.findall(r"[a-z0-9]+", plain(each.column.name))) for _, each in taken)
    channels = []
    for name, (recorder, each) in zip(unique(names, "channel", as_variables=True), taken, strict=True):
        others = recorders[recorder]
        alone = each.column.name.strip() and [other.name for other in others].count(each.column.name) == 1
        lines: list[Line | str] = [Line("column", toml_value(each.column.name if alone else each.column.number))]
        if recorder != MAIN:
            lines.append(Line("recorder", toml_value(recorder)))
        # One column is labelled (V), as vertical; several of them are in volts.
        lines += _lines(each, is_volts=[other.unit for other in others].count("V") > 1)
        channels.append(DraftChannel(name, recorder, each, tuple(lines)))
    return DraftChannels(tuple(channels), tuple(left_out))


def _lines(each: Meaning, *, is_volts: bool) -> Iterator[Line | str]:
    if each.quantity is None:
        choices = ", ".join(f'"{quantity}"' for quantity in units.QUANTITY_DIMENSIONS)
        yield Line("quantity", '"?"', question=f"what it measures: {choices}; or delete these lines")
    else:
        yield Line("quantity", toml_value(each.quantity), each.because, each.conflict)
    yield from _unit(each, is_volts=is_volts)
    if each.quantity == "force":
        return
    place = each.place or (_USUAL_PLACE.get(each.quantity, "specimen") if each.quantity else None)
    if place is None:
        yield Line("on", '"?"', question='what it is fixed to or looks at: "specimen", "table" or "ground"')
    else:
        doubt = 'or "table", "ground"' if place == "specimen" else 'or "specimen", "ground"'
        yield Line("on", toml_value(place), each.place_word, "" if each.place else doubt)
    follows = each.quantity == "displacement" and place == "specimen"
    if follows:
        yield Line("at", '["? mm", "0 mm", "? mm"]', question=_FIRST_POINT)
        fixed = 'where it is fixed: "table" if it moves with the table, else "ground"'
        yield Line("relative_to", '"?"', question=fixed)
    if each.quantity == "acceleration" and place == "specimen":
        where = "where it is fixed; two or more along x at different heights improve the angle"
        yield comment(f'at = ["43 mm", "0 mm", "440 mm"]      {where}')
    yield _direction(each)
    if follows:
        yield from _sensing(each.column.name)


def _unit(each: Meaning, *, is_volts: bool) -> Iterator[Line]:
    column = each.column
    dimension = units.QUANTITY_DIMENSIONS[each.quantity or "other"]
    usual = units.DIMENSIONS[dimension or "length"][1]
    is_letter = LETTERED.fullmatch(column.heading) is not None and not each.is_physical
    question = ""
    if not column.unit:
        question = (
            f'the file gives no unit: write one such as "{usual}", or "V" with a line gain = "10 {usual}/V" below it'
        )
    elif is_letter and not (is_volts and column.unit == "V"):
        question = f'is "({column.unit})" a label? Write the unit of the values, or "{column.unit}" with its line gain'
    elif not each.unit_known:
        question = f'the file says "{column.unit}", which is not a known unit'
    if question or not column.unit:
        yield Line("unit", '"?"', question=question)
        return
    yield Line("unit", toml_value(column.unit), "as in the file")
    if dimension is not None and not each.is_physical:
        recorded = units.normalise_unit(column.unit)
        below = f"({recorded})" if {"/", " "} & set(recorded) else recorded
        yield Line("gain", toml_value(f"? {usual}/{below}"), question="from its calibration sheet")


def _sensing(name: str) -> Iterator[Line]:
    """Give the lines of a transducer whose name says that it follows no material point."""
    part = next((part for part in words(name) if part == "laser" or part in _WIRES), "")
    if part == "laser":
        yield Line("sensing", '"surface"', f'from "{part}" in its name: it follows its line of sight')
        normal = "outward normal of the face that it looks at, such as [1, 0, 0]; none for a round specimen"
        yield Line("normal", '"?"', question=normal)
    elif part:
        yield Line("sensing", '"wire"', f'from "{part}" in its name: it follows its wire')
        yield Line("anchor", '["? mm", "0 mm", "? mm"]', question="the fixed end of the wire")


def _direction(each: Meaning) -> Line:
    usual = (0, 1, 0) if each.quantity in ("angle", "angular_velocity") else (1, 0, 0)
    direction = AXES[each.axis] if each.axis else usual
    reason = f'from "{each.axis}" in its name' if each.axis else ""
    negative = ", ".join(str(-part or 0) for part in direction)
    question = f"of a positive reading; [{negative}] if it is reversed"
    return Line("direction", toml_value(direction), reason, question)


@dataclass(frozen=True)
class DraftTest:
    """A test: its files by recorder, the main one first."""

    files: dict[str, RawFile]

    @property
    def main(self) -> RawFile:
        """File of the main recorder."""
        return self.files[MAIN]

    def column(self, channel: DraftChannel) -> Column:
        """Column of a channel in this test."""
        return self.files[channel.recorder].columns[channel.meaning.column.number - 1]


def kind_lines(test: DraftTest, channels: Sequence[DraftChannel], others: Collection[DraftTest]) -> list[Line | str]:
    """
    Guess the kind of a test, and what belongs to it.

    Parameters
    ----------
    test : DraftTest
    channels : sequence of DraftChannel
        Of its setup.
    others : collection of DraftTest
        All tests of the setup: a table is still if it moves far more in another one.

    Returns
    -------
    lines : list of Line or str
        kind, and frequency, motion or span if they are known.
    """
    name = PurePosixPath(test.main.stem).name
    table = [channel for channel in channels if channel.meaning.is_of_table]
    # Impacts disturb the displacement less than the acceleration.
    columns = [test.column(each) for each in sorted(table, key=lambda each: each.meaning.quantity != "displacement")]
    frequency = next((column.shape.sine for column in columns if column.shape.sine is not None), None)
    still = bool(table) and all(
        test.column(each).shape.spread < STILL * max(other.column(each).shape.spread for other in others)
        for each in table
    )
    named = _number(_FREQUENCY, name)
    found = find(name, "kinds") or (named and ("sine", f"{named:g} Hz"))
    if found:
        kind = Line("kind", toml_value(found[0]), f'from "{found[1]}" in its name', _doubt(found[0], frequency, still))
    elif frequency is not None:
        kind = Line("kind", '"sine"', "the table moves as a steady sine", "guessed from its signal")
    elif still and _dies_away(test, channels):
        reason = "the table does not move and the specimen comes to rest"
        kind = Line("kind", '"free-vibration"', reason, "guessed from its signal")
    else:
        choices = ", ".join(f'"{kind}"' for kind in KINDS if kind != "other")
        kind = Line("kind", '"other"', "", f'neither name nor signal shows it: {choices}; "other" has no prediction')
    lines: list[Line | str] = [kind]
    if kind.value in ('"sine"', '"pulse"'):
        lines.append(_frequency(named, frequency if kind.value == '"sine"' else None))
    if kind.value == '"earthquake"':
        motion, span = find(name, "motions"), _number(_SPAN, name)
        if motion:
            lines.append(Line("motion", toml_value(motion[0]), "from its name", "with component and year"))
        else:
            lines.append(comment('motion = "El Centro 1940 NS"      the motion that the table was given'))
        lines += [Line("span", toml_value(span), "from its name")] if span is not None else []
    return lines


def _doubt(kind: str, frequency: float | None, still: bool) -> str:
    if kind in ("free-vibration", "earthquake", "noise") and frequency is not None:
        return f"the table moves as a steady sine of {frequency:.3g} Hz"
    if kind in ("earthquake", "noise", "sine", "pulse") and still:
        return "the table hardly moves in this test"
    return ""


def _frequency(named: float | None, recorded: float | None) -> Line | str:
    if named is None and recorded is None:
        return comment('frequency = "3 Hz"      if it is known')
    if named is None:
        return Line("frequency", toml_value(f"{recorded:.3g} Hz"), "of the table's motion", "guessed from its signal")
    differs = recorded is not None and abs(recorded - named) > SAME_FREQUENCY * named
    doubt = f"the table moves at {recorded:.3g} Hz" if differs else ""
    return Line("frequency", toml_value(f"{named:g} Hz"), "from its name", doubt)


def _number(pattern: re.Pattern[str], name: str) -> float | None:
    """Read a number above zero from a name; None if it has none."""
    found = pattern.search(plain(name))
    return (float(re.sub("[,p]", ".", found[1])) or None) if found else None


def _dies_away(test: DraftTest, channels: Sequence[DraftChannel]) -> bool:
    return any(
        each.meaning.quantity in ("displacement", "angle")
        and not each.meaning.is_of_table
        and test.column(each).shape.dies_away
        for each in channels
    )


_RECORDER = r"(?:daq|das|rec|recorder|logger|box|unit|device|scope|system)[ _-]?[0-9]*"
_TAG = re.compile(r"[ _.\-]+([A-Za-z]+[ _\-]?[0-9]*)")


@dataclass
class DraftSetup:
    """Tests that were recorded in the same way."""

    tests: list[DraftTest] = field(default_factory=list)
    name: str = "setup"

    @property
    def recorders(self) -> tuple[str, ...]:
        """Names of the recorders, "main" first."""
        return tuple(self.tests[0].files)

    @cached_property
    def drafted(self) -> DraftChannels:
        """Its channels."""
        return draft_channels({recorder: self.columns(recorder) for recorder in self.recorders})

    def columns(self, recorder: str) -> tuple[Column, ...]:
        """Columns of a recorder, each as it is in the file where it moves most."""
        files = [test.files[recorder] for test in self.tests]
        return tuple(
            max(alike, key=lambda column: column.shape.spread if column.shape.spread > 0 else -1.0)
            for alike in zip(*(file.columns for file in files), strict=True)
        )


def arrange(files: Sequence[RawFile]) -> tuple[list[DraftSetup], list[tuple[str, str]]]:
    """
    Arrange raw files into setups and tests.

    Files of the same format and columns are of one recorder. `span-2.csv` and `span-2-daq2.csv`, `x_box1.csv` and
    `x_box2.csv`, or `daq1/x.csv` and `daq2/x.csv` are of two recorders of one test; so are `x.csv` and `x-top.csv`
    if they have no column in common.

    Parameters
    ----------
    files : sequence of RawFile
        In the order of the tests.

    Returns
    -------
    setups : list of DraftSetup
    copies : list of (str, str)
        Files left out as a second copy of the same recording, with the one that is used.
    """
    copies: list[tuple[str, str]] = []
    tests: dict[str, dict[str, RawFile]] = {}
    known: defaultdict[tuple[str, ...], list[RawFile]] = defaultdict(list)
    for file in files:
        if twin := next((other for other in known["stem", file.stem] if _columns(other) == _columns(file)), None):
            copies.append((file.relative, twin.relative))
            continue
        mains = ((other, tag) for key, tag in _shared(file) if tag for other in known[key] if other.relative in tests)
        for main, tag in mains:
            certain = re.fullmatch(_RECORDER, tag, re.IGNORECASE) is not None
            if certain or not set(_columns(file)) & set(_columns(main)):
                recorders = tests[main.relative]
                recorders[unique([*recorders, as_id(tag, "recorder")], "recorder")[-1]] = file
                break
        else:
            tests[file.relative] = {MAIN: file}
        for key, _ in _own(file):
            known[key].append(file)
    setups: dict[tuple[object, ...], DraftSetup] = {}
    for recorded in tests.values():
        layout = tuple((name, file.layout) for name, file in recorded.items())
        setups.setdefault(layout, DraftSetup()).tests.append(DraftTest(recorded))
    return list(setups.values()), copies


def _own(file: RawFile) -> Iterator[tuple[tuple[str, ...], str]]:
    """Give the parts of a file's name that a file of another recorder has too, each with what is then its recorder."""
    path = PurePosixPath(file.stem)
    base, tag = _base(file.stem)
    yield ("base", base), tag
    yield ("stem", file.stem), PurePosixPath(file.relative).suffix.lstrip(".")
    yield ("name", str(path.parent.parent), path.name), path.parent.name


def _shared(file: RawFile) -> Iterator[tuple[tuple[str, ...], str]]:
    """Give the names of files whose tests this file may belong to: its own without a word at the end come first."""
    for end in range(len(file.stem) - 1, len(file.stem) - len(PurePosixPath(file.stem).name), -1):
        if tag := _TAG.fullmatch(file.stem[end:]):
            yield ("stem", file.stem[:end]), tag[1]
    yield from _own(file)


def _base(stem: str) -> tuple[str, str]:
    """Stem without the name of a recorder at its end, and that name."""
    found = re.fullmatch(rf"(.*[^ _.\-/])[ _.\-]+({_RECORDER})", stem, re.IGNORECASE)
    return (found[1], found[2]) if found else (stem, "")


def _columns(file: RawFile) -> list[str]:
    return sorted(column.name.casefold() for column in file.columns if not column.is_clock)


def names_of(tests: Iterable[DraftTest]) -> list[str]:
    """Names of tests, from their files; with the folder if several files have the same name."""
    stems = [PurePosixPath(test.main.stem) for test in tests]
    names = [_base(stem.name)[0] for stem in stems]
    often = Counter(names)
    return [
        name if often[name] == 1 or not stem.parent.name else f"{stem.parent.name}-{name}"
        for stem, name in zip(stems, names, strict=True)
    ]
