"""The critical damping fraction with which a body rocks freely with a given restitution."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import acosh, ceil, exp, isnan, log, nan

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.history import ContactHistory
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.modes import keep_modes, keep_modes_for_step
from colonnade.dynamics.contact.simulate import plane_block, simulate
from colonnade.dynamics.contact.stability import longest_step

Identify = Callable[[ContactHistory], tuple[float, str]]

VELOCITY_RATIO = "velocity-ratio"
"""What a restitution is that is the mean velocity ratio of the impacts."""

FRACTIONS = (0.0, 0.01, 0.03, 0.1, 0.3, 1.0, 2.0, 4.0)
"""Critical damping fractions that are tried first; e falls along most of them, and rises again where ξ is large. The
paper's fractions of elastic meshes reach 2.6."""

SOFTER_FIRST = (0.3, 0.1, 3.0, 0.03, 10.0, 0.01, 0.003, 0.001)
HARDER_FIRST = (3.0, 10.0, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001)
"""Multiples of the law's stiffness, tried in this order if the law's own cannot give the restitution. A softer
contact, into which more nodes sink at a time, takes less at an impact; for a smaller e a harder one comes first."""

TOLERANCE = 2e-4
"""Of e, within which a calibration agrees; e of neighbouring fractions scatters by about as much."""

MOST_RUNS = 24

RELEASE = 0.5
"""|θ|/α from which a free vibration is calibrated, as large as laboratories release."""

IMPACTS = 16
"""Number of impacts that give the restitution."""

SMALLEST_RELEASE = 0.01
"""|θ|/α: smaller ones are lost in the contact's own depth."""


