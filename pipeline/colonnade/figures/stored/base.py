"""The recorded base motion of a test, the motion that it was to follow, and the response spectra of both."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.block import Block
from colonnade.dynamics.spectra import DAMPING, response_spectrum
from colonnade.figures.base_motion import BaseSpectra, base_motion
from colonnade.figures.files.output import Picture
from colonnade.figures.panels.curve import Curve
from colonnade.signals.named_motion import Laid, Series, laid_on
from colonnade.stages.parts.reference_motions import ReferenceMotionFile, load, reference_files
from colonnade.store.records.stored import Stored
from colonnade.units.text import format_percent, number, quantity

SHORTEST, LONGEST = 0.02, 4.0
"""Periods of the spectra, s; no shorter than `FEWEST` samples, no longer than a quarter of the record."""

FEWEST = 8

PERIODS = 70

WITHOUT_SPECTRUM = ("free-vibration", "tilt", "sine")
"""Kinds of test whose table stands, or whose spectrum is one line."""


@dataclass(frozen=True)
class BaseMotion:
    """Acceleration of the base (m/s²) at the times `time` (s), and the target laid on it, None without one."""

    time: Array
    acceleration: Array
    target: Laid | None

    @property
    def interval(self) -> float:
        """Of the samples, s."""
        return float(self.time[-1] - self.time[0]) / (self.time.size - 1)


def base_of(campaign: Campaign, test: Test, stored: Stored) -> BaseMotion | None:
    """Return the recorded base motion with its target; None if the table's motion was not recorded throughout."""
    time, acceleration = stored.array("rocking", "elapsed"), stored.array("rocking", "base_acceleration")
    if acceleration.size < 2 * FEWEST or not np.isfinite(acceleration).all() or test.kind in ("free-vibration", "tilt"):
        return None
    base = BaseMotion(time, acceleration, None)
    reference = _reference(campaign, test.motion)
    if reference is None or not acceleration.any():
        return base
    return BaseMotion(
        time, acceleration, laid_on(Series(acceleration, base.interval), reference, time_scale=test.time_scale)
    )


def picture(test: Test, base: BaseMotion | None, block: Block) -> Picture | None:
    """Draw what the table did and was to do; None for a motion without a spectrum worth drawing."""
    if base is None or test.kind in WITHOUT_SPECTRUM or not base.acceleration.any():
        return None
    spectra = _spectra(base)
    target = base.target
    said = [f"Largest achieved response {quantity(float(spectra.achieved.max()), 'm/s²')}."]
    if target is not None and spectra.target is not None:
        ratio = spectra.achieved / spectra.target
        said.append(f"Achieved over target {number(float(ratio.min()))} to {number(float(ratio.max()))}.")
    return Picture(
        base_motion(
            Curve(base.time, base.acceleration),
            None if target is None else Curve(base.time, target.acceleration),
            spectra,
            uplift=block.uplift_acceleration,
        ),
        f"base-{test.id}",
        f"{test.id}: acceleration of the table and its response spectrum of {format_percent(DAMPING)} damping",
        " ".join(said),
    )


def _spectra(base: BaseMotion) -> BaseSpectra:
    length = base.interval * base.time.size
    shortest = max(SHORTEST, FEWEST * base.interval)
    period = np.geomspace(shortest, max(min(LONGEST, length / 4), 2 * shortest), PERIODS)
    achieved = response_spectrum(base.acceleration, base.interval, period).pseudo_acceleration
    if base.target is None:
        return BaseSpectra(period, achieved, None)
    target = response_spectrum(base.target.acceleration, base.interval, period).pseudo_acceleration
    return BaseSpectra(period, achieved, target)


def _reference(campaign: Campaign, motion: str | None) -> Series | None:
    """Return the motion that a test names, None if it is not known or cannot be read."""
    known = {name.casefold(): source for name, source in reference_files(campaign).items()}
    source = known.get((motion or "").casefold())
    return None if source is None else _loaded(source)


@lru_cache(maxsize=8)
def _loaded(source: ReferenceMotionFile) -> Series | None:
    return load({"target": source}, []).get("target")
