"""Coefficient of restitution from the whole history, where each impact has an e of its own about one mean."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import exp, isfinite

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs import Arcs
from colonnade.identification.restitution.decay import ALWAYS, OPTIONAL, Decay
from colonnade.identification.restitution.driven_decay import Base, DrivenDecay
from colonnade.identification.restitution.follow import Stretch, UnfollowedError
from colonnade.identification.restitution.forward import (
    BLURRED,
    earlier,
    first_guess,
    stretch_of,
    without_first,
)
from colonnade.identification.restitution.history import FEWEST_ARCS, UNLIKELY, usable_cutoff
from colonnade.identification.restitution.mixture import Parts, mean_of
from colonnade.identification.restitution.noise import fit_noise
from colonnade.identification.restitution.own_path import Path, laid, tracked
from colonnade.identification.restitution.result import Estimate, FittedHistory
from colonnade.identification.restitution.samples import Samples
from colonnade.identification.restitution.scatter_model import Linear, Solved, Transformed, explained, solve

Array = NDArray[np.float64]

NAME = "history-scatter"

ASSUMPTIONS = (
    "plane rocking without slide or bounce; e of each impact about one mean, independent of the others; the block's p "
    "and critical angles, unless freed; both sides about one zero, that may drift; noise that is stationary, white or "
    "of power 1/f, and low-passed as given"
)

MOST_ROUNDS = 4
SAME_SCATTER = 0.1
"""Change of the scatter, as a share of it, below which it is taken as found."""

LEAST_SCATTER = 3e-6
"""Of ln e, with which a path is laid where no scatter is found."""

FIRST_SCATTER = 1e-3

LEAST_NOISE = 1e-6
"""Of α, standard deviation: less is the rounding of computed records."""

RELEASE_UNLIKELY = 1e-3
"""Probability below which the part after the release is not that of a block let go."""

SURE_TREND = 0.003
"""Probability of a change of e with the speed of impact by chance, below which the mean is that at the mean speed."""


@dataclass(frozen=True)
class EachImpact:
    """
    A history laid through the record with an e of its own for each impact.

    Attributes
    ----------
    estimate : Estimate
        Of the mean e.
    decay : Decay or None
        None where refused, and so are all that follow.
    probability : float
        That noise and scatter alone leave as much over.
    scatter : float
        Standard deviation of e from impact to impact.
    change, change_error : float
        Of e over the speeds of impact seen, and its standard error; NaN with fewer than 5 impacts.
    impact_times, restitution : ndarray, shape (m,)
        s; e of each impact, drawn towards the mean as far as noise allows.
    fitted : FittedHistory or None
    """

    estimate: Estimate
    decay: Decay | None = None
    probability: float = 0.0
    scatter: float = np.nan
    change: float = np.nan
    change_error: float = np.nan
    impact_times: Array = field(default_factory=lambda: np.empty(0))
    restitution: Array = field(default_factory=lambda: np.empty(0))
    fitted: FittedHistory | None = None

    @property
    def change_chance(self) -> float:
        """Probability that e changes as much by chance; 1 where that is not known."""
        return _chance(self.change, self.change_error, self.restitution.size)

    @property
    def has_trend(self) -> bool:
        """Whether e changes with the speed of impact, surely enough that the mean is that at the mean speed."""
        return self.change_chance < SURE_TREND

    @property
    def is_consistent(self) -> bool:
        """Whether what is left over is no more than noise."""
        return self.decay is not None and self.probability >= UNLIKELY


def fit_each_impact(
    samples: Samples,
    arcs: Arcs,
    block: Block,
    *,
    free: tuple[str, ...] = (),
    lowest: float,
    level: float = 0.95,
    lowpass: float | None = None,
    from_release: bool = True,
    base: Base | None = None,
) -> EachImpact:
    """
    Identify the mean e of the impacts; arguments as of `history.fit_history`.

    Parameters
    ----------
    base : Base, optional
        Motion of a table that moves.

    Returns
    -------
    fit : EachImpact

    Notes
    -----
    Unknown are the mean of ln e, how it departs from it at each impact (normal, with a standard deviation that is
    unknown too), the first peak and its time, the zero offset and its drift. The path is laid by penalised least
    squares; about it the model is linear, with noise of the spectrum σ² (1 + knee / frequency) before the low-pass.
    The interval is a mixture over all scatters and knees by their restricted likelihood (`mixture.mean_of`). Without
    scatter it is that of one e for all impacts; with much scatter it is Student's about the mean of single e.
    """
    try:
        names = ALWAYS + free
        decay = first_guess(arcs, block, linearised=False)
        if base is not None:
            decay = DrivenDecay.of(decay, base)
        path = tracked(samples, Path(decay), lowest)
        before = earlier(path.decay, samples) if from_release else None
        if before is not None:
            try:
                return _fitted(samples, replace(path, decay=before), names, level, lowpass, from_release=True)
            except UnfollowedError:
                pass
        return _fitted(samples, path, names, level, lowpass, from_release=False)
    except (UnfollowedError, np.linalg.LinAlgError) as error:
        reason = f"No simulated history follows the record: {error}."
        return EachImpact(Estimate(NAME, None, None, None, None, level, ASSUMPTIONS, reason))


def _fitted(
    samples: Samples, path: Path, names: tuple[str, ...], level: float, lowpass: float | None, *, from_release: bool
) -> EachImpact:
    if path.decay.count < FEWEST_ARCS:
        raise UnfollowedError(f"only {path.decay.count} arcs could be followed, {FEWEST_ARCS} are needed")
    margin = BLURRED / float(path.decay.p.max())
    stretch = stretch_of(samples, path.decay, from_release=from_release, margin=margin)
    path = laid(path, stretch, names, FIRST_SCATTER)
    cutoff = usable_cutoff(lowpass, samples)
    if lowpass is None and samples.interval is not None:
        cutoff = _found_cutoff(path, samples, names, from_release=from_release)
    stretch = stretch_of(samples, path.decay, from_release=from_release, cutoff_hz=cutoff)
    scatter = FIRST_SCATTER
    for _ in range(MOST_ROUNDS):
        path = laid(path, stretch, names, max(scatter, LEAST_SCATTER))
        transformed = Transformed(_linear(path, stretch, names))
        # What noise is of power 1/f hardly moves the path: it is asked for at the end.
        parts, best = solve(transformed, white=True)
        found = float(np.average(parts.scatter, weights=np.exp(parts.likelihood - parts.likelihood.max())))
        if abs(found - scatter) <= SAME_SCATTER * scatter:
            break
        scatter = found
    parts, best = solve(transformed)
    own = _own_columns(path, stretch)
    if from_release and explained(transformed, best, own[:, :1]) < RELEASE_UNLIKELY:
        shorter = replace(path, decay=without_first(path.decay))
        return _fitted(samples, shorter, names, level, lowpass, from_release=False)
    # A block that is not as given shows most clearly in its own parameters.
    others = tuple(name for name in OPTIONAL if name not in names)
    of_block, _ = path.decay.jacobian(stretch.time, others)
    of_block[~np.isfinite(path.residual(stretch))] = 0.0
    probability = min(explained(transformed, best, own), explained(transformed, best, of_block) if others else 1.0)
    return _described(path, stretch, names, level, parts, best, probability)


def _found_cutoff(path: Path, samples: Samples, names: tuple[str, ...], *, from_release: bool) -> float | None:
    """Low-pass that the residuals show, Hz, where the record's corners are rounded by it; else None."""
    assert samples.interval is not None
    wide = stretch_of(samples, path.decay, from_release=from_release)
    cutoff = usable_cutoff(fit_noise(path.residual(wide), samples.interval).cutoff_hz, samples)
    if cutoff is None:
        return None
    filtered = replace(wide, cutoff_hz=cutoff)
    sharp, rounded = (laid(path, each, names, FIRST_SCATTER).residual(each) for each in (wide, filtered))
    return cutoff if np.nansum(rounded**2) < np.nansum(sharp**2) else None


