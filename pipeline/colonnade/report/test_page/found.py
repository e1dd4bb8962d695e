"""What was found: the measured motion in numbers, and the figure of the whole record."""

from __future__ import annotations

from dataclasses import dataclass
from math import isnan

from colonnade.dynamics.size import at_prototype
from colonnade.figures.files.output import Picture
from colonnade.figures.stored import record
from colonnade.report.pictures.registry import picture
from colonnade.report.pictures.subjects import OfTest
from colonnade.report.rows import TestRow
from colonnade.report.test_page.facts import Fact, known
from colonnade.store.records.stored import Stored
from colonnade.store.records.test import driven_by, largest_motion, predicted_peak_time
from colonnade.store.records.wording import order
from colonnade.units.text import NOTHING, acceleration, quantity, ratio


@dataclass(frozen=True)
class Found:
    """
    The measured motion and the predicted ones.

    `record` is None if there is nothing to draw; `predicted_times` are when each model's largest angle or its
    overturning is, s.
    """

    facts: list[Fact]
    record: Picture | None
    predicted_times: dict[str, float]


def of_test(subject: OfTest) -> Found:
    """Say what was measured, and draw it with what the models predict."""
    row, stored = subject.row, subject.stored
    return Found(
        known(_facts(row, stored, subject.campaign.specimens[row.test.specimen].scale)),
        picture("record", subject),
        {model: predicted_peak_time(stored, model) for model in stored.models("predict")},
    )


def _facts(row: TestRow, stored: Stored, scale: float | None) -> list[Fact]:
    is_free = row.test.kind == "free-vibration"
    error = quantity(stored.median("rocking", "rocking_angle_standard_error"), "mrad", 2)
    return [
        (
            "largest |θ|, release included" if is_free else "largest |θ|",
            ""
            if row.record.outcome == "overturned"
            else quantity(abs(stored.value("rocking", "peak_angle")), "mrad", 4),
        ),
        ("released at |θ|/α", ratio(row.record.release_ratio)),
        ("predictions use", driven_by(stored) if is_free else ""),
        ("overturned at", quantity(stored.value("rocking", "overturning_time"), "s", 4)),
        ("peak base acceleration", acceleration(row.record.pga)),
        ("standard error of θ", error),
        *_other_motions(stored),
        ("noise threshold", quantity(stored.value("rocking", "noise_threshold"), "mrad", 2)),
        ("measured", stored.text("rocking", "separation")),
        ("order of the response", order(row.record.order) or row.record.order_reason or ""),
        (f"at prototype scale, 1:{scale:g}" if scale else "", _at_prototype(row, stored, scale) if scale else ""),
    ]


def _other_motions(stored: Stored) -> list[Fact]:
    """Give the largest of each motion besides the rocking angle, with its standard error."""
    facts = []
    for name, words, _, unit in record.MOTIONS:
        largest = largest_motion(stored, name)
        if not isnan(largest):
            error = quantity(stored.median("rocking", f"{name}_standard_error"), unit, 2)
            facts.append((f"largest {words}", f"{quantity(largest, unit, 3)}, standard error {error}"))
    return facts


def _at_prototype(row: TestRow, stored: Stored, scale: float) -> str:
    """Say what the test means for the specimen that the model stands for."""
    if row.record.prototype is None:
        return ""
    base = at_prototype("length", largest_motion(stored, "base_displacement"), scale)
    parts = (
        ("duration", row.record.prototype.duration, "s"),
        ("frequency", row.record.prototype.frequency, "Hz"),
        ("largest slide", row.record.prototype.peak_slide, "mm"),
        ("largest base displacement", base, "mm"),
    )
    known = ((name, quantity(value, unit)) for name, value, unit in parts)
    return ", ".join(f"{name} {text}" for name, text in known if text != NOTHING)
