"""What the table did: its motion against the target, in numbers at both scales, and its response spectrum."""

from __future__ import annotations

from math import isnan, nan
from typing import Any

import numpy as np

from colonnade.assessment.ground import LARGEST_DRIFT_AT_REST
from colonnade.assessment.measures import table_measures
from colonnade.campaign import Test
from colonnade.dynamics.size import at_prototype
from colonnade.figures import base_motion
from colonnade.figures.base_motion import BaseMotion
from colonnade.figures.stored.subject import OfTest
from colonnade.report.test_page.facts import Fact, known
from colonnade.signals.filters import lowpass
from colonnade.store.records.stored import Stored
from colonnade.store.records.test import largest_motion
from colonnade.units.text import NOTHING, PERCENT, number, percent, quantity

FASTEST = 25.0
"""Hz, below which a measured displacement is differentiated: above it its noise is larger than its motion."""


def of_test(one: OfTest) -> dict[str, Any]:
    """Measure the table's motion at both scales, and draw it with its target; empty without a recorded motion."""
    motion = base_motion.base_of(one)
    if motion is None:
        return {}
    heads, rows = _measures(motion, one.stored, one.campaign.gravity, one.specimen.scale)
    return {
        "facts": known([*_sine(one.test, one.stored), *_target(motion)]),
        "heads": heads,
        "rows": rows,
        "picture": base_motion.base_picture(one, motion),
    }


def _measures(
    motion: BaseMotion, stored: Stored, gravity: float, scale: float | None
) -> tuple[list[str], list[list[str]]]:
    """Give heads and rows of the measures, and how each is computed."""
    series = [motion.acceleration, *([motion.target.acceleration] if motion.target else [])]
    target, at_scale = (["#target"] if motion.target else []), (["#achieved, prototype scale"] if scale else [])

    def row(name: str, unit: str, kind: str, values: list[float], how: str) -> list[str]:
        prototype = [at_prototype(kind, values[0], scale)] if scale else []
        return [name, *(quantity(value, unit) for value in (*values, *prototype)), how]

    measured = largest_motion(stored, "base_displacement")
    peaks = [float(np.abs(values).max()) for values in series]
    tables = [table_measures(values, motion.interval, gravity)[0] for values in series]
    velocity, displacement, arias = ([each[name] for each in tables] for name in ("pgv", "pgd", "arias"))
    allowed = f"{100 * LARGEST_DRIFT_AT_REST:g}{PERCENT}"
    drifts = f"not given: the integral of the acceleration drifts by more than {allowed} of its peak"
    integrated = "integral of the acceleration, less a line through its ends, where the table is at rest"
    how_fast, how_far = integrated, f"twice the {integrated}"
    if isnan(velocity[0]):
        how_fast = drifts
        if not isnan(measured):
            velocity[0] = _from_displacement(stored, motion.interval)
            how_fast = f"derivative of the measured displacement below {FASTEST:g} Hz, as the integral of the "
            how_fast += "acceleration drifts"
    if not isnan(measured):
        displacement[0], how_far = measured, "measured"
    elif isnan(displacement[0]):
        how_far = drifts
    return ["", "#achieved", *target, *at_scale, "how it is computed"], [
        row("peak acceleration (PGA)", "m/s²", "acceleration", peaks, ""),
        row("peak velocity of the table", "mm/s", "velocity", velocity, how_fast),
        row("peak displacement of the table", "mm", "length", displacement, how_far),
        row("Arias intensity", "m/s", "velocity", arias, "π/(2g) times the integral of the squared acceleration"),
    ]


def _from_displacement(stored: Stored, interval: float) -> float:
    """Return the largest velocity of the measured displacement, m/s; NaN if it has gaps."""
    displacement = stored.array("rocking", "base_displacement")
    if not np.isfinite(displacement).all():
        return nan
    smooth = lowpass(displacement, interval, min(FASTEST, 0.2 / interval))
    return float(np.abs(np.gradient(smooth, interval)).max())


def _sine(test: Test, stored: Stored) -> list[Fact]:
    """Give what was achieved of a sine, over its steady part."""
    frequency, amplitude, distortion, start, stop = (
        stored.value("compare", name)
        for name in ("forcing_frequency", "forcing_amplitude", "forcing_distortion", "steady_start", "steady_stop")
    )
    if isnan(frequency):
        return []
    asked = test.frequency
    return [
        ("frequency", quantity(frequency, "Hz", 4) + (f"; asked for: {quantity(asked, 'Hz', 4)}" if asked else "")),
        ("amplitude", quantity(amplitude, "m/s²")),
        ("distortion", f"{percent(distortion)} (RMS of what is not the sine, over that of the sine)"),
        ("steady from", f"{quantity(start, 's', 4)} to {quantity(stop, 's', 4)}"),
    ]


def _target(motion: BaseMotion) -> list[Fact]:
    target = motion.target
    if target is None:
        return []
    turned = "; its polarity is reversed" if target.correlation < 0 else ""
    factor = NOTHING if isnan(target.factor) else number(abs(target.factor))
    return [
        (
            "target",
            f"laid on the recorded motion with the delay and the factor that fit best: {factor} times the reference, "
            f"at time scale {number(target.scale, 4)}; correlation {number(abs(target.correlation))}{turned}",
        )
    ]
