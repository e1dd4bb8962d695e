"""Coefficient of restitution from the whole history of a free vibration: exact free rocking fitted to the angle."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import sqrt
from typing import ClassVar

import numpy as np
import scipy
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.identification.restitution.estimators.estimator import Estimator, Fit
from colonnade.identification.restitution.fitting.forecast import first_guess, fit_forward, stretch_of, without_first
from colonnade.identification.restitution.fitting.free_decay import ALWAYS, OPTIONAL, Decay
from colonnade.identification.restitution.fitting.least_squares import (
    DecayFit,
    Stretch,
    UnfollowedError,
    closest_cutoff,
    fit_decay,
)
from colonnade.identification.restitution.fitting.mixture import mean_of_student
from colonnade.identification.restitution.fitting.noise import (
    Noise,
    filtered_products,
    fit_noise,
    measured_products,
    weighted_products,
)
from colonnade.identification.restitution.fitting.samples import AngleSamples
from colonnade.identification.restitution.free_vibration import FreeVibration
from colonnade.identification.restitution.result import FittedHistory

FEWEST_ARCS = 4
"""Arcs that have to be followed in the end, that after release included."""

MOST_CUTOFFS = 5
SAME_CUTOFF = 0.03
"""Change of the cut-off, as a share of it, below which the iteration stops."""

FINEST_CUTOFF = 0.45
"""Of the sampling rate of the samples fitted: a filter above it rounds nothing that they see."""

UNLIKELY = 0.005
"""Probability below which the residual is more than noise."""

ALLOWED_EXCESS = 1.1
"""Mean square of the residuals over the noise by their spectrum: what the spectrum's own fit may miss."""


@dataclass(frozen=True)
class HistoryFit(Fit):
    """
    Free rocking fitted to a record.

    Attributes
    ----------
    decay : Decay or None
        None if refused.
    probability : float
        That noise alone leaves as much over, arc by arc.
    """

    decay: Decay | None = None
    probability: float = 0.0

    @property
    def is_consistent(self) -> bool:
        """Whether the residual is no more than noise."""
        return self.decay is not None and self.probability >= UNLIKELY

    @property
    def objection(self) -> str:
        """Why the value cannot be used by itself: refused, or the residual is more than noise."""
        misfit = "" if self.is_consistent else "The residual of the whole history is more than noise."
        return self.estimate.reason or misfit

    @property
    def zero_offset(self) -> float:
        """Zero offset of the history, rad; 0 if refused."""
        return 0.0 if self.decay is None else self.decay.values["zero_offset"]


