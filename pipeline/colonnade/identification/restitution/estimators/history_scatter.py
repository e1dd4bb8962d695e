"""Coefficient of restitution from the whole history; each impact has its own e about one mean."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import exp, isfinite

import numpy as np
import scipy
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.identification.restitution.estimators.estimator import Estimator
from colonnade.identification.restitution.estimators.history import (
    FEWEST_ARCS,
    HistoryFit,
    fitted_history,
    usable_cutoff,
)
from colonnade.identification.restitution.fitting.driven_decay import DrivenDecay
from colonnade.identification.restitution.fitting.forecast import (
    BLURRED,
    earlier,
    first_guess,
    stretch_of,
    without_first,
)
from colonnade.identification.restitution.fitting.free_decay import ALWAYS, OPTIONAL, Decay
from colonnade.identification.restitution.fitting.least_squares import Stretch, UnfollowedError
from colonnade.identification.restitution.fitting.mixture import MeanByScatter, mean_over_scatters
from colonnade.identification.restitution.fitting.noise import fit_noise
from colonnade.identification.restitution.fitting.rocking_path import RockingPath, fit_path, fit_path_forward
from colonnade.identification.restitution.fitting.samples import AngleSamples
from colonnade.identification.restitution.fitting.scatter_likelihood import (
    Reduction,
    Solution,
    explained,
    reduced,
    solve,
)
from colonnade.identification.restitution.fitting.scatter_model import LinearModel, Products, SpectralModel
from colonnade.identification.restitution.free_vibration import FreeVibration

MOST_ROUNDS = 4
SAME_SCATTER = 0.1
"""Change of the scatter, as a share of it, below which the iteration stops."""

LEAST_SCATTER = 3e-6
"""Scatter of ln e for the path if no scatter is found."""

FIRST_SCATTER = 1e-3

LEAST_NOISE = 1e-6
"""Of α, standard deviation: less is the rounding of computed records."""

RELEASE_UNLIKELY = 1e-3
"""Probability below which the part after the release is not free rocking from rest."""

FEWEST_OF_TREND = 5
"""Impacts."""

SURE_TREND = 0.003
"""Probability of a change of e with the speed of impact by chance, below which the mean is that at the mean speed."""


@dataclass(frozen=True)
class ScatteredFit(HistoryFit):
    """
    A history fitted to the record with its own e for each impact; `estimate` is of the mean e.

    Attributes
    ----------
    scatter : float
        Standard deviation of e from impact to impact.
    change, change_error : float
        Of e over the speeds of impact seen, and its standard error; NaN with fewer than `FEWEST_OF_TREND` impacts.
    restitution : ndarray, shape (m,)
        e of each impact, drawn towards the mean as far as noise allows.
    """

    scatter: float = np.nan
    change: float = np.nan
    change_error: float = np.nan
    restitution: Array = field(default_factory=lambda: np.empty(0))

    @property
    def change_chance(self) -> float:
        """Probability that e changes as much by chance; 1 if that is not known."""
        return _chance(self.change, self.change_error, self.restitution.size)

    @property
    def has_trend(self) -> bool:
        """Whether e changes with the speed of impact, surely enough that the mean is that at the mean speed."""
        return self.change_chance < SURE_TREND


class ScatteredHistory(Estimator[ScatteredFit]):
    """
    The mean e of the impacts, each with an e of its own.

    Notes
    -----
    Unknown are the mean of ln e, how it departs from it at each impact (normal, with a standard deviation that is
    unknown too), the first peak and its time, the zero offset and its drift. The path is fitted by penalised least
    squares; about it the model is linear, with noise of the spectrum σ² (1 + knee / frequency) before the low-pass.
    The interval is a mixture over all scatters and knees by their restricted likelihood (`mixture.mean_over_scatters`).
    Without scatter it is that of one e for all impacts; with much scatter it is Student's about the mean of single e.
    """

    name = "history-scatter"
    label = "whole history, e of each impact"
    assumptions = (
        "plane rocking without slide or bounce; e of each impact about one mean, independent of the others; the "
        "block's p and critical angles, unless freed; both sides about one zero, that may drift; noise that is "
        "stationary, white or of power 1/f, and low-passed as given"
    )
    description = (
        "nonlinear free rocking in which e of each impact varies about one mean, with a drifting zero, and noise that "
        "is white or of power 1/f; the interval is a mixture over all scatters of e by their restricted likelihood"
    )
    references = ("patterson",)
    method = (
        "whole history: exact nonlinear rocking with an e of its own at each impact, about one mean; interval over all "
        "scatters of e by restricted likelihood, with the noise's own spectrum"
    )
    priority = 1
    follows_table = True
    result = ScatteredFit

    def fit(self, record: FreeVibration) -> ScatteredFit:
        """Follow the arcs from the first one that enters; before it the part from release, if that fits."""
        try:
            decay = first_guess(record.followed_arcs, record.block, linearised=False)
            if record.base is not None:
                decay = DrivenDecay.of(decay, record.base)
            path = fit_path_forward(record.samples, RockingPath(decay), record.least)
            before = earlier(path.decay, record.samples) if record.left_out == 0 else None
            if before is not None:
                try:
                    return self._fitted(record, replace(path, decay=before), from_release=True)
                except UnfollowedError:
                    pass
            return self._fitted(record, path, from_release=False)
        except (UnfollowedError, np.linalg.LinAlgError) as error:
            return self.refuse(record.level, f"No simulated history follows the record: {error}.")

    def _fitted(self, record: FreeVibration, path: RockingPath, *, from_release: bool) -> ScatteredFit:
        if path.decay.count < FEWEST_ARCS:
            raise UnfollowedError(f"{FEWEST_ARCS} arcs are needed, and {path.decay.count} could be followed")
        samples, names = record.samples, ALWAYS + record.free
        margin = BLURRED / float(path.decay.p.max())
        stretch = stretch_of(samples, path.decay, from_release=from_release, margin=margin)
        path = fit_path(path, stretch, names, FIRST_SCATTER)
        cutoff = usable_cutoff(record.lowpass, samples)
        if record.lowpass is None and samples.interval is not None:
            cutoff = _found_cutoff(path, samples, names, from_release=from_release)
        stretch = stretch_of(samples, path.decay, from_release=from_release, cutoff_hz=cutoff)
        scatter = FIRST_SCATTER
        for _ in range(MOST_ROUNDS):
            path = fit_path(path, stretch, names, max(scatter, LEAST_SCATTER))
            # Noise of power 1/f hardly moves the path: it is looked for at the end.
            parts, _ = solve(reduced([_white(path, stretch, names)]))
            found = float(np.average(parts.scatter, weights=np.exp(parts.likelihood - parts.likelihood.max())))
            if abs(found - scatter) <= SAME_SCATTER * scatter:
                break
            scatter = found
        transformed = SpectralModel(_linear(path, stretch, names))
        reduction = reduced(transformed.all_products(), _along_speed(path.decay))
        parts, best = solve(reduction.of_columns(np.arange(len(names) + 1)))
        own, of_all = transformed.products_by_stretch(*_own_times(path, stretch), best.products.knee)
        if from_release and explained(best, own[:1, :1], of_all[:1]) < RELEASE_UNLIKELY:
            return self._fitted(record, replace(path, decay=without_first(path.decay)), from_release=False)
        probability = explained(best, own, of_all)
        # A block that is not as given shows most clearly in its own parameters.
        if others := tuple(name for name in OPTIONAL if name not in names):
            of_block, _ = path.decay.jacobian(stretch.time, others)
            of_block[~np.isfinite(path.residual(stretch))] = 0.0
            probability = min(probability, explained(best, *transformed.products_with(of_block, best.products.knee)))
        trend = _trend(reduction, path.decay.count - 1, len(names) + 1)
        return self._described(record, path, stretch, trend, parts, best, probability)

    def _described(
        self,
        record: FreeVibration,
        path: RockingPath,
        stretch: Stretch,
        trend: tuple[float, float, MeanByScatter | None],
        parts: MeanByScatter,
        best: Solution,
        probability: float,
    ) -> ScatteredFit:
        names, logarithm = ALWAYS + record.free, path.decay.values["restitution"]
        change, change_error, at_mean_speed = trend
        mean = mean_over_scatters(at_mean_speed or parts, record.level).moved(logarithm)
        residual = path.residual(stretch)
        rms = float(np.sqrt(np.nanmean(residual**2)))
        estimate = self.estimate_of(mean, record.level, residual=rms)
        covariance = best.covariance()[: len(names), : len(names)]
        fitted = fitted_history(path.decay, stretch, path.seen(stretch), residual, covariance, names)
        e = exp(mean.value)
        return ScatteredFit(
            estimate,
            replace(fitted, probability=probability),
            path.decay,
            probability,
            e * mean.scatter,
            e * change,
            e * change_error,
            np.exp(logarithm + path.decay.by_impact),
        )


def _found_cutoff(
    path: RockingPath, samples: AngleSamples, names: tuple[str, ...], *, from_release: bool
) -> float | None:
    """Low-pass that the residuals show, Hz, where the record's corners are rounded by it; else None."""
    assert samples.interval is not None
    wide = stretch_of(samples, path.decay, from_release=from_release)
    cutoff = usable_cutoff(fit_noise(path.residual(wide), samples.interval).cutoff_hz, samples)
    if cutoff is None:
        return None
    filtered = replace(wide, cutoff_hz=cutoff)
    sharp, rounded = (fit_path(path, each, names, FIRST_SCATTER).residual(each) for each in (wide, filtered))
    return cutoff if np.nansum(rounded**2) < np.nansum(sharp**2) else None


