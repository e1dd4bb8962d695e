"""What the page of one test shows, put together from its sections, and what was done."""

from __future__ import annotations

import re
from pathlib import Path, PurePosixPath
from typing import Any

from colonnade.figures.restitution.estimators import estimate_rows
from colonnade.figures.stored.subject import OfTest
from colonnade.report import specimens_page
from colonnade.report.asked import Photos
from colonnade.report.rows import TestRow
from colonnade.report.test_page import base, channels, facts, found
from colonnade.report.test_page.facts import Fact, known
from colonnade.store.layout import Layout
from colonnade.store.records.stored import Stored
from colonnade.units.text import number, quantity


def of_test(one: OfTest, photos: Photos) -> dict[str, Any]:
    """Put all that is stored of a test into words and figures, by the names that its template uses."""
    campaign, test, stored = one.campaign, one.test, one.stored
    return {
        "subject": one,
        "row": TestRow.of(one),
        "stored": stored,
        "review": stored.texts("ingest", "review") or list(campaign.review(test.id).sentences),
        "photos": photos,
        "done": [*facts.who_and_when(campaign.but(tests={test.id: test})), *done_of(one)],
        "notes": notes_of(stored),
        "setup": specimens_page.drawing_of(campaign, test.specimen, test.setup),
        "found": found.of_test(one),
        "bodies": found.bodies_of(one.record),
        "table": base.of_test(one),
        "spread": found.verdicts_of(one.record),
        "decay": found.facts_of(stored, one.record.restitution),
        "estimates": estimate_rows(stored),
        "peaks": found.peaks_of(stored),
        "channels": channels.of_test(stored),
    }


def done_of(one: OfTest) -> list[Fact]:
    """Say what was asked for and when the file says that it was recorded."""
    test, record, stored = one.test, one.record, one.stored
    place = f"NetCDF files in {Layout(Path()).test(test.id).as_posix()}/, next to the folder of the report, not in it"
    return known(
        [
            ("recorded", stored.text("ingest", "recorded_at")),
            ("set-up", test.setup),
            ("motion", test.motion or ""),
            ("Span", "" if test.span is None else str(test.span)),
            ("time scale", number(test.time_scale)),
            ("frequency", quantity(test.frequency, "Hz")),
            ("Ω = ω/p", number(record.frequency_ratio, 4)),
            ("A = a/(g tan α)", number(record.amplitude_ratio, 4)),
            ("part of the file", _interval(test.window) or "all"),
            ("zero from", _interval(test.zero) if isinstance(test.zero, tuple) else test.zero),
            ("notes", test.notes or ""),
            ("results", place if stored.datasets else ""),  # no link: it would be broken once the report is moved alone
        ]
    )


def _interval(given: tuple[float, float] | None) -> str:
    return f"{given[0]:g} s to {given[1]:g} s" if given is not None else ""


def notes_of(stored: Stored) -> list[str]:
    """Split the notes on the files, each of which begins with the name of its file; a note may hold a semicolon."""
    names = "|".join(re.escape(PurePosixPath(path).name) for path in stored.raw_files)
    return list(filter(None, re.split(f"; (?=(?:{names}): )", stored.text("ingest", "notes"))))
