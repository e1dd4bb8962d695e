"""What the page of one test shows: what was done and found, its bodies, each model's spread, and the restitution."""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import hypot, isnan, nan
from pathlib import Path, PurePosixPath
from typing import Any

from colonnade.campaign.forms.summary import BodyPrediction, PredictionSummary, TestSummary
from colonnade.dynamics.size import at_prototype
from colonnade.figures.restitution.decay import STAGE
from colonnade.figures.restitution.estimators import estimate_rows
from colonnade.figures.stored.record import MOTIONS
from colonnade.figures.stored.subject import OfTest
from colonnade.identification.response.rank import FEWEST, is_within
from colonnade.report import specimens_page
from colonnade.report.asked import Photo
from colonnade.report.overview import TestRow
from colonnade.report.pictures import value_of
from colonnade.report.test_page import base, channels, facts
from colonnade.report.test_page.facts import Fact, known
from colonnade.store.layout import Layout
from colonnade.store.records.stored import Stored
from colonnade.store.records.test import driven_by, largest_motion
from colonnade.store.records.wording import order
from colonnade.units.text import (
    NOTHING,
    acceleration,
    format_percent,
    number,
    quantity,
    ratio,
)


def of_test(one: OfTest, photos: Sequence[Photo]) -> dict[str, Any]:
    """Put all that is stored of a test into words and figures, by the names that its template uses."""
    campaign, test, stored = one.campaign, one.test, one.stored
    return {
        "subject": one,
        "row": TestRow.of(campaign, test, one.record, one.failures),
        "stored": stored,
        "review": stored.texts("ingest", "review") or list(campaign.review(test.id).sentences),
        "photos": photos,
        "done": [*facts.who_and_when(campaign.but(tests={test.id: test})), *done_of(one)],
        "notes": notes_of(stored),
        "setup": specimens_page.drawing_of(campaign, test.specimen, test.setup),
        "found": measured_of(one),
        "bodies": bodies_of(one.record),
        "table": base.of_test(one),
        "spread": [said for each in one.record.predicted.items() if (said := verdict_sentence(*each))],
        "decay": facts_of(one),
        "estimates": estimate_rows(stored),
        "peaks": peaks_of(stored),
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


def measured_of(one: OfTest) -> list[Fact]:
    """Say what was measured."""
    record, stored, scale = one.record, one.stored, one.specimen.scale
    is_free, has_fallen = one.test.kind == "free-vibration", record.outcome == "overturned"
    largest = quantity(abs(stored.value("rocking", "peak_angle")), "mrad", 4)
    return known(
        [
            ("largest |θ|, release included" if is_free else "largest |θ|", "" if has_fallen else largest),
            ("released at |θ|/α", ratio(record.release_ratio)),
            ("predictions use", driven_by(stored) if is_free else ""),
            ("overturned at", quantity(stored.value("rocking", "overturning_time"), "s", 4)),
            ("peak base acceleration", acceleration(record.pga)),
            ("standard error of θ", quantity(stored.median("rocking", "rocking_angle_standard_error"), "mrad", 2)),
            *_other_motions(stored),
            ("noise threshold", quantity(stored.value("rocking", "noise_threshold"), "mrad", 2)),
            ("measured", stored.text("rocking", "separation")),
            ("order of the response", order(record.order) or record.order_reason or ""),
            (
                f"at prototype scale, 1:{scale:g}" if scale else "",
                _at_prototype(record, stored, scale) if scale else "",
            ),
        ]
    )


def _other_motions(stored: Stored) -> list[Fact]:
    """Give the largest of each motion besides the rocking angle, with its standard error."""
    facts = []
    for name, title, _, unit in MOTIONS:
        largest = largest_motion(stored, name)
        if not isnan(largest):
            error = quantity(stored.median("rocking", f"{name}_standard_error"), unit, 2)
            facts.append((f"largest {title.lower()}", f"{quantity(largest, unit, 3)}, standard error {error}"))
    return facts


def _at_prototype(record: TestSummary, stored: Stored, scale: float) -> str:
    """Say what the test means for the specimen that the model stands for."""
    if record.prototype is None:
        return ""
    base = at_prototype("length", largest_motion(stored, "base_displacement"), scale)
    parts = (
        ("duration", record.prototype.duration, "s"),
        ("frequency", record.prototype.frequency, "Hz"),
        ("largest slide", record.prototype.peak_slide, "mm"),
        ("largest base displacement", base, "mm"),
    )
    known = ((name, quantity(value, unit)) for name, value, unit in parts)
    return ", ".join(f"{name} {text}" for name, text in known if text != NOTHING)


FINEST = 5
"""Decimals of displacements in m and of turns in rad that are shown."""


def bodies_of(record: TestSummary) -> list[tuple[str, ...]]:
    """
    Put what is known of each body into rows, from the top to the bottom as they stand.

    Its name, who says it, outcome, largest angle, how far its joint opened and when; then where it stands at the end.
    """
    rows = list[tuple[str, ...]]()
    for name, body in reversed(record.bodies.items()):
        opened = quantity(body.opening, "mm"), quantity(body.opening_time, "s", 4)
        rows.append((name, "measured", body.outcome or "not measured", ratio(body.peak_ratio), *opened, *_place(body)))
        for model, each in body.predicted.items():
            said = each.outcome or "not measured"
            rows.append(("", f"{model} model", said, ratio(each.peak_ratio), "", "", *_place(each)))
            if each.overturning_probability is not None:
                low, high = (number(None if end is None else 1e3 * end) for end in (each.moved_low, each.moved_high))
                band = "" if each.moved_low is None else f"{low} to {high} mm"
                falls = f"{format_percent(each.overturning_probability)} overturn"
                rows.append(("", "its runs", falls, "", "", "", band, "", ""))
    return rows


def _place(body: BodyPrediction) -> tuple[str, str, str]:
    """Write how far a body has moved for good, along x and y, and how far it has turned; a fallen one has no place."""
    if body.outcome == "overturned":
        return NOTHING, f"{NOTHING}, {NOTHING}", NOTHING
    x, y, yaw = (
        None if each is None else round(each, FINEST) for each in (body.residual_x, body.residual_y, body.residual_yaw)
    )
    far = None if x is None or y is None else round(hypot(x, y), FINEST)
    along = ", ".join(number(None if each is None else 1e3 * each) for each in (x, y))
    return quantity(far, "mm"), along, quantity(yaw, "mrad")


def verdict_sentence(model: str, predicted: PredictionSummary) -> str:
    """Say whether the measured angle is within the model's own spread, up to its horizon."""
    if predicted.horizon is None:
        return ""
    name, until = f"{model.capitalize()} model", quantity(predicted.horizon, "s", 4)
    rank = predicted.within_spread
    within = is_within(nan if rank is None else rank)
    if within is None:
        return f"{name}: predicted up to {until}; not ranked: that needs {FEWEST} runs and a measured angle."
    said = [f"{format_percent(rank or 0.0)} of the runs are closer to their median"]
    if predicted.peak_rank is not None:
        said.append(f"{format_percent(predicted.peak_rank)} stay below the measured peak")
    if predicted.overturning_probability:
        said.append(f"{format_percent(predicted.overturning_probability)} overturn")
    where = "within" if within else "outside"
    return f"{name}: the measured angle is {where} its own spread up to {until} ({'; '.join(said)})."


def facts_of(one: OfTest) -> list[Fact]:
    """Give e of a free vibration, by which estimator, or why it was refused."""
    stored = one.stored
    chosen = next((each for each in estimate_rows(stored) if each.recommended), None)
    facts = [
        ("e", value_of(one)),
        ("refused", stored.text(STAGE, "reason")),
        ("from", chosen.name if chosen else ""),
        ("method", stored.text(STAGE, "method")),
        ("rest angle subtracted", quantity(stored.value(STAGE, "zero_offset"), "mrad", 2)),
    ]
    return known(facts)


PEAK = ("peak_time", "peak_angle", "peak_angle_standard_error", "fitted_angle", "peak_used")
"""Columns of the table of peaks, by their stored names."""


def peaks_of(stored: Stored) -> list[tuple[float, ...]]:
    """Give number, time, angle, standard error, fitted angle and use of each peak."""
    columns = (stored.array(STAGE, name).tolist() for name in PEAK)
    return [(number, *peak) for number, peak in enumerate(zip(*columns, strict=True), 1)]
