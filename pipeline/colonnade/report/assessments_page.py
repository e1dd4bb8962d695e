"""What the page of the real columns shows: of each assessment the answer, its curves, and what decides it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from colonnade.arrays import Array
from colonnade.assessment.criteria import CRITERIA, Criterion
from colonnade.assessment.measures import measure_of
from colonnade.assessment.study import counted_draws
from colonnade.campaign import Campaign
from colonnade.campaign.forms.assessed import AssessmentSummary, Estimate, JudgedCriterion, RecordUsed
from colonnade.campaign.forms.summary import Summary, Warned
from colonnade.errors import StoreError
from colonnade.figures import fragility as figures
from colonnade.figures.files.output import Picture
from colonnade.findings import at_stage, warning
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.assessment import estimated, level, sentences, unit_of
from colonnade.units import from_si
from colonnade.units.text import listed, number

SHOWN = ("pga", "pgv", "arias", "d5_95", "pulse_period")
"""Measures of the table of records."""

ROWS = (0.02, 0.1, 0.25, 0.5, 0.75, 0.95)
"""Probabilities about which the levels of the twenty columns are chosen."""


class AssessmentShown(NamedTuple):
    """One assessment: its record, the answer in words, and its pictures."""

    name: str
    record: AssessmentSummary
    answer: list[str]
    columns: Picture | None
    curves: Picture | None
    rate: Picture | None
    spectra: Picture | None

    @property
    def symbol(self) -> str:
        """Symbol of its measure."""
        return symbol(self.record.measure)

    def level(self, value: float | None) -> str:
        """Write a value of its measure."""
        return level(self.record.measure, value)

    def estimated(self, value: Estimate) -> str:
        """Write a value of its measure with its interval."""
        return estimated(self.record.measure, value)

    def criteria(self) -> list[tuple[Criterion, JudgedCriterion]]:
        """Give the criteria of practice with what was counted."""
        known = {each.id: each for each in CRITERIA}
        return [(known[each.criterion], each) for each in self.record.criteria if each.criterion in known]

    def warned(self) -> list[Warned]:
        """Give its warnings as those of a test."""
        found = (warning("assessment", said) for said in self.record.warnings)
        return [Warned.of(each, explained=False) for each in at_stage(found, "assessment")]

    def heads(self) -> list[str]:
        """Heads of the measures in the table of records, marked as those of numbers."""
        return [f"#{_label(name)}" for name in self._measures()]

    def row(self, used: RecordUsed) -> list[str]:
        """Measures of a record."""
        return [_plain(name, used.measures[name]) for name in self._measures()]

    def _measures(self) -> list[str]:
        known = self.record.records_used[0].measures if self.record.records_used else {}
        return [name for name in dict.fromkeys((*SHOWN, self.record.measure)) if name in known]


def assessments_page(campaign: Campaign, layout: Layout, summary: Summary | None) -> list[AssessmentShown]:
    """Gather the assessments that were made or failed, in the order of the campaign file."""
    if summary is None:
        return []
    return [
        _shown(layout, name, summary.assessments[name]) for name in campaign.assessments if name in summary.assessments
    ]


def symbol(measure: str) -> str:
    """Symbol of a measure."""
    return measure_of(measure).symbol


def _label(measure: str) -> str:
    unit = unit_of(measure)
    return f"{symbol(measure)} ({unit})" if unit else symbol(measure)


def _plain(measure: str, value: float | None) -> str:
    """Write a value without its unit, which is in the head."""
    unit = unit_of(measure)
    return number(value if value is None or not unit else from_si(value, unit))


def _shown(layout: Layout, name: str, record: AssessmentSummary) -> AssessmentShown:
    try:
        stored = files.read(layout.stage(name, "assessment"))
    except StoreError:
        stored = None
    if record.status == "failed" or stored is None:
        return AssessmentShown(name, record, sentences(record), None, None, None, None)
    return AssessmentShown(
        name,
        record,
        sentences(record),
        _columns(name, record, stored),
        curves(name, record, stored),
        _rate(name, record, stored),
        _spectra(name, stored),
    )


def _curve(stored: xr.Dataset, kind: str, over: str, factor: float) -> figures.Curve:
    bands = (stored[f"{kind}_probability{end}"].to_numpy() for end in ("", "_low", "_high"))
    return figures.Curve(stored[over].to_numpy() / factor, *bands)


def _factor(record: AssessmentSummary) -> float:
    """SI value of one unit in which the measure is shown."""
    unit = unit_of(record.measure)
    return 1.0 / from_si(1.0, unit) if unit else 1.0


def curves(name: str, record: AssessmentSummary, stored: xr.Dataset) -> Picture:
    """Draw the curves of an assessment that was made."""
    factor, counted = _factor(record), counted_draws(stored.sizes["draw"])
    outcome, overturned = (stored[f"case_{name}"].to_numpy()[:, :, counted] for name in ("outcome", "overturned"))
    run = (outcome >= 0).sum(axis=(0, 2, 3, 4))
    shares = overturned.sum(axis=(0, 2, 3, 4)) / np.maximum(run, 1)
    isotonic = _curve(stored, "isotonic", "stripe_intensity", factor)
    lognormal = None if record.median.value is None else _curve(stored, "lognormal", "curve_intensity", factor)
    drawn = figures.fragility(
        lognormal,
        isotonic,
        label=_label(record.measure),
        taken=record.curve or "isotonic",
        shares=shares if shares.size == isotonic.intensity.size else None,
    )
    five, fifty = (estimated(record.measure, each) for each in (record.five_percent, record.fifty_percent))
    described = f"Probability of overturning over {_label(record.measure)}: 5 % at {five}, 50 % at {fifty}."
    return Picture(drawn, f"fragility-{name}", f"Probability of overturning, {name}", described)


def _columns(name: str, record: AssessmentSummary, stored: xr.Dataset) -> Picture | None:
    over, probability = _taken(record, stored)
    reached = [float(np.interp(share, probability, over)) for share in ROWS if probability[-1] >= share]
    levels = list(dict.fromkeys(float(f"{value:.2g}") for value in reached))
    if not levels:
        return None
    shares = np.interp(levels, over, probability)
    texts = [f"{symbol(record.measure)} {number(value)} {unit_of(record.measure)}".strip() for value in levels]
    drawn = figures.twenty_columns(texts, shares)
    said = [f"{text}: {round(figures.COLUMNS * float(share))}" for text, share in zip(texts, shares, strict=True)]
    title = f"How many of {figures.COLUMNS} such columns fall, {name}"
    return Picture(drawn, f"columns-{name}", title, f"{listed(said)} of {figures.COLUMNS} fall.")


def _taken(record: AssessmentSummary, stored: xr.Dataset) -> tuple[Array, Array]:
    """The curve from which the answer is read, in the unit that is shown."""
    lognormal = record.curve == "lognormal"
    kind, over = ("lognormal", "curve_intensity") if lognormal else ("isotonic", "stripe_intensity")
    curve = _curve(stored, kind, over, _factor(record))
    return curve.intensity, curve.probability


def _spectra(name: str, stored: xr.Dataset) -> Picture:
    found = from_si(1.0, "g") * stored["record_spectrum"].to_numpy().reshape(-1, stored.sizes["period"])
    found = found[np.isfinite(found).all(axis=1)]
    drawn = figures.response_spectra(stored["spectrum_period"].to_numpy(), found)
    described = f"Response spectra of {len(found)} components before scaling, damped by 5 %, and their median."
    return Picture(drawn, f"spectra-{name}", f"Response spectra of the ground motions, {name}", described)


def _rate(name: str, record: AssessmentSummary, stored: xr.Dataset) -> Picture | None:
    if "rate_share" not in stored:
        return None
    edges, shares = stored["rate_edge"].to_numpy() / _factor(record), stored["rate_share"].to_numpy()
    largest = int(np.argmax(shares))
    ends = f"{number(edges[largest])} to {number(edges[largest + 1])} {unit_of(record.measure)}".strip()
    described = f"The largest share of the rate is from {symbol(record.measure)} {ends}."
    drawn = figures.rate_by_intensity(edges, shares, label=_label(record.measure))
    return Picture(drawn, f"rate-{name}", f"Which intensities make the annual rate, {name}", described)
