"""The bodies of an assembly: what became of each, what moved for good, and what each model says of it."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

from colonnade.campaign.forms.summary import BodyPrediction
from colonnade.figures.files.output import Picture
from colonnade.report.pictures.registry import picture
from colonnade.report.pictures.subjects import OfTest
from colonnade.store.records.wording import by_bodies
from colonnade.units.text import format_percent, number, quantity, ratio

FINEST = 5
"""Decimals of displacements in m and of turns in rad that are shown."""


@dataclass(frozen=True)
class BodyRow:
    """A body as measured, or as a model has it: cells as they are shown."""

    name: str
    who: str
    outcome: str
    peak: str
    opening: str
    opened: str
    moved: str
    along: str
    turned: str
    separation: str


@dataclass(frozen=True)
class Bodies:
    """`rows` is empty for a single body; `answer` says in a sentence what became of them."""

    answer: str
    rows: list[BodyRow]
    joints: Picture | None
    plan: Picture | None


def of_test(subject: OfTest) -> Bodies:
    """Put what is known of each body into rows, from the top to the bottom as they stand."""
    record = subject.row.record
    rows = []
    for name, body in reversed(record.bodies.items()):
        opening, opened = quantity(body.opening, "mm"), quantity(body.opening_time, "s", 4)
        rows.append(_row(name, "measured", body, opening, opened, body.separation or ""))
        for model, each in body.predicted.items():
            rows.append(_row("", f"{model} model", each, "–", "–", ""))
            if each.overturning_probability is not None:
                low, high = (number(None if end is None else 1e3 * end) for end in (each.moved_low, each.moved_high))
                falls = format_percent(each.overturning_probability)
                band = "–" if each.moved_low is None else f"{low} to {high} mm"
                rows.append(BodyRow("", "its runs", f"{falls} overturn", "–", "–", "–", band, "–", "–", ""))
    return Bodies(by_bodies(record), rows, picture("joints", subject), picture("plan", subject))


def _row(name: str, who: str, body: BodyPrediction, opening: str, opened: str, separation: str) -> BodyRow:
    fell = body.outcome == "overturned"
    x, y = (None if each is None or fell else round(each, FINEST) for each in (body.residual_x, body.residual_y))
    far = None if x is None or y is None else round(hypot(x, y), FINEST)
    along = ", ".join(number(None if each is None else 1e3 * each) for each in (x, y))
    turned = quantity(None if fell or body.residual_yaw is None else round(body.residual_yaw, FINEST), "mrad")
    outcome = body.outcome or "not measured"
    return BodyRow(
        name, who, outcome, ratio(body.peak_ratio), opening, opened, quantity(far, "mm"), along, turned, separation
    )