def _linear(path: Path, stretch: Stretch, names: tuple[str, ...]) -> Linear:
    residual, fixed, by_impact = path.linear(stretch, names)
    counted = np.isfinite(residual)
    # As seen from the mean: what the impacts' own departures explain is left in the values.
    values = np.where(counted, residual, 0.0) + by_impact @ path.decay.by_impact
    least = float((LEAST_NOISE * path.decay.critical.min()) ** 2)
    return Linear(values, fixed, by_impact, int(counted.sum()), least, stretch.interval, stretch.cutoff_hz)


def _own_columns(path: Path, stretch: Stretch) -> Array:
    """A time of its own for each arc, shape (n, count): what no e of an impact can bring about."""
    angle, arc = path.decay.followed(stretch.time)
    inside = (arc[:, None] == np.arange(path.decay.count)) & np.isfinite(path.residual(stretch))[:, None]
    return np.asarray(inside * np.gradient(angle, stretch.time)[:, None])


def _trend(path: Path, stretch: Stretch, names: tuple[str, ...]) -> tuple[float, float, Parts | None] | None:
    """Change of ln e over the speeds of impact, its error, and where it is sure what the mean is at the mean speed."""
    impacts = path.decay.count - 1
    if impacts < 5:
        return None
    speed = path.decay.impact_speeds()
    extent = float(np.ptp(speed))
    if not extent > 0:
        return None
    linear = _linear(path, stretch, names)
    along = linear.by_impact @ ((speed - speed.mean()) / extent)
    # The coefficient that is asked for comes first.
    parts, _ = solve(Transformed(replace(linear, fixed=np.column_stack((along, linear.fixed)))))
    top = int(np.argmax(parts.likelihood))
    change, error = float(parts.centre[top]), float(parts.error[top])
    if _chance(change, error, impacts) >= SURE_TREND:
        return change, error, None
    at_mean, _ = solve(Transformed(replace(linear, fixed=np.column_stack((linear.fixed, along)))))
    return change, error, at_mean


