"""Whether the two sides of a block are equal: e and critical angle of each, from energies and durations together."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from colonnade.arrays import Array
from colonnade.identification.restitution.arcs.series import ArcSeries
from colonnade.identification.restitution.fitting.random_walk_fit import RandomWalkFit, RandomWalkProblem
from colonnade.identification.restitution.result import Departure

UNEQUAL_SIDES = "unequal sides"

FEWEST_ARCS = 8

SURE = 4.0
"""Standard errors (of a normal distribution) from which on a difference is named, ..."""

LEAST_DIFFERENCE = 0.05
"""... if that of e is more than this share of the loss 1 − e, ..."""

SCALE = 0.004
"""... and more than twice this: an angle whose scale differs so much between the sides looks the same, ..."""

LEAST_TILT = 0.005
"""... and that of the critical angles more than twice this share of α."""

LEAST_DRIFT = 0.005
"""Share of α by which the zero drifts over the arcs at least where a drift is named."""

SURE_DRIFT = 2.0
"""Standard errors from which on a drift is allowed for where the sides are compared."""

LOSS, UNEQUAL, OFFSET, TILT, DRIFT = 1, 2, 3, 4, 7
"""Places of unknowns in `sides_problem`."""


def compare_sides(series: ArcSeries, least_tilt: float = LEAST_TILT) -> tuple[Departure, ...]:
    """
    Compare impacts from, and arcs on, the two sides.

    Parameters
    ----------
    series : ArcSeries
    least_tilt : float, optional
        See `LEAST_TILT`.

    Returns
    -------
    departures : tuple of Departure
        "unequal restitution": e of impacts that end an arc at θ > 0 minus that at θ < 0, dimensionless.
        "unequal sides": half the difference of the critical angles, (α₊ − α₋)/2 beyond that of the block, rad, which is
        the angle by which a table is tilted down towards −x. "zero drift": of the angle's zero over the arcs, rad.
        None leaves out an arc: the geometric mean of the two e is that of the decay.

    Notes
    -----
    Unknown are ln e of either side, a zero offset of θ and its drift, the half difference of α, and a common error of α
    and of p. An unequal e makes the energies of the peaks alternate, and the durations follow them; an unequal α makes
    the durations alternate at the same peaks; an offset does so the more, the smaller the peak, and a drift more and
    more with time. Threshold: `SURE` standard errors by Student's t, and `LEAST_DIFFERENCE` and 2 `SCALE`,
    `LEAST_TILT` or `LEAST_DRIFT`.
    """
    if series.number.size < FEWEST_ARCS:
        return ()
    problem = sides_problem(series)
    drifting = problem.fit(zero_drift(series))
    drifts = drifting.is_sure(DRIFT, SURE_DRIFT)
    fit = drifting if drifts else problem.fit()
    critical = float(series.critical.min())
    drift = _zero_drift(fit, critical) if drifts else None
    found = (_unequal_restitution(fit), _unequal_sides(fit, least_tilt * critical), drift)
    return tuple(departure for departure in found if departure is not None)


@lru_cache(maxsize=2)  # several questions are asked of the same arcs
def sides_problem(series: ArcSeries) -> RandomWalkProblem:
    """
    Set up energies, then durations, of all arcs as a linear problem.

    Returns
    -------
    problem : RandomWalkProblem
        Values: n energies, n periods. Unknowns: ln ω² of the first arc, 2 ln e, half the difference of 2 ln e, zero
        offset, tilt, common error of α, of ln of the durations.
    """
    count, nothing = series.number.size, np.zeros(series.number.size)
    number = (series.number - series.number[0]).astype(np.float64)
    # Impacts that ended arcs on the positive side less those on the negative one, since the first arc.
    alternating = np.where(number % 2 == 1, series.side[0], 0.0)
    energies = [
        np.ones(count),
        number,
        alternating,
        series.side * series.energy_by_peak,
        -series.side * series.energy_by_critical,
        -series.energy_by_critical,
        nothing,
    ]
    moved = _moved(series)
    periods = [
        *(nothing, nothing, nothing),
        series.side * moved,
        series.side * series.period_by_critical,
        series.period_by_critical,
        np.ones(count),
    ]
    walk = np.zeros((2 * count, 2 * count))
    walk[:count, :count] = np.minimum.outer(number, number)
    return RandomWalkProblem(
        np.vstack((np.column_stack(energies), np.column_stack(periods))),
        np.concatenate((series.energy, series.period)),
        series.covariance(),
        walk,
    )


def zero_drift(series: ArcSeries) -> Array:
    """Give the column of `sides_problem` of a zero that drifts, by the drift over the arcs; none in their middle."""
    middle = (series.start + series.end) / 2
    along = (middle - (middle[0] + middle[-1]) / 2) / (middle[-1] - middle[0])
    return np.asarray(np.concatenate((series.energy_by_peak, _moved(series))) * np.tile(series.side * along, 2))


def _moved(series: ArcSeries) -> Array:
    """Change of ln of the durations by an offset: it moves the zeros that one lies between, and the peak with them."""
    return np.asarray(2 / (series.speed * series.duration) - series.period_by_peak)


def _unequal_restitution(fit: RandomWalkFit) -> Departure | None:
    mean, half = float(fit.coefficients[LOSS]) / 2, float(fit.coefficients[UNEQUAL]) / 2
    negative, positive = float(np.exp(mean - half)), float(np.exp(mean + half))
    difference, error = positive - negative, float(np.exp(mean)) * fit.error(UNEQUAL)
    if not fit.is_sure(UNEQUAL, SURE) or abs(difference) < max(LEAST_DIFFERENCE * abs(1 - np.exp(mean)), 2 * SCALE):
        return None
    return Departure(
        "unequal restitution",
        difference,
        error,
        "1",
        f"The two sides differ in e: {positive:.4f} of impacts from θ > 0, {negative:.4f} from θ < 0, "
        f"a difference of {difference:+.4f} ± {error:.4f}. The value given is of both together.",
    )


def _unequal_sides(fit: RandomWalkFit, least: float) -> Departure | None:
    tilt, error = float(fit.coefficients[TILT]), fit.error(TILT)
    if not fit.is_sure(TILT, SURE) or abs(tilt) < least:
        return None
    return Departure(
        UNEQUAL_SIDES,
        tilt,
        error,
        "rad",
        f"The critical angles of the two sides differ by 2 × ({1e3 * tilt:+.2f} ± {1e3 * error:.2f}) mrad from those "
        "of the block: arcs on one side last longer than on the other at the same peak. The table is tilted by as "
        "much, or the block is not as symmetric as given (table_tilt, critical_angle).",
    )


def _zero_drift(fit: RandomWalkFit, critical: float) -> Departure | None:
    drift, error = float(fit.coefficients[DRIFT]), fit.error(DRIFT)
    if not fit.is_sure(DRIFT, SURE) or abs(drift) < LEAST_DRIFT * critical:
        return None
    return Departure(
        "zero drift",
        drift,
        error,
        "rad",
        f"The zero of the angle drifts by {1e3 * drift:+.2f} ± {1e3 * error:.2f} mrad over the arcs. The whole history "
        "allows for it; the peaks do not. Check the transducers' mounts and the warm-up of the recorder.",
    )
