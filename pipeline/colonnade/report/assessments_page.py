"""What the page of the real columns shows: of each assessment the answer, its curves, and what decides it."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

import numpy as np
import xarray as xr

from colonnade.assessment.criteria import CRITERIA, Criterion
from colonnade.assessment.measures import measure_of
from colonnade.assessment.study import counted_draws
from colonnade.campaign import Campaign
from colonnade.campaign.forms.assessed import AssessmentSummary, JudgedCriterion, RecordUsed
from colonnade.campaign.forms.summary import Summary, Warned
from colonnade.errors import StoreError
from colonnade.figures import fragility as figures
from colonnade.figures.files.output import Picture
from colonnade.findings import Severity
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.assessment import estimated, sentences, unit_of
from colonnade.units import from_si
from colonnade.units.text import listed, number

SHOWN = ("pga", "pgv", "arias", "d5_95")
"""Measures of the table of records."""

ROWS = (0.02, 0.1, 0.25, 0.5, 0.75, 0.95)
"""Probabilities about which the levels of the twenty columns are chosen."""


@dataclass(frozen=True)
class Assessment:
    """One assessment: its record, and what is stored of it, None if it failed."""

    name: str
    record: AssessmentSummary
    stored: xr.Dataset | None

    @property
    def answer(self) -> list[str]:
        """The answer in words."""
        return sentences(self.record)

    def criteria(self) -> list[tuple[Criterion, JudgedCriterion]]:
        """Give the criteria of practice with what was counted."""
        known = {each.id: each for each in CRITERIA}
        return [(known[each.criterion], each) for each in self.record.criteria if each.criterion in known]

    def warned(self) -> list[Warned]:
        """Give its warnings as those of a test."""
        kind = stage = "assessment"
        return [Warned(severity=Severity.WARNING, kind=kind, text=each, stage=stage) for each in self.record.warnings]

    def heads(self) -> list[str]:
        """Heads of the measures in the table of records, marked as those of numbers."""
        return [f"#{_label(name)}" for name in self._measures()]

    def row(self, used: RecordUsed) -> list[str]:
        """Measures of a record, without the units, which are in the heads."""
        shown = ((used.measures[name], _factor(name)) for name in self._measures())
        return [number(None if value is None else factor * value) for value, factor in shown]

    def _measures(self) -> list[str]:
        known = self.record.records_used[0].measures if self.record.records_used else {}
        return [name for name in dict.fromkeys((*SHOWN, self.record.measure)) if name in known]

    def pictures(self) -> dict[str, Picture | None]:
        """Draw what it found, by the names that the template uses."""
        drawn = {"columns": _columns, "curves": curves, "spectra": _spectra}
        if self.stored is None:
            return dict.fromkeys(drawn)
        return {name: draw(self.name, self.record, self.stored) for name, draw in drawn.items()}


def assessments_page(campaign: Campaign, layout: Layout, summary: Summary | None) -> list[Assessment]:
    """Gather the assessments that were made or failed, in the order of the campaign file."""
    found = {} if summary is None else summary.assessments
    return [_assessment(layout, name, found[name]) for name in campaign.assessments if name in found]


def _assessment(layout: Layout, name: str, record: AssessmentSummary) -> Assessment:
    stored = None
    if record.status != "failed":
        with suppress(StoreError):
            stored = files.read(layout.stage(name, "assessment"))
    return Assessment(name, record, stored)


def symbol(measure: str) -> str:
    """Symbol of a measure."""
    return measure_of(measure).symbol


def _label(measure: str) -> str:
    return f"{symbol(measure)} ({unit_of(measure)})"


def _factor(measure: str) -> float:
    """Of the unit in which a measure is shown."""
    return from_si(1.0, unit_of(measure))


def _curve(record: AssessmentSummary, stored: xr.Dataset, kind: str) -> figures.Curve:
    over = _factor(record.measure) * stored["curve_intensity" if kind == "lognormal" else "stripe_intensity"].to_numpy()
    return figures.Curve(over, *(stored[f"{kind}_probability{end}"].to_numpy() for end in ("", "_low", "_high")))


def curves(name: str, record: AssessmentSummary, stored: xr.Dataset) -> Picture:
    """Draw the curves of an assessment that was made."""
    counted, isotonic = counted_draws(stored.sizes["draw"]), _curve(record, stored, "isotonic")
    outcome, overturned = (stored[f"case_{name}"].to_numpy()[:, :, counted] for name in ("outcome", "overturned"))
    run = (outcome >= 0).sum(axis=(0, 2, 3, 4))
    shares = overturned.sum(axis=(0, 2, 3, 4)) / np.maximum(run, 1)
    label = _label(record.measure)
    drawn = figures.fragility(
        None if record.median.value is None else _curve(record, stored, "lognormal"),
        isotonic,
        label=label,
        taken=record.curve or "isotonic",
        shares=shares if shares.size == isotonic.intensity.size else None,
    )
    five, fifty = (estimated(record.measure, each) for each in (record.five_percent, record.fifty_percent))
    described = f"Probability of overturning over {label}: 5 % at {five}, 50 % at {fifty}."
    return Picture(drawn, f"fragility-{name}", f"Probability of overturning, {name}", described)


def _columns(name: str, record: AssessmentSummary, stored: xr.Dataset) -> Picture | None:
    """Draw columns that fall by the curve from which the answer is read."""
    over, probability, *_ = _curve(record, stored, "lognormal" if record.curve == "lognormal" else "isotonic")
    reached = [float(np.interp(share, probability, over)) for share in ROWS if probability[-1] >= share]
    levels = list(dict.fromkeys(float(f"{value:.2g}") for value in reached))
    if not levels:
        return None
    shares = np.interp(levels, over, probability)
    texts = [f"{symbol(record.measure)} {number(value)} {unit_of(record.measure)}" for value in levels]
    drawn = figures.twenty_columns(texts, shares)
    said = [f"{text}: {round(figures.COLUMNS * float(share))}" for text, share in zip(texts, shares, strict=True)]
    title = f"How many of {figures.COLUMNS} such columns fall, {name}"
    return Picture(drawn, f"columns-{name}", title, f"{listed(said)} of {figures.COLUMNS} fall.")


def _spectra(name: str, _: AssessmentSummary, stored: xr.Dataset) -> Picture:
    found = from_si(1.0, "g") * stored["record_spectrum"].to_numpy().reshape(-1, stored.sizes["period"])
    found = found[np.isfinite(found).all(axis=1)]
    drawn = figures.response_spectra(stored["spectrum_period"].to_numpy(), found)
    described = f"Response spectra of {len(found)} components before scaling, damped by 5 %, and their median."
    return Picture(drawn, f"spectra-{name}", f"Response spectra of the ground motions, {name}", described)