def _chance(change: float, error: float, impacts: int) -> float:
    """Probability that e of so many impacts changes as much by chance, by Student's t; 1 where that is not known."""
    if not (isfinite(change) and error > 0):
        return 1.0
    return 2 * float(stats.t.sf(abs(change) / error, impacts - 2))


def _described(
    path: Path,
    stretch: Stretch,
    names: tuple[str, ...],
    level: float,
    parts: Parts,
    best: Solved,
    probability: float,
) -> EachImpact:
    logarithm = path.decay.values["restitution"]
    change, change_error = np.nan, np.nan
    trend = _trend(path, stretch, names)
    if trend is not None:
        change, change_error = trend[:2]
        parts = trend[2] or parts
    mean = mean_of(parts, level)
    low, value, high = (exp(logarithm + each) for each in (mean.low, mean.value, mean.high))
    residual = path.residual(stretch)
    estimate = Estimate(
        NAME,
        value,
        low,
        high,
        value * mean.standard_error,
        level,
        ASSUMPTIONS,
        residual=float(np.sqrt(np.nanmean(residual**2))),
    )
    logarithmic = np.array([each in ("restitution", *OPTIONAL) for each in names])
    values = np.array([path.decay.values[each] for each in names])
    values = np.where(logarithmic, np.exp(values), values)
    by_logarithm = np.where(logarithmic, values, 1.0)
    covariance = best.covariance()[: len(names), : len(names)] * np.outer(by_logarithm, by_logarithm)
    fitted = FittedHistory(
        stretch.time,
        path.seen(stretch),
        residual,
        "nonlinear",
        names,
        values,
        covariance,
        probability,
        stretch.cutoff_hz,
    )
    return EachImpact(
        estimate,
        path.decay,
        probability,
        value * mean.scatter,
        value * change,
        value * change_error,
        path.decay.arcs()[2][:-1],
        np.exp(logarithm + path.decay.by_impact),
        fitted,
    )