def _linear(path: RockingPath, stretch: Stretch, names: tuple[str, ...]) -> LinearModel:
    residual, fixed, by_impact = path.linear(stretch, names)
    counted = np.isfinite(residual)
    # As seen from the mean: what the impacts' own departures explain is left in the values.
    values = np.where(counted, residual, 0.0) + by_impact @ path.decay.by_impact
    least = _least(path)
    return LinearModel(values, fixed, by_impact, int(counted.sum()), least, stretch.interval, stretch.cutoff_hz)


def _white(path: RockingPath, stretch: Stretch, names: tuple[str, ...]) -> Products:
    """Products with white noise of the model that `_linear` gives; without a low-pass they are sums over arcs."""
    if stretch.cutoff_hz is not None:
        return SpectralModel(_linear(path, stretch, names)).white()
    residual = path.residual(stretch)
    counted = residual[np.isfinite(residual)]
    products, gradient = path.normal_equations(residual, stretch, names)
    fixed, own = len(names) + 1, path.decay.by_impact
    # As seen from the mean: what the impacts' own departures explain is left in the values.
    explained = products[:, fixed:] @ own
    square = counted @ counted + own @ (2 * gradient[fixed:] + explained[fixed:])
    with_values = gradient + explained
    lengths = np.maximum(np.sqrt(np.diag(products)[:fixed]), 1e-300)
    across, scaled = with_values[:fixed] / lengths, products[:fixed, :fixed] / np.outer(lengths, lengths)
    outer = np.vstack((np.append(square, across), np.column_stack((across, scaled))))
    side = np.column_stack((with_values[fixed:], products[fixed:, :fixed] / lengths))
    return Products(0.0, outer, side, products[fixed:, fixed:], lengths, 0.0, float(counted.size), _least(path))