class WholeHistory(Estimator[HistoryFit]):
    """
    The value of e with which exact free rocking with one e follows the measured angle most closely.

    Attributes
    ----------
    model : {"linear", "nonlinear"}

    Notes
    -----
    Between impacts the motion is known in closed form from its peak (see `rocking_arc`), so that a history has four
    unknowns: e, the first peak and its time, and the zero offset. With white noise least squares on all samples reach
    the Cramér–Rao bound. The times of the impacts weigh most: a wrong p or critical angle, a drifting zero or
    three-dimensional rocking enter e here, where the peaks hardly see them. Nothing holds e to the rigid-body value.

    A low-pass rounds the corners at impacts; the fitted history is passed through the same filter. Its cut-off, if
    not given, and the level of the noise come from the spectrum of the residuals. The covariance of the unknowns is
    (JᵀJ)⁻¹ JᵀΓJ (JᵀJ)⁻¹ with the noise's Γ. Whether noise alone explains the residuals is asked arc by arc: freeing
    the peak and the time of each arc may not lessen the sum of squares by more than it does by chance. If it does,
    the residuals' own spectrum replaces that of the noise.
    """

    assumptions = (
        "plane rocking without slide or bounce; one e for all impacts; the block's p and critical angles, unless "
        "freed; both sides about one zero; noise that is stationary, white or low-passed"
    )
    result = HistoryFit
    model: ClassVar[str]

    def fit(self, record: FreeVibration) -> HistoryFit:
        """Follow the arcs from the first one that enters; before it the part from release, if that fits."""
        try:
            decay = first_guess(record.followed_arcs, record.block, linearised=self.model == "linear")
            followed, released = fit_forward(
                record.samples, decay, ALWAYS + record.free, record.least, from_release=record.left_out == 0
            )
            return self._judged(followed, released, record)
        except (UnfollowedError, np.linalg.LinAlgError) as error:
            return self.refuse(record.level, f"No simulated history follows the record: {error}.")

    def lowpass(self, record: FreeVibration) -> float | None:
        """Return the low-pass to take as known, Hz; None for one to be found."""
        return record.lowpass

    def _judged(self, followed: DecayFit, from_release: bool, record: FreeVibration) -> HistoryFit:
        """Find the noise, follow the record once more as that allows, and judge the residual."""
        names = ALWAYS + record.free
        followed, stretch, noise = _through_lowpass(followed, record.samples, names, self.lowpass(record), from_release)
        if followed.decay.count < FEWEST_ARCS:
            raise UnfollowedError(f"{FEWEST_ARCS} arcs are needed, and {followed.decay.count} could be followed")
        probability = _probability(followed, noise, len(names))
        covariance = _covariance(followed, names, noise, consistent=probability >= UNLIKELY)
        counted = int(np.isfinite(followed.residual).sum())
        freedom = max(min(noise.freedom, counted) - len(names), 1.0)
        mean = mean_of_student(followed.decay.values["restitution"], sqrt(covariance[0, 0]), freedom, record.level)
        fitted = fitted_history(followed.decay, stretch, followed.angle, followed.residual, covariance, names)
        fitted = replace(fitted, model=self.model, probability=probability)
        estimate = self.estimate_of(mean, record.level, residual=sqrt(followed.mean_square))
        return HistoryFit(estimate, fitted, followed.decay, probability)


class NonlinearHistory(WholeHistory):
    """Free rocking by the full equation."""

    name = "history-nonlinear"
    label = "whole history, nonlinear"
    description = "the same with the full equation of rocking"
    method = "whole history: exact nonlinear rocking, least squares, errors with the noise's own spectrum"
    model = "nonlinear"


class LinearHistory(WholeHistory):
    """Free rocking by the linearised equation."""

    name = "history-linear"
    label = "whole history, linear"
    description = (
        "free rocking by the linearised equation, with one e, fitted to all samples by least squares; its errors "
        "follow from the spectrum of the noise"
    )
    model = "linear"

    def lowpass(self, record: FreeVibration) -> float | None:
        """Take the low-pass that the nonlinear history found."""
        nonlinear = record.fitted(NonlinearHistory()).fitted
        return record.lowpass if nonlinear is None else nonlinear.cutoff_hz or np.inf


def fitted_history(
    decay: Decay, stretch: Stretch, angle: Array, residual: Array, covariance: Array, names: tuple[str, ...]
) -> FittedHistory:
    """Describe a fit by its unknowns themselves, where the fit has the logarithms of some; `covariance` is of these."""
    logarithmic = np.array([each in ("restitution", *OPTIONAL) for each in names])
    values = np.array([decay.values[each] for each in names])
    values[logarithmic] = np.exp(values[logarithmic])
    by_logarithm = np.where(logarithmic, values, 1.0)
    covariance = covariance * np.outer(by_logarithm, by_logarithm)
    return FittedHistory(
        stretch.time, angle, residual, "nonlinear", names, values, covariance, cutoff_hz=stretch.cutoff_hz
    )


