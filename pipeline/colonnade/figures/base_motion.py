"""What the table did against what it was to do: acceleration over time, response spectra and their ratio."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from colonnade.arrays import Array
from colonnade.campaign import Campaign
from colonnade.dynamics.spectra import DAMPING, response_spectrum
from colonnade.figures.files.output import Picture
from colonnade.figures.histories import draw_limit, largest_of, scale_symmetric, time_limits
from colonnade.figures.panels.curve import Curve, draw_curve
from colonnade.figures.panels.layout import BOTTOM, TOP, add_row, legend_above, plain_decades
from colonnade.figures.stored.subject import OfTest
from colonnade.figures.style import FAINT, FIT, LIMIT, MEASURED, is_narrow, styled, width
from colonnade.signals.named_motion import Laid, Series, laid_on
from colonnade.stages.parts.reference_motions import ReferenceMotionFile, load, reference_files
from colonnade.units.text import format_percent, number, quantity

HISTORY_HEIGHT, SPECTRUM_HEIGHT, BETWEEN = 1.3, 1.6, 0.62
"""Heights of the panels and the room between them, inches."""

APART = 0.8
"""Between the two lower panels, inches."""

TARGET: dict[str, Any] = {"color": FIT["color"], "linewidth": 2.6, "alpha": 0.45}
"""A broad line below the thin one of what was achieved: both are seen where they agree."""

LEAST_RATIO, LARGEST_RATIO = 0.2, 1.0
"""How far the axis of the ratio reaches to either side of 1, at least and at most."""


class BaseSpectra(NamedTuple):
    """Periods (s) and pseudo-accelerations (m/s²) of 5 % damping, achieved and of the target (None without one)."""

    period: Array
    achieved: Array
    target: Array | None


@styled()
def base_motion(achieved: Curve, target: Curve | None, spectra: BaseSpectra, *, uplift: float) -> Figure:
    """
    Draw the acceleration of a table (m/s²) over time (s), and below response spectra and, with a target, their ratio.

    The target is on the same clock; `uplift` is the base acceleration from which the block rocks.
    """
    panels = 1 if spectra.target is None else 2
    rows = panels if is_narrow() else 1
    lowest = TOP + HISTORY_HEIGHT + BETWEEN
    figure = Figure(figsize=(width(), lowest + rows * (SPECTRUM_HEIGHT + BETWEEN) - BETWEEN + BOTTOM))
    (history,) = add_row(figure, 1, TOP, HISTORY_HEIGHT, apart=0.0, below=0.0)
    lower = add_row(figure, panels, lowest, SPECTRUM_HEIGHT, apart=APART, below=BETWEEN)
    if target is not None:
        draw_curve(history, target, label="target", **TARGET)
    draw_curve(history, achieved, label="achieved", color=MEASURED["color"], linewidth=0.8)
    largest = largest_of(curve.values for curve in (achieved, target) if curve is not None) or 1.0
    scale_symmetric(history, largest)
    if uplift < 1.12 * largest:
        draw_limit(history, uplift, "g tan α")
    history.set(xlim=time_limits([achieved]), xlabel="time (s)", ylabel="acceleration\n(m/s²)")
    _draw_spectra(lower[0], spectra)
    if spectra.target is not None:
        _draw_ratio(lower[1], spectra.period, spectra.achieved / spectra.target)
    legend_above(figure, [history])
    return figure


def _draw_spectra(axes: Axes, spectra: BaseSpectra) -> None:
    if spectra.target is not None:
        axes.plot(spectra.period, spectra.target, **TARGET)
    axes.plot(spectra.period, spectra.achieved, color=MEASURED["color"], linewidth=1.0)
    axes.set_ylim(bottom=0)
    axes.set_ylabel(f"{format_percent(DAMPING)} damped response\n(m/s²)")
    _scale_periods(axes, spectra.period)


def _draw_ratio(axes: Axes, period: Array, ratio: Array) -> None:
    reach = min(max(LEAST_RATIO, 1.1 * float(np.abs(ratio - 1.0).max())), LARGEST_RATIO)
    axes.plot(period, np.clip(ratio, 1.0 - reach, 1.0 + reach), color=MEASURED["color"], linewidth=1.0)
    axes.axhline(1.0, **LIMIT)
    axes.axhspan(0.9, 1.1, color=FAINT, alpha=0.15, linewidth=0)
    axes.set(ylim=(1.0 - reach, 1.0 + reach), ylabel="achieved / target")
    _scale_periods(axes, period)


def _scale_periods(axes: Axes, period: Array) -> None:
    axes.set(xscale="log", xlim=(float(period[0]), float(period[-1])))
    plain_decades(axes.xaxis)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=5, steps=[1, 2, 5, 10]))
    axes.set_xlabel("period of the oscillator (s)")


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


def base_of(one: OfTest) -> BaseMotion | None:
    """Return the recorded base motion with its target; None if the table's motion was not recorded throughout."""
    test = one.test
    time, acceleration = (one.stored.array("rocking", name) for name in ("elapsed", "base_acceleration"))
    if acceleration.size < 2 * FEWEST or not np.isfinite(acceleration).all() or test.kind in ("free-vibration", "tilt"):
        return None
    base = BaseMotion(time, acceleration, None)
    reference = _reference(one.campaign, test.motion)
    if reference is None or not acceleration.any():
        return base
    laid = laid_on(Series(acceleration, base.interval), reference, time_scale=test.time_scale)
    return replace(base, target=laid)


def base_picture(one: OfTest, base: BaseMotion | None) -> Picture | None:
    """Draw what the table did and was to do; None for a motion without a spectrum worth drawing."""
    test = one.test
    if base is None or test.kind in WITHOUT_SPECTRUM or not base.acceleration.any():
        return None
    spectra, target = _spectra(base), base.target
    said = [f"Largest achieved response {quantity(float(spectra.achieved.max()), 'm/s²')}."]
    if target is not None and spectra.target is not None:
        ratio = spectra.achieved / spectra.target
        said.append(f"Achieved over target {number(float(ratio.min()))} to {number(float(ratio.max()))}.")
    return Picture(
        base_motion(
            Curve(base.time, base.acceleration),
            None if target is None else Curve(base.time, target.acceleration),
            spectra,
            uplift=one.block.uplift_acceleration,
        ),
        f"base-{test.id}",
        f"{test.id}: acceleration of the table and its response spectrum of {format_percent(DAMPING)} damping",
        " ".join(said),
    )


def _spectra(base: BaseMotion) -> BaseSpectra:
    length = base.interval * base.time.size
    shortest = max(SHORTEST, FEWEST * base.interval)
    period = np.geomspace(shortest, max(min(LONGEST, length / 4), 2 * shortest), PERIODS)
    target = None if base.target is None else response_spectrum(base.target.acceleration, base.interval, period)
    return BaseSpectra(period, response_spectrum(base.acceleration, base.interval, period), target)


def _reference(campaign: Campaign, motion: str | None) -> Series | None:
    """Return the motion that a test names, None if it is not known or cannot be read."""
    known = {name.casefold(): source for name, source in reference_files(campaign).items()}
    source = known.get((motion or "").casefold())
    return None if source is None else _loaded(source)


@lru_cache(maxsize=8)
def _loaded(source: ReferenceMotionFile) -> Series | None:
    return load({"target": source}, []).get("target")
