"""The kind of test in a file, by its name and by how table and specimen move."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import PurePosixPath

from colonnade.campaign.channel import MAIN
from colonnade.campaign.draft.channels import DraftChannel
from colonnade.campaign.draft.layout import DraftTest
from colonnade.campaign.draft.lines import Line, comment, value
from colonnade.campaign.draft.survey import Column
from colonnade.campaign.draft.vocabulary import KINDS, MOTIONS, find, plain, words
from colonnade.campaign.test import KINDS as ALL_KINDS

STILL = 0.05
"""A table that moves by less than this fraction of its motion in another test is still."""

SAME_FREQUENCY = 0.05
"""A frequency in a name that is further off the recorded one than this fraction is doubted."""

# A separate word: "usp000hzq8" is not a frequency.
_FREQUENCY = re.compile(r"(?<![\d.,])(\d{1,6}(?:[.,p]\d{1,6})?)[ _-]?hz(?![a-z0-9])")
_SPAN = re.compile(r"(?<![a-z])span[ _=-]?(\d{1,6}(?:[.,p]\d{1,6})?)(?![\d.,])")


def kind_lines(test: DraftTest, channels: Sequence[DraftChannel], largest: dict[str, float]) -> list[Line | str]:
    """
    Guess the kind of a test, and what belongs to it.

    Parameters
    ----------
    test : DraftTest
    channels : sequence of DraftChannel
        Of its setup.
    largest : dict of str to float
        Spread of each channel in the test where it moves most.

    Returns
    -------
    lines : list of Line or str
        kind, and frequency, motion or span if they are known.
    """
    name = PurePosixPath(test.main.stem).name
    parts = words(name)
    by_name = find(parts, KINDS)
    frequency, still = _table_frequency(test, channels), _table_is_still(test, channels, largest)
    named = _number(_FREQUENCY, name)
    if by_name is None and named is not None:
        by_name = ("sine", f"{named:g} Hz")
    if by_name is not None:
        kind = Line("kind", value(by_name[0]), f'from "{by_name[1]}" in its name', _doubt(by_name[0], frequency, still))
    elif frequency is not None:
        kind = Line("kind", '"sine"', "the table moves as a steady sine", "guessed from its signal")
    elif still and _specimen_dies_away(test, channels):
        reason = "the table does not move and the specimen comes to rest"
        kind = Line("kind", '"free-vibration"', reason, "guessed from its signal")
    else:
        others = ", ".join(f'"{kind}"' for kind in ALL_KINDS if kind != "other")
        kind = Line("kind", '"other"', "", f'neither name nor signal shows it: {others}; "other" has no prediction')
    lines: list[Line | str] = [kind]
    if kind.value in ('"sine"', '"pulse"'):
        lines += _frequency_lines(named, frequency if kind.value == '"sine"' else None)
    if kind.value == '"earthquake"':
        motion = find(parts, MOTIONS)
        if motion:
            lines.append(Line("motion", value(motion[0]), "from its name", "with component and year"))
        else:
            lines.append(comment('motion = "El Centro 1940 NS"      the motion that the table was given'))
        span = _number(_SPAN, name)
        lines += [Line("span", value(span), "from its name")] if span is not None else []
    return lines


def _doubt(kind: str, frequency: float | None, still: bool) -> str:
    if kind == "free-vibration" and frequency is not None:
        return f"the table moves as a steady sine of {frequency:.3g} Hz"
    if kind in ("earthquake", "noise") and frequency is not None:
        return f"the table moves as a steady sine of {frequency:.3g} Hz"
    if kind in ("earthquake", "noise", "sine", "pulse") and still:
        return "the table hardly moves in this test"
    return ""


def _frequency_lines(named: float | None, recorded: float | None) -> list[Line | str]:
    if named is None and recorded is None:
        return [comment('frequency = "3 Hz"      if it is known')]
    if named is None:
        return [Line("frequency", value(f"{recorded:.3g} Hz"), "of the table's motion", "guessed from its signal")]
    doubt = ""
    if recorded is not None and abs(recorded - named) > SAME_FREQUENCY * named:
        doubt = f"the table moves at {recorded:.3g} Hz"
    return [Line("frequency", value(f"{named:g} Hz"), "from its name", doubt)]


def _number(pattern: re.Pattern[str], name: str) -> float | None:
    """Read a number above zero from a name; None if it has none."""
    found = pattern.search(plain(name))
    number = float(re.sub("[,p]", ".", found[1])) if found else 0.0
    return number if number > 0 else None


def _of(test: DraftTest, channel: DraftChannel) -> Column:
    return test.files[channel.recorder].columns[channel.meaning.column.number - 1]


def _on_the_table(channels: Sequence[DraftChannel]) -> list[DraftChannel]:
    return [
        channel
        for channel in channels
        if channel.meaning.quantity in ("acceleration", "displacement")
        and (channel.meaning.place or ("table" if channel.meaning.quantity == "acceleration" else "")) == "table"
    ]


def _table_frequency(test: DraftTest, channels: Sequence[DraftChannel]) -> float | None:
    """Frequency of the table's steady sine; its displacement is used first, as impacts disturb it less."""
    table = sorted(_on_the_table(channels), key=lambda channel: channel.meaning.quantity != "displacement")
    found = [sine for channel in table if (sine := _of(test, channel).shape.sine) is not None]
    return found[0] if found else None


def _table_is_still(test: DraftTest, channels: Sequence[DraftChannel], largest: dict[str, float]) -> bool:
    table = _on_the_table(channels)
    return bool(table) and all(_of(test, channel).shape.spread < STILL * largest[channel.id] for channel in table)


def _specimen_dies_away(test: DraftTest, channels: Sequence[DraftChannel]) -> bool:
    return any(
        channel.meaning.quantity in ("displacement", "angle")
        and channel not in _on_the_table(channels)
        and _of(test, channel).shape.dies_away
        for channel in channels
    )


def largest_spreads(tests: Sequence[DraftTest], channels: Sequence[DraftChannel]) -> dict[str, float]:
    """Spread of each channel in the test where it moves most."""
    return {channel.id: max(_of(test, channel).shape.spread for test in tests) for channel in channels}


def linked(channels: Sequence[DraftChannel], recorder: str) -> tuple[str, str] | None:
    """Channels of the main and of another recorder that both see the table move along x."""
    seen: dict[str, str] = {}
    for channel in _on_the_table(channels):
        if channel.meaning.axis in (None, "x"):
            seen.setdefault(channel.recorder, channel.id)
    return (seen[MAIN], seen[recorder]) if MAIN in seen and recorder in seen else None