def _least(path: RockingPath) -> float:
    """Least variance of the noise, rad²."""
    return float((LEAST_NOISE * path.decay.critical.min()) ** 2)


def _own_times(path: RockingPath, stretch: Stretch) -> tuple[Array, NDArray[np.int_]]:
    """Derivative of the angle by a time of its own for each arc, which no e can bring about, and where arcs start."""
    angle, arc = path.decay.followed(stretch.time)
    _, starts = np.unique(arc, return_index=True)
    return np.where(np.isfinite(path.residual(stretch)), np.gradient(angle, stretch.time), 0.0), starts


def _along_speed(decay: Decay) -> Array | None:
    """Speed of each impact from its mean, over the range of speeds; None if there are too few impacts for a trend."""
    speed = decay.landing_speeds()[:-1]
    extent = float(np.ptp(speed))
    return (speed - speed.mean()) / extent if speed.size >= FEWEST_OF_TREND and extent > 0 else None


def _trend(reduction: Reduction, impacts: int, unknowns: int) -> tuple[float, float, MeanByScatter | None]:
    """Change of ln e over the speeds of impact, its error, and if it is sure what the mean is at the mean speed."""
    if reduction.lengths.size == unknowns:
        return np.nan, np.nan, None
    # The coefficient that is asked for comes first.
    parts, _ = solve(reduction.of_columns(np.append(unknowns, np.arange(unknowns))))
    top = int(np.argmax(parts.likelihood))
    change, error = float(parts.centre[top]), float(parts.error[top])
    return change, error, None if _chance(change, error, impacts) >= SURE_TREND else solve(reduction)[0]


def _chance(change: float, error: float, impacts: int) -> float:
    """Probability that e of so many impacts changes as much by chance, by Student's t; 1 where that is not known."""
    if not (isfinite(change) and error > 0):
        return 1.0
    return 2 * float(scipy.special.stdtr(impacts - 2, -abs(change) / error))
