"""The manual review: what people decided about recordings in review.toml, each with who, when and why."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, WithJsonSchema

from colonnade.campaign.decision import Review, decided
from colonnade.campaign.setup import Setup
from colonnade.campaign.syntax.bounds import FACTOR, outside
from colonnade.campaign.syntax.days import Day
from colonnade.campaign.syntax.document import parse, read_text, refusal, validated
from colonnade.campaign.syntax.fields import Interval, Text, number, one_of, schema_version, shown
from colonnade.campaign.syntax.places import Place, Source, key_lines
from colonnade.campaign.syntax.rawpath import inside
from colonnade.campaign.syntax.table import Table
from colonnade.campaign.test import Test
from colonnade.errors import CampaignError, nearest

FILE_NAME = "review.toml"
SCHEMA = 1
"""Version of the form of review.toml."""


def _tests(value: object) -> tuple[str, ...]:
    ids = value if isinstance(value, list) else [value]
    if not ids or not all(isinstance(each, str) and each for each in ids):
        raise ValueError(f'{shown(value)} was found. The id of a test, or a list of ids, was expected: "free-01".')
    return tuple(dict.fromkeys(ids))


def _factor(value: object) -> float:
    factor = number(value)
    if factor == 0.0:
        raise ValueError("A factor of zero would erase the recording. To leave the channel out, [[exclude]] it.")
    if expected := outside(factor, FACTOR):
        raise ValueError(f"{shown(value)} was found. {expected}")
    return factor


Tests = Annotated[
    tuple[str, ...],
    BeforeValidator(_tests),
    WithJsonSchema({"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}, "minItems": 1}]}),
]
Factor = Annotated[float, BeforeValidator(_factor), WithJsonSchema({"type": "number"})]


class Entry(Table):
    """Fields of every entry."""

    tests: Tests = Field(alias="test")
    """The test it is about, or a list of them."""
    who: Text
    """Who decided it."""
    when: Day
    """The day it was decided, such as 2013-04-26."""
    why: Text
    """Why, for whoever reads the results."""


class Exclude(Entry):
    """Leave a test out, or one channel of it."""

    channel: Text | None = None
    """The channel to leave out; without it the whole test."""


class Trim(Entry):
    """Use only a part of a test."""

    window: Interval
    """The part that is used, in the file's own time, such as ["2 s", "14 s"]."""


class FlagStretch(Entry):
    """Flag a stretch of a channel."""

    channel: Text
    """The channel."""
    window: Interval
    """The stretch, in the file's own time, such as ["3.2 s", "3.4 s"]."""
    flag: Annotated[str, *one_of("suspect", "fail")] = Field(alias="as")
    """"suspect" (reported, still used) or "fail" (bridged)."""


class Correct(Entry):
    """Correct the gain of a channel, or its sign."""

    channel: Text
    """The channel."""
    factor: Factor
    """What the gain has to be multiplied by: -1 turns the sign."""


class ReviewFile(Table):
    """A review.toml as written."""

    version: Annotated[int, *schema_version(SCHEMA, "review files")] = Field(alias="schema")
    """Version of the review file's form: 1."""
    exclude: tuple[Exclude, ...] = ()
    """Tests or channels that are left out."""
    trim: tuple[Trim, ...] = ()
    """Tests of which only a part is used."""
    flag: tuple[FlagStretch, ...] = ()
    """Stretches of a channel that are suspect or failed."""
    correct: tuple[Correct, ...] = ()
    """Gains and signs that are corrected."""


@dataclass(frozen=True)
class _Known:
    """The tests, and the channels of each, that entries may name."""

    tests: Mapping[str, Test]
    setups: Mapping[str, Setup]


def read_review(folder: Path, tests: Mapping[str, Test], setups: Mapping[str, Setup]) -> dict[str, Review]:
    """
    Read the review of a campaign.

    Parameters
    ----------
    folder : Path
        Folder of the campaign file, which may have a review.toml.
    tests, setups : mapping
        Of the campaign, by id.

    Returns
    -------
    reviews : dict of str to Review
        Of the tests that have entries; empty without a review.

    Raises
    ------
    CampaignError
        If the file cannot be used; its text has a line for each problem.
    """
    path = folder / FILE_NAME
    if not path.exists():
        return {}
    try:
        written = read_text(inside(folder, FILE_NAME))
    except ValueError as error:
        raise CampaignError(f"{FILE_NAME}: {error}") from None
    document, source = parse(written, path.name), Source(path.name, key_lines(written))
    review, problems = validated(ReviewFile, document, folder)
    problems += _dangling(document, _Known(tests, setups))
    if review and not problems:
        problems += _empty_windows(review)
    if problems or review is None:
        raise refusal(source.paragraphs(problems, document))
    concerned = dict.fromkeys(name for _, entry in _entries(review) for name in entry.tests)
    return {name: decided(_of_test(review, name)) for name in concerned}


def _entries(review: ReviewFile) -> Iterator[tuple[Place, Any]]:
    for kind in ("exclude", "trim", "flag", "correct"):
        for index, entry in enumerate(getattr(review, kind)):
            yield (kind, index), entry


def _of_test(review: ReviewFile, test: str) -> list[tuple[str, dict[str, Any]]]:
    return [(str(place[0]), dict(entry)) for place, entry in _entries(review) if test in entry.tests]


def _dangling(document: Mapping[str, Any], known: _Known) -> Iterator[tuple[Place, str]]:
    """Find names that refer to nothing, in the file as written, so that all problems are reported at once."""
    for kind in ("exclude", "trim", "flag", "correct"):
        entries = document.get(kind)
        for index, entry in enumerate(entries if isinstance(entries, list) else []):
            if isinstance(entry, dict):
                yield from _unknown_names((kind, index), entry, known)


def _unknown_names(place: Place, entry: Mapping[str, Any], known: _Known) -> Iterator[tuple[Place, str]]:
    named = entry.get("test")
    for test in named if isinstance(named, list) else [named]:
        if not isinstance(test, str):
            continue
        if test not in known.tests:
            yield (*place, "test"), f"Unknown test {shown(test)}.{nearest(test, known.tests)}"
            continue
        channel, setup = entry.get("channel"), known.tests[test].setup
        channels = known.setups[setup].channels
        if isinstance(channel, str) and channel not in channels:
            hint = nearest(channel, channels)
            yield (*place, "channel"), f'Unknown channel {shown(channel)} in set-up "{setup}" of {test}.{hint}'


def _empty_windows(review: ReviewFile) -> Iterator[tuple[Place, str]]:
    """Find trims of one test that have no instant in common."""
    kept: dict[str, tuple[float, float]] = {}
    for index, entry in enumerate(review.trim):
        for test in entry.tests:
            low, high = _common(kept.get(test), entry.window)
            if low >= high:
                yield ("trim", index, "window"), f"This and an earlier [[trim]] leave no samples of {test}."
            kept[test] = (low, high)


def _common(first: Iterable[float] | None, second: tuple[float, float]) -> tuple[float, float]:
    if first is None:
        return second
    low, high = first
    return max(low, second[0]), min(high, second[1])