def _through_lowpass(
    followed: DecayFit, samples: AngleSamples, names: tuple[str, ...], lowpass: float | None, from_release: bool
) -> tuple[DecayFit, Stretch, Noise]:
    """Follow the record through its low-pass, which is found if None is given; with its noise."""
    cutoff = usable_cutoff(_noise(followed, samples, None).cutoff_hz if lowpass is None else lowpass, samples)
    for attempt in range(MOST_CUTOFFS):
        stretch = stretch_of(samples, followed.decay, from_release=from_release, cutoff_hz=cutoff)
        followed = fit_decay(followed.decay, stretch, names)
        noise = _noise(followed, samples, cutoff if attempt > 0 and lowpass is None else lowpass)
        if from_release and _first_arc_left_over(followed, noise):
            followed, from_release = replace(followed, decay=without_first(followed.decay)), False
            continue
        if lowpass is not None or cutoff is None or _probability(followed, noise, len(names)) >= UNLIKELY:
            break
        # The residual is largest at the corners: there the cut-off shows more clearly than in the noise.
        closer = usable_cutoff(closest_cutoff(followed.decay, stretch, cutoff), samples)
        if closer is None or abs(closer - cutoff) < SAME_CUTOFF * cutoff:
            break
        cutoff = closer
    return followed, stretch, noise


def _noise(followed: DecayFit, samples: AngleSamples, lowpass: float | None) -> Noise:
    if samples.interval is None:
        count = int(np.isfinite(followed.residual).sum())
        return Noise(followed.mean_square, None, 0.0, 1.0, count)
    noise = fit_noise(followed.residual, samples.interval, cutoff_hz=lowpass)
    # What the unknowns have taken up is missing in the residuals.
    return replace(noise, level=noise.level / max(1 - len(ALWAYS) / noise.freedom, 0.5))


def usable_cutoff(cutoff_hz: float | None, samples: AngleSamples) -> float | None:
    """Return a cut-off (Hz) that rounds what the samples show; else None."""
    if cutoff_hz is None or samples.interval is None or cutoff_hz > FINEST_CUTOFF / samples.interval:
        return None
    return cutoff_hz


def _lessened(followed: DecayFit) -> tuple[Array, NDArray[np.int_]]:
    """By how much freeing its peak and time would lessen each arc's sum of squares, and how many unknowns these are."""
    products, gradients = followed.products[:, :2, :2], followed.gradients[:, :2]
    scale = np.sqrt(np.maximum(products.diagonal(axis1=1, axis2=2), 1e-300))
    scaled = products / (scale[:, :, None] * scale[:, None, :])
    values, vectors = np.linalg.eigh(scaled)
    determined = (values > 1e-6) & (products[:, :1, 0] > 0)
    along = np.einsum("nji,nj->ni", vectors, gradients / scale)
    return np.where(determined, along**2 / np.where(determined, values, 1.0), 0.0).sum(axis=1), determined.sum(axis=1)


def _probability(followed: DecayFit, noise: Noise, unknowns: int) -> float:
    lessened, freed = _lessened(followed)
    # The offset is not freed arc by arc.
    freedom = int(freed.sum()) - (unknowns - 1)
    if freedom < 1 or not noise.level > 0:
        return 0.0
    by_arc = float(scipy.stats.f.sf(lessened.sum() / freedom / noise.level, freedom, max(noise.freedom, 1.0)))
    excess = followed.mean_square / max(noise.variance, 1e-300)
    # Within arcs the power of the residual is held against that of the noise by its spectrum.
    within = float(scipy.stats.f.sf(excess / ALLOWED_EXCESS, noise.freedom, noise.freedom))
    return min(by_arc, within)


def _first_arc_left_over(followed: DecayFit, noise: Noise) -> bool:
    lessened, freed = _lessened(followed)
    if freed[0] == 0:
        return False
    return bool(scipy.stats.f.sf(lessened[0] / freed[0] / noise.level, freed[0], max(noise.freedom, 1.0)) < 1e-3)


def _covariance(followed: DecayFit, names: tuple[str, ...], noise: Noise, *, consistent: bool) -> Array:
    if consistent and noise.cutoff_hz is None:
        return noise.level * followed.inverse
    jacobian = followed.jacobian(names)
    if consistent or noise.freedom < 20:
        inverse = np.linalg.inv(filtered_products(jacobian, noise)) if noise.cutoff_hz else followed.inverse
        products = weighted_products(jacobian, noise)
    else:
        inverse = followed.inverse
        products = measured_products(jacobian, followed.residual, noise.interval)
    return np.asarray(inverse @ products @ inverse)
