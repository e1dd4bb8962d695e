"""The critical damping fraction with which a body rocks freely with a given restitution."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import acosh, ceil, exp, log, nan

import numpy as np
import scipy

from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.dynamics.contact.body import ContactBody, ContactLaw
from colonnade.dynamics.contact.history import ContactHistory
from colonnade.dynamics.contact.simulate import plane_block, simulate
from colonnade.dynamics.contact.stability import keep_modes_for_step

Identify = Callable[[ContactHistory], tuple[float, str]]

VELOCITY_RATIO = "velocity-ratio"
"""What a restitution is that is the mean velocity ratio of the impacts."""

FRACTIONS = (0.0, 0.01, 0.03, 0.1, 0.3, 1.0, 2.0, 4.0)
"""Critical damping fractions that are tried first; e falls along most of them, and rises again where ξ is large. The
paper's fractions of elastic meshes reach 2.6."""

STIFFNESSES = (3.0, 0.3, 10.0, 0.1, 0.03, 0.01, 0.003, 0.001)
"""Multiples of the law's stiffness, tried in this order if the law's own cannot give the restitution. A softer
contact, into which more nodes sink at a time, takes less at an impact."""

TOLERANCE = 2e-4
"""Of e, within which a calibration agrees; e of neighbouring fractions scatters by about as much."""

MOST_RUNS = 24

RELEASE = 0.5
"""|θ|/α from which a free vibration is calibrated, as large as laboratories release."""

IMPACTS = 16
"""Number of impacts that give the restitution."""


@dataclass(frozen=True)
class Calibration:
    """
    A law of contact that gives a restitution, or how near it came.

    Attributes
    ----------
    history : ContactHistory
        Of a free vibration with the law whose restitution is nearest to the one asked for, and the modes that it kept.
    restitution : float
        Of this, by `identify`.
    source : str
        What that restitution is: `VELOCITY_RATIO`, or as `identify` calls it.
    reason : str
        Why it does not agree with the one asked for, to `TOLERANCE`; empty if it does.
    """

    history: ContactHistory
    restitution: float
    source: str
    reason: str


def free_restitution(history: ContactHistory, *, impacts: int = IMPACTS) -> float:
    """
    Restitution of a free vibration in the contact model.

    Parameters
    ----------
    history : ContactHistory
    impacts : int, optional
        How many of the first impacts enter.

    Returns
    -------
    restitution : float
        exp of the mean of ln e_n, with e_n of velocities just before and after each impact; NaN without an impact.
    """
    ratios = history.impact_restitution[:impacts]
    ratios = ratios[np.isfinite(ratios) & (ratios > 0.0)]
    return float(np.exp(np.log(ratios).mean())) if ratios.size else float("nan")


