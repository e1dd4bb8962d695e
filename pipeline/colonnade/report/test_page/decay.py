"""The restitution of a free vibration: e from every estimator, the peaks, and the figures behind them."""

from __future__ import annotations

from dataclasses import dataclass

from colonnade.dynamics.block import Block
from colonnade.figures.output import Picture
from colonnade.figures.restitution.estimators import EstimateGroup
from colonnade.figures.stored import restitution as pictures
from colonnade.report import restitution
from colonnade.report.restitution import EstimateText
from colonnade.report.rows import TestRow
from colonnade.report.test_page.facts import Fact
from colonnade.store.records.stored import Stored

PEAK = ("peak_time", "peak_angle", "peak_angle_standard_error", "fitted_angle", "peak_used")
"""Columns of the table of peaks, by their stored names."""


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


def of_test(row: TestRow, stored: Stored, block: Block) -> Decay:
    """Put what is stored of a test's restitution into words and figures."""
    return Decay(
        facts=restitution.facts_of(stored, row.record.restitution),
        estimates=restitution.estimates_of(stored),
        departures=stored.texts(pictures.STAGE, "departures"),
        peaks=list(zip(*(stored.array(pictures.STAGE, name).tolist() for name in PEAK), strict=True)),
        pictures=_pictures(row, stored, block),
    )


def _pictures(row: TestRow, stored: Stored, block: Block) -> dict[str, Picture | None]:
    test, name = row.test, row.id
    peaks, impacts = pictures.peak_series(test, stored, block), pictures.impact_series(test, stored)
    estimates = [EstimateGroup("", pictures.estimate_rows(stored))]
    level = pictures.level_of(stored, pictures.STAGE, "e identified")
    return {
        "fitted": pictures.fitted(test, stored, block),
        "estimators": pictures.estimators(f"estimators-{name}", estimates, block.restitution),
        "peaks": pictures.peaks(f"peaks-{name}", [peaks] if peaks else [], block),
        "impacts": pictures.impacts(f"impacts-{name}", [impacts] if impacts else [], level, block.restitution),
        "region": pictures.region(test, stored),
    }
