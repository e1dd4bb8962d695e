"""Phase portraits, steady states over the phase of the base, and the time about the largest angle, as stored."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Test
from colonnade.campaign.forms.summary import TestSummary
from colonnade.dynamics.block import Block
from colonnade.figures.closer import Enlarged, Phase, closer_look
from colonnade.figures.files.output import Picture
from colonnade.figures.panels.curve import Curve
from colonnade.figures.stored.curves import measured_ratio, predicted_ratios
from colonnade.store.records.stored import Stored

POINTS = 900
"""Samples of a curve in the portrait."""

CYCLES = 6
"""Last responses of a steady state that are drawn on each other."""

AROUND = 2.5
"""Time before and after the largest angle that is enlarged, over 2π/p."""


def picture(test: Test, record: TestSummary, stored: Stored, block: Block) -> Picture | None:
    """Draw a test that rocked more closely; None if nothing rocked."""
    measured = measured_ratio(stored, block)
    predicted = predicted_ratios(stored, block)
    if record.outcome == "no-rocking" or (measured is None and not predicted):
        return None
    enlarged, stretch = _steady(record, stored, measured, predicted), _steady_stretch(record, stored)
    if enlarged is None:
        stretch = _about_peak(record, measured, block)
        enlarged = None if stretch is None else _in_time(record, stretch, measured, predicted)
    phases = {
        name: _phase(curve, block, stretch) for name, curve in {"": measured, **predicted}.items() if curve is not None
    }
    phases = {name: phase for name, phase in phases.items() if phase.ratio.size > 2}
    if not phases:
        return None
    return Picture(
        closer_look(phases.pop("", None), phases, separatrix(block), enlarged),
        f"closer-{test.id}",
        f"{test.id}: phase portrait" + ("" if enlarged is None else f", and the rocking angle over {enlarged.label}"),
        "Angular velocity over p α against θ/α, measured and by model, with the separatrix of the free motion.",
        "" if enlarged is None else f"Right: the rocking angle, {enlarged.remark}.",
    )


def separatrix(block: Block) -> Phase:
    """
    Return the upper branch of the free motion that just reaches the critical angle.

    Its energy is that of the block standing on its edge: θ'² = 2 p² (1 − cos(α − |θ|)), with the angle of each side.
    """
    ratio = np.linspace(-1.0, 1.0, 81)
    critical = block.critical_angle_at(ratio)
    return Phase(ratio, np.sqrt(2 * (1 - np.cos(critical * (1 - np.abs(ratio))))) / critical)


def _phase(curve: Curve, block: Block, stretch: tuple[float, float] | None) -> Phase:
    """Return angle and angular velocity over p and α within a stretch of time, thinned."""
    first, last = stretch or (-np.inf, np.inf)
    known = np.flatnonzero(np.isfinite(curve.values) & (curve.time >= first) & (curve.time <= last))
    if known.size < 3:
        return Phase(np.empty(0), np.empty(0))
    inside = slice(int(known[0]), int(known[-1]) + 1)
    time, ratio = curve.time[inside], curve.values[inside]
    step = max(time.size // POINTS, 1)
    return Phase(ratio[::step], (np.gradient(ratio, time) / block.p)[::step])


def _steady_stretch(record: TestSummary, stored: Stored) -> tuple[float, float] | None:
    """Return the last periods of the steady part of a sine, s."""
    frequency, start, stop = (
        stored.value("compare", name) for name in ("forcing_frequency", "steady_start", "steady_stop")
    )
    if record.outcome == "overturned" or not np.isfinite((frequency, start, stop)).all():
        return None
    order = _order(record)
    periods = min(order * CYCLES, int((stop - start) * frequency) // order * order)
    return (stop - periods / frequency, stop) if periods >= order else None


def _order(record: TestSummary) -> int:
    return record.order if isinstance(record.order, int) else 1


def _steady(
    record: TestSummary, stored: Stored, measured: Curve | None, predicted: Mapping[str, Curve]
) -> Enlarged | None:
    """Return the last responses of the steady part of a sine on each other, over the phase of the base."""
    stretch = _steady_stretch(record, stored)
    if stretch is None:
        return None
    (first, stop), order, frequency = stretch, _order(record), stored.value("compare", "forcing_frequency")
    zero = _rising(
        stored.array("rocking", "elapsed"), stored.array("rocking", "base_acceleration"), frequency, first, stop
    )

    def cycles(curve: Curve) -> list[Curve]:
        phase = (curve.time - zero) * frequency
        inside = (curve.time >= first) & (curve.time <= stop)
        turn = np.floor(phase / order)
        return [
            Curve(phase[chosen] - order * each, curve.values[chosen])
            for each in np.unique(turn[inside])
            if (chosen := inside & (turn == each)).any()
        ]

    return Enlarged(
        "phase of the base (periods)",
        [] if measured is None else cycles(measured),
        {model: cycles(curve) for model, curve in predicted.items()},
        f"last {round((stop - first) * frequency)} periods of the steady part",
    )


def _rising(time: Array, base: Array, frequency: float, first: float, stop: float) -> float:
    """Return a time (s) at which the sine in the base acceleration rises through zero."""
    inside = (time >= first) & (time <= stop) & np.isfinite(base)
    amplitude = np.mean(base[inside] * np.exp(-2j * np.pi * frequency * (time[inside] - first)))
    return float(first - (np.angle(amplitude) + np.pi / 2) / (2 * np.pi * frequency))


def _about_peak(record: TestSummary, measured: Curve | None, block: Block) -> tuple[float, float] | None:
    """Return the time about the largest measured angle, s."""
    if record.peak_time is None or measured is None:
        return None
    reach = AROUND * 2 * np.pi / block.p
    return record.peak_time - reach, record.peak_time + reach


def _in_time(
    record: TestSummary, stretch: tuple[float, float], measured: Curve | None, predicted: Mapping[str, Curve]
) -> Enlarged:
    def near(curve: Curve) -> list[Curve]:
        inside = (curve.time >= stretch[0]) & (curve.time <= stretch[1])
        return [Curve(curve.time[inside], curve.values[inside])]

    name = "overturning" if record.outcome == "overturned" else "the largest angle"
    curves = {model: near(curve) for model, curve in predicted.items()}
    return Enlarged("time (s)", [] if measured is None else near(measured), curves, f"about {name}")