@dataclass(frozen=True)
class Calibration:
    """
    A law of contact that gives a restitution, or how near it came.

    Attributes
    ----------
    law : ContactLaw
        The one whose restitution is nearest to the one asked for.
    restitution : float
        Of a free vibration with it, by `identify`.
    source : str
        What that restitution is: `VELOCITY_RATIO`, or as `identify` calls it.
    velocity_ratio : float
        Of the same free vibration: `free_restitution`.
    target : float
    fractions, stiffnesses, restitutions : ndarray, shape (k,)
        All that was tried, in its order (ξ; in multiples of the stiffness of the law asked for), and what it gave.
    effective_damping : float
        ξ_eff of law and body.
    step : float
        s, that the runs were made with.
    cost : float
        Seconds of computing for a second of motion, of the runs after the first, which may have compiled.
    residual : float
        Of the energy balance in the run with the law, over the largest energy.
    body : ContactBody
        With the modes that the run with the law kept.
    """

    law: ContactLaw
    restitution: float
    source: str
    velocity_ratio: float
    target: float
    fractions: Array
    stiffnesses: Array
    restitutions: Array
    effective_damping: float
    step: float
    cost: float
    residual: float
    body: ContactBody

    @property
    def agrees(self) -> bool:
        """Whether the restitution is the one asked for, to `TOLERANCE`."""
        return abs(self.restitution - self.target) <= TOLERANCE

    @property
    def reason(self) -> str:
        """Why it does not agree; empty if it does."""
        if self.agrees:
            return ""
        return (
            f"The contact of this body ({self.body.description}) gives e from {np.nanmin(self.restitutions):.4f} to "
            f"{np.nanmax(self.restitutions):.4f} for critical damping fractions from {self.fractions.min():g} to "
            f"{self.fractions.max():g} and {self.stiffnesses.min():g} to {self.stiffnesses.max():g} times its "
            f"stiffness; {self.target:.4f} was asked for. The nearest is used: e = {self.restitution:.4f} at "
            f"{self.law.damping_fraction:.4g}. More nodes give a larger e, fewer a smaller one."
        )


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
    gravity: float = STANDARD_GRAVITY,
    step: float | None = None,
    release: float = RELEASE,
    impacts: int = IMPACTS,
    fractions: Sequence[float] | None = None,
    vary_stiffness: bool = True,
    identify: Identify | None = None,
) -> Calibration:
    """
    Find the damping of contact, and if need be its stiffness, with which a body's free rocking has a restitution.

    Parameters
    ----------
    body : ContactBody
        With all its modes; with a step given, each run keeps those that the step follows with its own law.
    law : ContactLaw
        Its damping fraction is varied; its stiffness is changed only if no fraction gives e.
    restitution : float
        e between 0 and 1, as identified from measured free rocking.
    gravity : float, optional
        m/s².
    step : float, optional
        s; default as for `simulate`.
    release : float, optional
        |θ|/α at the start.
    impacts : int, optional
        Number of impacts that give the restitution.
    fractions : sequence of float, optional
        Damping fractions that are tried first, rising; default `FRACTIONS`. With a single one its e is computed.
    vary_stiffness : bool, optional
        Whether the stiffness may be changed.
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
    if not SMALLEST_RELEASE <= release < 1.0 or impacts < 1:
        raise ValueError(
            f"release is {release} of the critical angle and impacts {impacts}; a release from {SMALLEST_RELEASE:g} "
            "to 1 and at least one impact were expected"
        )
    runs = _Runs(body, law, gravity, step, release, impacts, restitution, identify)
    tried = FRACTIONS if fractions is None else fractions
    if not runs.reach(1.0, tried) and vary_stiffness:
        order = HARDER_FIRST if runs.lowest() > restitution else SOFTER_FIRST
        for stiffness in order:
            if runs.reach(stiffness, tried):
                break
    return runs.result()


class _Runs:
    """Free vibrations with different damping fractions, each computed once."""

    def __init__(
        self,
        body: ContactBody,
        law: ContactLaw,
        gravity: float,
        step: float | None,
        release: float,
        impacts: int,
        restitution: float,
        identify: Identify | None,
    ) -> None:
        self._body, self._law, self._gravity, self._step, self._impacts = body, law, gravity, step, impacts
        self._identify = identify or partial(_by_velocities, impacts=impacts)
        self._target = restitution
        block = plane_block(body, gravity)
        self._theta0 = release * block.critical_angle
        self._duration = _duration(release, restitution, impacts) / block.p
        self._found: dict[tuple[float, float], tuple[float, str, ContactHistory]] = {}
        self._costs: list[float] = []

    def reach(self, stiffness: float, fractions: Sequence[float]) -> bool:
        """Close in on the restitution at a multiple of the stiffness, if two of the fractions bracket it."""
        run = partial(self._run, stiffness)
        bracket = _bracket(run, self._target, fractions)
        if bracket is not None:
            _close_in(run, self._target, *bracket)
        return bracket is not None

    def lowest(self) -> float:
        """Give the smallest restitution so far; NaN without any."""
        return min((value for value, _, _ in self._found.values() if not isnan(value)), default=nan)

    def _run(self, stiffness: float, fraction: float) -> float:
        if (stiffness, fraction) not in self._found:
            law = replace(self._law, stiffness=stiffness * self._law.stiffness, damping_fraction=fraction)
            try:
                body = self._body if self._step is None else keep_modes_for_step(self._body, law, self._step)
            except ValueError:
                return nan
            began = time.process_time()
            history = simulate(
                body,
                law=law,
                gravity=self._gravity,
                theta0=self._theta0,
                duration=self._duration,
                step=self._step,
            )
            self._costs.append((time.process_time() - began) / self._duration)
            self._found[stiffness, fraction] = *self._identify(history), history
        return self._found[stiffness, fraction][0]

    def result(self) -> Calibration:
        """Take the run whose restitution is nearest."""
        values = np.array([value for value, _, _ in self._found.values()])
        if self._step is not None and values.size == 0:
            longest = longest_step(keep_modes(self._body, 0.0), self._law)
            raise ValueError(
                f"step is {self._step:.4g} s; at most {longest:.4g} s was expected: beyond it the contact of this body "
                f"({self._body.description}) is unstable. Use a shorter step or a softer contact."
            )
        if not np.isfinite(values).any():
            raise ValueError(
                f"No free vibration of this body ({self._body.description}) gave a restitution; a block that rocks was "
                "expected"
            )
        value, source, history = list(self._found.values())[int(np.nanargmin(np.abs(values - self._target)))]
        return Calibration(
            law=history.law,
            restitution=value,
            source=source,
            velocity_ratio=free_restitution(history, impacts=self._impacts),
            target=self._target,
            fractions=np.array([fraction for _, fraction in self._found]),
            stiffnesses=np.array([stiffness for stiffness, _ in self._found]),
            restitutions=values,
            effective_damping=history.effective_damping,
            step=history.step,
            cost=float(np.median(self._costs[1:] or self._costs)),
            residual=history.energies.relative_residual,
            body=history.body,
        )


def _by_velocities(history: ContactHistory, *, impacts: int) -> tuple[float, str]:
    return free_restitution(history, impacts=impacts), VELOCITY_RATIO


def _bracket(runs: Callable[[float], float], target: float, fractions: Sequence[float]) -> tuple[float, float] | None:
    """Find the first two neighbours between which e falls through the target."""
    before = None
    for fraction in fractions:
        value = runs(fraction)
        if before is not None and runs(before) >= target >= value:
            return before, fraction
        before = fraction
    return None


def _close_in(runs: Callable[[float], float], target: float, low: float, high: float) -> None:
    """Narrow a bracket by the secant (Illinois), kept from its ends, up to the tolerance."""
    above, below = runs(low) - target, runs(high) - target
    for _ in range(MOST_RUNS):
        if abs(above) <= TOLERANCE or abs(below) <= TOLERANCE or high - low <= 1e-9:
            return
        share = min(max(above / (above - below), 0.02), 0.98)
        middle = low + share * (high - low)
        found = runs(middle) - target
        if abs(found) <= TOLERANCE:
            return
        if found > 0.0:
            low, above, below = middle, found, 0.5 * below
        else:
            high, below, above = middle, found, 0.5 * above


def _duration(release: float, restitution: float, impacts: int) -> float:
    """Time that so many impacts take with a restitution, and half an arc more, in 1/p (Housner 1963, eq. 3)."""
    kept, total = 1.0 - (1.0 - release) ** 2, acosh(1.0 / (1.0 - release))
    for _ in range(impacts):
        kept = exp(log(kept) + 2.0 * log(restitution))
        total += 2.0 * acosh(1.0 / (1.0 - kept) ** 0.5)
    return ceil(10.0 * total) / 10.0
