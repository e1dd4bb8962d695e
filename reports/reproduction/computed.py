"""What is computed beside the campaign's own results: a fine map, the paper's schemes, rocking in space."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array
from colonnade.campaign import Campaign, load
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.history import ContactHistory
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.maps import StabilityMap, stability_map
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.run import OUTCOMES
from colonnade.dynamics.rock import rock
from colonnade.identification.response.boundaries import SAME_FREQUENCY, MapPoint, bracket_boundaries
from colonnade.laboratory.programme import COLUMNS
from colonnade.signals.metrics import nrmse
from colonnade.stages.contact import ContactInputs, body_of, law_of
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stored import Stored
from paper_schemes import PAPERS_STEP, rock_by_steps
from reproduction.campaign import ANALYTICAL, CYCLES, MAP_RAMP, SPECIMEN, frequency_ratios
from reproduction.printed import RESTITUTION, TABLE_1

Numbers = dict[str, Any]

FINE_FREQUENCIES, FINE_LEVELS, HIGHEST_LEVEL = 61, 240, 8.0
"""Of the fine map of the analytical model: Ω, A, and the largest A."""

SHAKEN = {"sine-3Hz-1.80": "sine-3Hz-2.20", "sine-7Hz-3.10": "sine-7Hz-6.24"}
"""Sine tests whose recorded motions are run again in space: at a low and a high frequency one that stands, and one that
overturns."""

FRICTIONS = (0.6, 0.3)
"""The paper gives no friction; the first is our default."""

LEAN = 1e-3
"""rad, rotation about x at the start: nobody sets up a block more exactly than that, and less starts nothing."""


def fine_map(restitution: float, frequency_ratio: ArrayLike | None = None) -> StabilityMap:
    """Scan the analytical model finely, by default at `FINE_FREQUENCIES`: for the figure that draws its limits."""
    return stability_map(
        TABLE_1[SPECIMEN].block,
        frequency_ratio=frequency_ratios(FINE_FREQUENCIES) if frequency_ratio is None else frequency_ratio,
        amplitude_ratio=np.linspace(0.8, HIGHEST_LEVEL, FINE_LEVELS),
        restitution=restitution,
        cycles=CYCLES,
        ramp=MAP_RAMP,
        model=ANALYTICAL,
    )


def limits(chart: StabilityMap, points: Sequence[MapPoint]) -> Numbers:
    """Give the limits of a map, and how far they are from the measured boundaries."""
    measured = bracket_boundaries(points)
    omega = chart.frequency_ratio
    found: Numbers = {
        "frequency_ratio": omega,
        "no_rocking": chart.no_rocking,
        "lower": chart.lower,
        "upper": chart.upper,
        "width": chart.options["width"],
        "levels": chart.amplitude_ratio.size,
    }
    for name, limit in (("no_rocking", chart.no_rocking), ("lower", chart.lower), ("upper", chart.upper)):
        brackets = [each.rocking if name == "no_rocking" else each.overturning for each in measured]
        rows = [
            (_at(each.frequency_ratio, omega, limit), bracket.middle)
            for each, bracket in zip(measured, brackets, strict=True)
            if bracket.middle is not None
        ]
        off = np.array([limit_ / middle - 1 for limit_, middle in rows if middle is not None])
        known = off[np.isfinite(off)]
        found[f"{name}_off"] = {
            "mean": float(known.mean()) if known.size else None,
            "rms": float(np.sqrt((known**2).mean())) if known.size else None,
            "frequencies": int(known.size),
        }
    return found


def _at(frequency_ratio: float, omega: Array, limit: Array) -> float:
    """Read a limit at an Ω: of the column there, else between its neighbours."""
    nearest = int(np.argmin(np.abs(omega - frequency_ratio)))
    if abs(frequency_ratio / omega[nearest] - 1) < SAME_FREQUENCY:
        return float(limit[nearest])
    return float(np.interp(frequency_ratio, omega, limit))


def by_level(chart: StabilityMap) -> StabilityMap:
    """
    Give a map the limits that its levels show, as a ladder of tests shows its boundary.

    The lower limit is halfway between the first level that overturns and the one before it; the upper one halfway
    between the last level that stands and the next, NaN if the largest level stands. Without a level that overturns
    both are NaN.
    """
    levels = chart.amplitude_ratio
    middles = 0.5 * (levels[1:] + levels[:-1])
    lower, upper = np.full((2, chart.frequency_ratio.size), np.nan)
    for column, outcomes in enumerate(chart.outcome == OUTCOMES.index("overturned")):
        if outcomes.any():
            lower[column] = middles[max(int(np.argmax(outcomes)) - 1, 0)]
            stands = int(np.flatnonzero(~outcomes)[-1])
            upper[column] = middles[stands] if stands < middles.size else np.nan
    return replace(chart, lower=lower, upper=upper, options=chart.options | {"width": float(levels[1] - levels[0])})


def schemes(block: Block, motions: Mapping[str, Motion]) -> list[Numbers]:
    """Run the paper's two schemes with its step on recorded motions, next to the exact solution of their equation."""
    rows = []
    for span, motion in motions.items():
        exact = rock(block, motion, restitution=RESTITUTION, model=ANALYTICAL)
        for scheme in ("runge-kutta", "hamming"):
            for parts in (1, 10):
                count = round(motion.dt / PAPERS_STEP) * parts
                found = rock_by_steps(block, motion, scheme=scheme, steps_per_sample=count, restitution=RESTITUTION)
                rows.append(
                    {
                        "span": span,
                        "scheme": scheme,
                        "step": motion.dt / count,
                        "largest_error": float(np.abs(found.angle - exact.angle).max() / block.critical_angle),
                        "rms_error": nrmse(exact.angle, found.angle, block.critical_angle),
                        "peak_ratio": found.peak_ratio,
                        "exact_peak_ratio": exact.peak_ratio,
                    }
                )
    return rows


def recorded_motion(stored: Stored) -> Motion:
    """Give the table's motion as it was recorded and conditioned."""
    time = stored.array("rocking", "elapsed")
    return Motion(stored.array("rocking", "base_acceleration"), float(time[1] - time[0]))


def in_space(campaign: Campaign, layout: Layout, motions: Mapping[str, Motion]) -> list[Numbers]:
    """Run a test that stands and one that overturns in space, from a slight lean: slide and rotation out of plane."""
    inputs = ContactInputs.of(campaign, SPECIMEN)
    law = law_of(files.read(layout.stage(SPECIMEN, "contact")))
    body = body_of(inputs, law)
    rows = []
    for test, motion in motions.items():
        for friction in FRICTIONS:
            history = simulate(
                body,
                motion,
                law=replace(law, friction=friction),
                gravity=inputs.block.gravity,
                step=inputs.settings.step,
                out_of_plane=LEAN,
            )
            rows.append({"test": test, "friction": friction, "outcome": history.outcome, **_last_stage(history)})
    return rows


def _last_stage(history: ContactHistory) -> Numbers:
    """Give the largest slide and rotations up to the angle at which the frame catches the block."""
    alpha = history.block.critical_angle
    caught = np.abs(history.angle) >= load(COLUMNS).setups[f"{SPECIMEN}-table"].catch
    standing = np.arange(caught.size) < (np.argmax(caught) if caught.any() else caught.size)
    slide: Array = np.hypot(history.slide[:, 0], history.slide[:, 1])
    return {
        "slide": float(slide[standing].max()),
        "out_of_plane": float(np.abs(history.out_of_plane_angle[standing]).max() / alpha),
        "yaw": float(np.abs(history.yaw[standing]).max()),
        "energy_residual": history.energies.relative_residual,
    }
