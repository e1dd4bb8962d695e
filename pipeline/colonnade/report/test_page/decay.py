"""The restitution of a free vibration: e from every estimator, the peaks, and the figures behind them."""

from __future__ import annotations

from dataclasses import dataclass

from colonnade.figures.files.output import Picture
from colonnade.figures.stored.restitution import STAGE
from colonnade.report.pictures.registry import picture
from colonnade.report.pictures.subjects import OfTest
from colonnade.report.test_page import restitution
from colonnade.report.test_page.facts import Fact
from colonnade.report.test_page.restitution import EstimateText

PEAK = ("peak_time", "peak_angle", "peak_angle_standard_error", "fitted_angle", "peak_used")
"""Columns of the table of peaks, by their stored names."""

FIGURES = ("fitted", "estimators", "peaks", "impacts", "region")
"""Names of the figures, in their order."""


@dataclass(frozen=True)
class Decay:
    """
    A free vibration; without facts the section is left out.

    `peaks` are time, angle, standard error, fitted angle and whether it was used; `pictures` are None if there is
    nothing to draw.
    """

    facts: list[Fact]
    estimates: list[EstimateText]
    departures: list[str]
    peaks: list[tuple[float, ...]]
    pictures: dict[str, Picture | None]


def of_test(subject: OfTest) -> Decay:
    """Put what is stored of a test's restitution into words and figures."""
    stored = subject.stored
    return Decay(
        facts=restitution.facts_of(stored, subject.row.record.restitution),
        estimates=restitution.estimates_of(stored),
        departures=stored.texts(STAGE, "departures"),
        peaks=list(zip(*(stored.array(STAGE, name).tolist() for name in PEAK), strict=True)),
        pictures={name: picture(name, subject) for name in FIGURES},
    )
