"""The page of one test, put together from its sections, and what was done."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from colonnade.campaign import Campaign
from colonnade.report import specimens_page
from colonnade.report.asked import Photos
from colonnade.report.pictures.subjects import OfTest
from colonnade.report.rows import TestRow
from colonnade.report.specimens_page import Drawing
from colonnade.report.test_page import base, channels, facts, found, restitution
from colonnade.report.test_page.base import Table
from colonnade.report.test_page.channels import ChannelRow
from colonnade.report.test_page.facts import Fact, known
from colonnade.report.test_page.found import Bodies, Found
from colonnade.report.test_page.restitution import Decay
from colonnade.store.layout import Layout
from colonnade.store.records.stored import Stored
from colonnade.units.text import number, quantity


@dataclass(frozen=True)
class TestPage:
    """What the page of a test shows, a field for each section; its pictures are of `subject`."""

    __test__ = False  # pytest takes a class of this name for a test

    subject: OfTest
    row: TestRow
    stored: Stored
    review: list[str]
    photos: Photos
    done: Done
    drawing: Drawing
    found: Found
    bodies: Bodies
    base: Table
    spread: list[str]
    decay: Decay
    channels: tuple[ChannelRow, ...]


def of_test(campaign: Campaign, row: TestRow, stored: Stored, shown: Photos) -> TestPage:
    """Put all that is stored of a test into words and figures."""
    test, block = row.test, campaign.block(row.test.specimen)
    subject = OfTest(campaign, row, stored)
    return TestPage(
        subject=subject,
        row=row,
        stored=stored,
        review=stored.texts("ingest", "review") or list(campaign.review(test.id).sentences),
        photos=shown,
        done=done_of(row, stored, facts.who_and_when_of_test(campaign, test)),
        drawing=specimens_page.drawing_of(campaign, test.specimen, test.setup),
        found=found.of_test(subject),
        bodies=found.bodies_of(row.record),
        base=base.of_test(campaign, row, stored, block),
        spread=found.verdicts_of(row.record),
        decay=restitution.decay_of(subject),
        channels=channels.of_test(stored),
    )


@dataclass(frozen=True)
class Done:
    """`facts` of the campaign file; `notes` on the raw files."""

    facts: list[Fact]
    notes: list[str]


def done_of(row: TestRow, stored: Stored, who_and_when: list[Fact]) -> Done:
    """Say where, when and by whom the test was done, what was asked for, and what the readers noted."""
    recorded = ("recorded", stored.text("ingest", "recorded_at"))
    return Done([*who_and_when, *known([recorded, *_facts(row), ("results", _place(row, stored))])], _notes(stored))


def _place(row: TestRow, stored: Stored) -> str:
    """Say where the results are: a link would be broken as soon as the report is moved alone."""
    if not stored.datasets:
        return ""
    return f"NetCDF files in {Layout(Path()).test(row.id).as_posix()}/, next to the folder of the report, not in it"


def _facts(row: TestRow) -> list[Fact]:
    test = row.test
    return [
        ("set-up", test.setup),
        ("motion", test.motion or ""),
        ("Span", "" if test.span is None else str(test.span)),
        ("time scale", number(test.time_scale)),
        ("frequency", quantity(test.frequency, "Hz")),
        ("Ω = ω/p", number(row.record.frequency_ratio, 4)),
        ("A = a/(g tan α)", number(row.record.amplitude_ratio, 4)),
        ("part of the file", _interval(test.window) or "all"),
        ("zero from", _interval(test.zero) if isinstance(test.zero, tuple) else test.zero),
        ("notes", test.notes or ""),
    ]


def _interval(given: tuple[float, float] | None) -> str:
    return f"{given[0]:g} s to {given[1]:g} s" if given is not None else ""


def _notes(stored: Stored) -> list[str]:
    """Split the notes on the files, each of which begins with the name of its file; a note may hold a semicolon."""
    names = "|".join(re.escape(PurePosixPath(path).name) for path in stored.raw_files)
    return list(filter(None, re.split(f"; (?=(?:{names}): )", stored.text("ingest", "notes"))))