def calibrate(
    body: ContactBody,
    law: ContactLaw,
    restitution: float,
    *,
    step: float,
    gravity: float = STANDARD_GRAVITY,
    impacts: int = IMPACTS,
    fractions: Sequence[float] = FRACTIONS,
    identify: Identify | None = None,
) -> Calibration:
    """
    Find the damping of contact, and if need be its stiffness, with which a body's free rocking has a restitution.

    Parameters
    ----------
    body : ContactBody
        With all its modes; each run keeps those that the step follows with its own law.
    law : ContactLaw
        Its damping fraction is varied; its stiffness is changed only if no fraction gives e.
    restitution : float
        e between 0 and 1, as identified from measured free rocking.
    step : float
        s.
    gravity : float, optional
        m/s².
    impacts : int, optional
        Number of impacts that give the restitution.
    fractions : sequence of float, optional
        Damping fractions that are tried first, rising. With a single one its e is computed, and nothing is varied.
    identify : callable, optional
        Restitution of a free vibration, NaN if it gives none, and what it is; default `free_restitution`. A bouncing
        contact loses energy between impacts too, so velocities at impacts give another e than the decay of the angle.

    Returns
    -------
    calibration : Calibration
        Of several fractions that agree, the smallest. Where none does, the nearest, with the reason.

    Raises
    ------
    ValueError
        If an argument is out of its range, or the step is unstable with every fraction.
    """
    if not 0.0 < restitution < 1.0:
        raise ValueError(f"restitution is {restitution}; a number between 0 and 1 was expected")
    block = plane_block(body, gravity)
    theta0, duration = RELEASE * block.critical_angle, _duration(restitution, impacts) / block.p
    law = law.bearing(body, gravity)
    identify = identify or (lambda history: (free_restitution(history, impacts=impacts), VELOCITY_RATIO))
    found: dict[tuple[float, float], tuple[float, str, ContactHistory]] = {}

    def run(stiffness: float, fraction: float) -> float:
        """Give e at a multiple of the stiffness and a damping fraction, each pair computed once; NaN if unstable."""
        if (stiffness, fraction) not in found:
            own = replace(law, stiffness=stiffness * (law.stiffness or nan), damping_fraction=fraction)
            kept = keep_modes_for_step(body, own, step)
            try:
                history = simulate(kept, law=own, gravity=gravity, theta0=theta0, duration=duration, step=step)
            except ValueError:
                if found:
                    return nan
                raise
            found[stiffness, fraction] = *identify(history), history
        return found[stiffness, fraction][0]

    _search(run, fractions, restitution)
    tried = np.array([(*pair, value) for pair, (value, _, _) in found.items()])
    missing = np.abs(tried[:, 2] - restitution)
    if np.isnan(missing).all():
        raise ValueError(
            f"No free vibration of this body ({body.description}) gave a restitution; a block that rocks was expected"
        )
    value, source, history = list(found.values())[int(np.nanargmin(missing))]
    reason = ""
    if abs(value - restitution) > TOLERANCE:
        (softest, least, lowest), (stiffest, most, highest) = np.nanmin(tried, axis=0), np.nanmax(tried, axis=0)
        reason = (
            f"The contact of this body ({history.body.description}) gives e from {lowest:.4f} to {highest:.4f} for "
            f"critical damping fractions from {least:g} to {most:g} and {softest:g} to {stiffest:g} times its "
            f"stiffness; {restitution:.4f} was asked for. The nearest is used: e = {value:.4f} at "
            f"{history.law.damping_fraction:.4g}. More nodes give a larger e, fewer a smaller one."
        )
    return Calibration(history, value, source, reason)


def _search(run: Callable[[float, float], float], fractions: Sequence[float], restitution: float) -> None:
    """Run multiples of the stiffness and damping fractions, which give e or NaN, until one gives the restitution."""

    def misfit(fraction: float, stiffness: float) -> float:
        """Give how far e is from the target; 0, a root, within the tolerance."""
        missing = run(stiffness, fraction) - restitution
        return 0.0 if abs(missing) <= TOLERANCE else missing

    def reach(stiffness: float) -> bool:
        """Close in on e between the first two neighbours between which it falls through the target, if there are."""
        for low, high in pairwise(fractions):
            if run(stiffness, low) >= restitution >= run(stiffness, high):
                scipy.optimize.brentq(misfit, low, high, (stiffness,), xtol=1e-9, maxiter=MOST_RUNS, disp=False)
                return True
        return False

    def may_reach(stiffness: float) -> bool:
        """Say by three runs whether a stiffness can give e, which is least at one of the last two fractions."""
        ends = [run(stiffness, fraction) for fraction in (*fractions[:1], *fractions[-2:])]
        return bool(np.fmin.reduce(ends) <= restitution <= np.fmax.reduce(ends))

    run(1.0, fractions[0])
    if len(fractions) > 1 and not reach(1.0):
        any(may_reach(each) and reach(each) for each in STIFFNESSES)


def _duration(restitution: float, impacts: int) -> float:
    """Time that so many impacts take with a restitution, and half an arc more, in 1/p (Housner 1963, eq. 3)."""
    kept, total = 1.0 - (1.0 - RELEASE) ** 2, acosh(1.0 / (1.0 - RELEASE))
    for _ in range(impacts):
        kept = exp(log(kept) + 2.0 * log(restitution))
        total += 2.0 * acosh(1.0 / (1.0 - kept) ** 0.5)
    return ceil(10.0 * total) / 10.0
