"""A test as its figures see it: what was asked and found, and the curves that are stored of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from colonnade.arrays import Array
from colonnade.assessment.ground import Ground, correction_of
from colonnade.campaign import Campaign, Test
from colonnade.campaign.forms.summary import TestSummary
from colonnade.campaign.specimen import Specimen
from colonnade.dynamics.block import Block
from colonnade.figures.histories import Spread
from colonnade.figures.panels.curve import Curve, known
from colonnade.store.records.stored import Failure, Stored
from colonnade.units import from_si

Shown = TypeVar("Shown")


DRIFTLESS = "highpass(0.2 Hz)"
"""What is slower in a displacement that is integrated from an acceleration is its drift, not the table."""

MOST = 12
"""Tests that are drawn side by side."""


def some_of(given: Sequence[Shown], what: str) -> tuple[Sequence[Shown], str]:
    """Return, of many tests, some that are spread evenly, and what the caption adds of it."""
    if len(given) <= MOST:
        return given, ""
    chosen = [given[index] for index in np.linspace(0, len(given) - 1, MOST).round().astype(int)]
    return chosen, f"{MOST} of {len(given)} {what} are drawn, spread evenly; each is drawn whole on its own page."


@dataclass(frozen=True)
class OfTest:
    """A test: its entry in the campaign file, its record, and what is stored of it."""

    campaign: Campaign
    test: Test
    record: TestSummary
    stored: Stored

    @property
    def failures(self) -> list[Failure]:
        """Why it failed; a failure that no result holds is the record's."""
        return self.stored.failures or (
            [Failure("", self.record.reason or "")] if self.record.status == "failed" else []
        )

    @property
    def specimen(self) -> Specimen:
        """The specimen that was tested."""
        return self.campaign.specimens[self.test.specimen]

    @property
    def block(self) -> Block:
        """Of its specimen."""
        return self.campaign.block(self.test.specimen)

    @property
    def sources(self) -> dict[str, tuple[str, str | None]]:
        """Stage and model of what was "measured", and of each model's prediction."""
        return {"measured": ("rocking", None)} | {model: ("predict", model) for model in self.stored.models("predict")}

    def measured_ratio(self, *, as_recorded: bool = False) -> Curve | None:
        """Return the measured θ/α about the zero of the predictions, or as recorded; None if it was not measured."""
        return self._ratio("rocking", as_recorded=as_recorded)

    def true_angle(self, measured: Array) -> Array:
        """Return a measured angle about the zero of the predictions, with the gain of a free vibration, rad."""
        offset, gain = (self.stored.value("compare", name) for name in ("zero_offset", "angle_gain"))
        return (measured - float(np.nan_to_num(offset))) / float(np.nan_to_num(gain, nan=1.0))

    def ratios(self) -> dict[str, Curve]:
        """Return θ/α as "measured" and by model."""
        found = {who: self._ratio(*source) for who, source in self.sources.items()}
        return known({who: curve for who, curve in found.items() if curve is not None})

    def _ratio(self, stage: str, model: str | None = None, *, as_recorded: bool = False) -> Curve | None:
        stored = self.stored
        if not stored.has(stage, "rocking_angle", model):
            return None
        time, angle = stored.array(stage, "elapsed", model), stored.array(stage, "rocking_angle", model)
        angle = self.true_angle(angle) if stage == "rocking" and not as_recorded else angle
        # An overturned test ends where it overturns: what a frame or a floor does to it then is no rocking.
        fall = stored.value(stage, "overturning_time", model)
        ended = time.size if np.isnan(fall) else int(np.searchsorted(time, fall)) + 1
        angle = np.where(np.arange(time.size) < ended, angle, np.nan)
        return Curve(time, angle / self.block.critical_angle_at(angle))

    def misfits(self) -> dict[str, Curve]:
        """Return predicted minus measured θ/α as far as the two are compared, by model."""
        curves, found = self.ratios(), {}
        measured = curves.get("measured")
        for model, curve in curves.items():
            until = self.stored.compared("compared_until", model)
            if measured is not None and curve.values.shape == measured.values.shape and np.isfinite(until):
                found[model] = Curve(curve.time, curve.values - measured.values).within(-np.inf, until)
        return known(found)

    def spreads(self) -> dict[str, Spread]:
        """Return the ensembles' bands of θ/α by model."""
        found = {}
        for model in self.stored.models("ensemble"):
            time, levels, angles = (
                self.stored.array("ensemble", name, model) for name in ("elapsed", "quantile", "rocking_angle_band")
            )
            overturning, horizon = (
                self.stored.value("ensemble", name, model) for name in ("overturning_probability", "horizon")
            )
            found[model] = Spread(time, levels, angles / self.block.critical_angle_at(angles), overturning, horizon)
        return found

    def motion(self, name: str, unit: str) -> Curve | None:
        """Return a motion over time in a unit, None if it was not measured."""
        values = self.stored.array("rocking", name)
        if not (values.ndim == 1 and np.isfinite(values).any()):
            return None
        return Curve(self.stored.array("rocking", "elapsed"), from_si(1.0, unit) * values)

    def base_displacement(self) -> tuple[Curve | None, str]:
        """Return the displacement of the base over time, m, and where it is from; None if its motion is not known."""
        recorded, acceleration = self.motion("base_displacement", "m"), self.motion("base_acceleration", "m/s²")
        if recorded is not None:
            return recorded, "recorded displacement"
        if acceleration is not None:
            time, values = acceleration
            values, interval = np.nan_to_num(values), float(time[-1] - time[0]) / (time.size - 1)
            driftless = correction_of(DRIFTLESS)(values - values.mean(), interval)
            moved = Ground(driftless, interval, at_rest=True).displacement
            return acceleration._replace(values=moved), "recorded acceleration integrated twice"
        return None, "not recorded, drawn at rest"

    def bodies(self, place: int, name: str) -> dict[str, Curve]:
        """Return what was "measured", and what each model predicts, of the body at a place: `body_…`, SI."""
        return known(
            {
                who: Curve(self.stored.array(stage, "elapsed", model), self.stored.array(stage, name, model)[place])
                for who, (stage, model) in self.sources.items()
                if self.stored.has(stage, name, model)
            }
        )
