"""How far neighbours of a response run apart, and up to when it can be predicted at all."""

from __future__ import annotations

from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign.settings import EnsembleSettings
from colonnade.dynamics.ensembles.ensemble import ensemble
from colonnade.dynamics.ensembles.uncertainty import Uncertainty
from colonnade.dynamics.rock import rock
from span_two_and_a_half.design import SEED, SPANS, STRANGE, nominal, table_motion
from span_two_and_a_half.trial import parted, response, table

RELATIVE = (1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2)
"""Changes of the intensity, up and down."""

APART = (0.05, 0.2)
"""Of α: neighbours have parted, and run far apart."""

MODEL = "nonlinear"
MEMBERS = 100


def neighbours(levels: Array) -> dict[str, Any]:
    """
    Run the nominal prism at Span 2.5 at some intensities, and again at intensities close by.

    Returns
    -------
    found : dict
        By relative change: `apart`, the share of pairs whose |θ|/α differ by 0.2 at some time, and `parted`, the median
        time in s of those at which they first differ by 0.05.
    """
    block, e = nominal()
    shape = table_motion()

    def run(intensity: float) -> Any:
        return response(rock(block, table(shape, intensity, STRANGE), restitution=e, model=MODEL), shape.dt)

    found: dict[str, Any] = {}
    middle = {intensity: run(intensity) for intensity in levels.tolist()}
    for change in RELATIVE:
        largest, times = [], []
        for intensity, one in middle.items():
            for sign in (-1.0, 1.0):
                other = run(intensity * (1.0 + sign * change))
                largest.append(float(np.abs(one.ratio - other.ratio).max()))
                times.append(parted(one, other, APART[0]))
        far = np.array(largest) > APART[1]
        found[f"{change:g}"] = {
            "pairs": len(largest),
            "apart": round(float(far.mean()), 4),
            "parted": round(float(np.nanmedian(np.array(times)[far])), 2) if far.any() else None,
        }
    return found


def horizons(levels: Array) -> dict[str, Any]:
    """
    Give up to when the nonlinear model predicts, with what the settings of the program take as uncertain.

    Returns
    -------
    found : dict
        By Span: quantiles (5, 50, 95 %) of the horizon over the intensities, s, of those at which the prism rocks.
    """
    block, e = nominal()
    settings = EnsembleSettings()
    uncertainty = Uncertainty(
        restitution=settings.restitution,
        critical_angle=settings.critical_angle,
        p=settings.p,
        gain=settings.gain,
        clock=settings.clock,
    )
    found = {}
    for span in SPANS:
        ends = []
        for intensity in levels.tolist():
            runs = ensemble(
                block,
                table(table_motion(), intensity, span),
                uncertainty=uncertainty,
                restitution=e,
                count=MEMBERS,
                seed=SEED,
                model=MODEL,
            )
            if np.nanmax(runs.peak_ratio, initial=0.0) > APART[1]:
                ends.append(runs.horizon(settings.horizon * block.critical_angle))
        found[f"{span:g}"] = {
            "intensities": len(ends),
            "horizon": [round(float(each), 2) for each in np.quantile(ends, (0.05, 0.5, 0.95))],
        }
    return found
