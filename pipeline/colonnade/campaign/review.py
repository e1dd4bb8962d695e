"""The manual review: what people decided about recordings in review.toml, each with who, when and why."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, ClassVar, Literal

from pydantic import AfterValidator, Field, WithJsonSchema

from colonnade.campaign.setup import Setup
from colonnade.campaign.syntax.document import Place, read, refusal, unknown, validated
from colonnade.campaign.syntax.fields import FACTOR, Day, Interval, Number, Several, Text, outside, shown
from colonnade.campaign.syntax.names import inside
from colonnade.campaign.syntax.table import Record, Table
from colonnade.campaign.test import Test
from colonnade.errors import CampaignError

FILE_NAME = "review.toml"


def _factor(factor: float) -> float:
    if expected := outside(factor, FACTOR):
        raise ValueError(f"{shown(factor)} was found. {expected} To leave the channel out, [[exclude]] it.")
    return factor


_TESTS = {"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}, "minItems": 1}]}
Tests = Annotated[Several, WithJsonSchema(_TESTS)]


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

    form: ClassVar[str] = ""
    """What is done, in words, with the fields of the entry."""

    @property
    def what(self) -> str:
        """What is done, in words."""
        return self.form.format(self)

    @property
    def said(self) -> str:
        """When, who, what and why, in a sentence."""
        return f"{self.when}, {self.who}: {self.what}: {self.why}"


class Exclude(Entry):
    """Leave a test out, or one channel of it."""

    channel: Text | None = None
    """The channel to leave out; without it the whole test."""

    @property
    def what(self) -> str:
        """What is done, in words."""
        return f"channel {self.channel} excluded" if self.channel else "test excluded"


class Trim(Entry):
    """Use only a part of a test."""

    window: Interval
    """The part that is used, in the file's own time, such as ["2 s", "14 s"]."""

    form = "only {0.window[0]:g} s to {0.window[1]:g} s used"


class FlagStretch(Entry):
    """Flag a stretch of a channel."""

    channel: Text
    """The channel."""
    window: Interval
    """The stretch, in the file's own time, such as ["3.2 s", "3.4 s"]."""
    flag: Literal["suspect", "fail"] = Field(alias="as")
    """"suspect" (reported, still used) or "fail" (bridged)."""

    form = "channel {0.channel} from {0.window[0]:g} s to {0.window[1]:g} s flagged as {0.flag}"


class Correct(Entry):
    """Correct the gain of a channel, or its sign."""

    channel: Text
    """The channel."""
    factor: Annotated[Number, AfterValidator(_factor)]
    """What the gain has to be multiplied by: -1 turns the sign."""

    form = "gain of channel {0.channel} multiplied by {0.factor:g}"


class ReviewFile(Table):
    """A review.toml as written."""

    version: Literal[1] = Field(alias="schema")
    """Version of the review file's form: 1."""
    exclude: tuple[Exclude, ...] = ()
    """Tests or channels that are left out."""
    trim: tuple[Trim, ...] = ()
    """Tests of which only a part is used."""
    flag: tuple[FlagStretch, ...] = ()
    """Stretches of a channel that are suspect or failed."""
    correct: tuple[Correct, ...] = ()
    """Gains and signs that are corrected."""

    def entries(self) -> Iterator[tuple[Place, Entry]]:
        """Give all entries with their places."""
        for kind in ("exclude", "trim", "flag", "correct"):
            yield from (((kind, index), entry) for index, entry in enumerate(getattr(self, kind)))


class Flagged(Record):
    """A stretch of a channel that people flagged; the whole channel if the window is None."""

    channel: str
    window: tuple[float, float] | None
    flag: Literal["suspect", "fail"]
    reason: str


class Review(Record):
    """
    The decisions about one test.

    Attributes
    ----------
    excluded : str
        Why the whole test is left out, with who and when; empty if it is not.
    window : (float, float) or None
        The part of the file that is used, s.
    flags : tuple of Flagged
    factors : dict of str to float
        Factor on the gain of each channel.
    sentences : tuple of str
        One sentence for each entry: when, who, what, why.
    """

    excluded: str = ""
    window: tuple[float, float] | None = None
    flags: tuple[Flagged, ...] = ()
    factors: dict[str, float] = Field(default={})
    sentences: tuple[str, ...] = ()

    def within(self, window: tuple[float, float] | None) -> tuple[float, float] | None:
        """
        Return the part of a test's window that is used.

        Examples
        --------
        >>> Review(window=(2.0, 9.0)).within((0.0, 5.0))
        (2.0, 5.0)
        """
        if window is None or self.window is None:
            return window or self.window
        return max(window[0], self.window[0]), min(window[1], self.window[1])


def decided(entries: Sequence[Entry]) -> Review:
    """
    Gather the decisions about one test: trims leave their common part, corrections of a channel multiply.
    """
    excluded, window = "", None
    flags: list[Flagged] = []
    factors: dict[str, float] = {}
    for entry in entries:
        reason = f"review of {entry.said}"
        if isinstance(entry, Exclude) and entry.channel:
            flags.append(Flagged(channel=entry.channel, window=None, flag="fail", reason=reason))
        elif isinstance(entry, Exclude):
            excluded = excluded or f"excluded by {entry.who} on {entry.when}: {entry.why}"
        elif isinstance(entry, FlagStretch):
            flags.append(Flagged(channel=entry.channel, window=entry.window, flag=entry.flag, reason=reason))
        elif isinstance(entry, Trim):
            window = Review(window=window).within(entry.window)
        elif isinstance(entry, Correct):
            factors[entry.channel] = factors.get(entry.channel, 1.0) * entry.factor
    sentences = tuple(entry.said for entry in entries)
    return Review(excluded=excluded, window=window, flags=tuple(flags), factors=factors, sentences=sentences)


def read_review(folder: Path, tests: Mapping[str, Test], setups: Mapping[str, Setup]) -> dict[str, Review]:
    """Read the review.toml of a folder, if there is one, by test; a CampaignError has a line for each problem."""
    path = folder / FILE_NAME
    if not path.exists():
        return {}
    try:
        source = read(inside(folder, FILE_NAME))
    except ValueError as error:
        raise CampaignError(f"{FILE_NAME}: {error}") from None
    review, problems = validated(ReviewFile, source.document, folder)
    if review is not None:
        problems = list(_problems(review, tests, setups))
    if problems or review is None:
        raise refusal(source.paragraphs(problems))
    entries = [entry for _, entry in review.entries()]
    concerned = dict.fromkeys(name for entry in entries for name in entry.tests)
    return {name: decided([entry for entry in entries if name in entry.tests]) for name in concerned}


def _problems(
    review: ReviewFile, tests: Mapping[str, Test], setups: Mapping[str, Setup]
) -> Iterator[tuple[Place, str]]:
    """Find names that refer to nothing."""
    for place, entry in review.entries():
        for test in entry.tests:
            yield from unknown((*place, "test"), "test", test, tests)
            channel = getattr(entry, "channel", None)
            if test in tests and channel:
                setup = tests[test].setup
                where = f' in set-up "{setup}" of {test}'
                yield from unknown((*place, "channel"), "channel", channel, setups[setup].channels, where)
