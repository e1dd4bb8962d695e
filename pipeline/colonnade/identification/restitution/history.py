"""Coefficient of restitution from the whole history of a free vibration: exact free rocking laid through the angle."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import exp, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs import Arcs
from colonnade.identification.restitution.decay import ALWAYS, OPTIONAL, Decay
from colonnade.identification.restitution.follow import Followed, UnfollowedError, closest_cutoff, follow
from colonnade.identification.restitution.forward import first_guess, followed_forward, stretch_of, without_first
from colonnade.identification.restitution.noise import (
    Noise,
    filtered_products,
    fit_noise,
    measured_products,
    weighted_products,
)
from colonnade.identification.restitution.result import Estimate, FittedHistory
from colonnade.identification.restitution.samples import Samples

Array = NDArray[np.float64]

FEWEST_ARCS = 4
"""Arcs that have to be followed in the end, that after release included."""

MOST_CUTOFFS = 5
SAME_CUTOFF = 0.03
"""Change of the cut-off, as a share of it, below which it is taken as found."""

FINEST_CUTOFF = 0.45
"""Of the sampling rate of the samples fitted: a filter above it rounds nothing that they see."""

UNLIKELY = 0.005
"""Probability below which what is left over is more than noise."""

ALLOWED_EXCESS = 1.1
"""Mean square of the residuals over what their spectrum tells of the noise: what the spectrum's own fit may miss."""

ASSUMPTIONS = (
    "plane rocking without slide or bounce; one e for all impacts; the block's p and critical angles, unless freed; "
    "both sides about one zero; noise that is stationary, white or low-passed"
)


@dataclass(frozen=True)
class HistoryFit:
    """
    Free rocking laid through a record.

    Attributes
    ----------
    estimate : Estimate
    model : str
    decay : Decay or None
        None where refused, and so are all that follow.
    names : tuple of str
        Of the unknowns; "restitution" stands for ln e, "critical_angle" and "p" for the logarithm of their factor.
    covariance : ndarray, shape (k, k)
    noise : Noise or None
    probability : float
        That noise alone leaves as much over, arc by arc.
    fitted : FittedHistory or None
    start, stop : float
        s, the fitted part.
    """

    estimate: Estimate
    model: str
    decay: Decay | None = None
    names: tuple[str, ...] = ALWAYS
    covariance: Array = field(default_factory=lambda: np.empty((0, 0)))
    noise: Noise | None = None
    probability: float = 0.0
    fitted: FittedHistory | None = None
    start: float = np.nan
    stop: float = np.nan

    @property
    def is_consistent(self) -> bool:
        """Whether what is left over is no more than noise."""
        return self.decay is not None and self.probability >= UNLIKELY


def fit_history(
    samples: Samples,
    arcs: Arcs,
    block: Block,
    *,
    model: str = "nonlinear",
    free: tuple[str, ...] = (),
    lowest: float,
    level: float = 0.95,
    lowpass: float | None = None,
    from_release: bool = True,
) -> HistoryFit:
    """
    Identify e as the value with which exact free rocking follows the measured angle most closely.

    Parameters
    ----------
    samples : Samples
    arcs : Arcs
        That were seen in the record: where to start.
    block : Block
        Its critical angles and p are taken as given, unless freed.
    model : {"linear", "nonlinear"}
    free : tuple of {"critical_angle", "p"}
        What is identified beside e, the release and the zero offset.
    lowest : float
        rad; arcs with lower peaks are not followed.
    level : float
        Of the interval.
    lowpass : float, optional
        Hz, of the zero-phase Butterworth filter that the record went through; found from the residuals otherwise.

    from_release : bool
        Whether the part between release and the first arc may be followed, if it fits.

    Returns
    -------
    fit : HistoryFit

    Notes
    -----
    Between impacts the motion is known in closed form from its peak (see `rocking_arc`), so that a history has four
    unknowns: e, the first peak and its time, and the zero offset. With white noise least squares on all samples reach
    the Cramér–Rao bound. The times of the impacts weigh most: a wrong p or critical angle, a drifting zero or
    three-dimensional rocking enter e here, where the peaks hardly see them. Nothing holds e to the rigid-body value.

    A low-pass rounds the corners at impacts; the fitted history is passed through the same filter. Its cut-off, where
    not given, and the level of the noise come from the spectrum of the residuals. The covariance of the unknowns is
    (JᵀJ)⁻¹ JᵀΓJ (JᵀJ)⁻¹ with the noise's Γ. Whether noise alone explains the residuals is asked arc by arc: freeing
    the peak and the time of each arc may not lessen the sum of squares by more than it does by chance. Where it does,
    the residuals' own spectrum stands for that of the noise.
    """
    name = f"history-{model}"
    try:
        decay = first_guess(arcs, block, linearised=model == "linear")
        names = ALWAYS + free
        followed, released = followed_forward(samples, decay, names, lowest, from_release=from_release)
        return _judged(followed, released, samples, names, name, level, lowpass)
    except (UnfollowedError, np.linalg.LinAlgError) as error:
        reason = f"No simulated history follows the record: {error}."
        return HistoryFit(Estimate(name, None, None, None, None, level, ASSUMPTIONS, reason), model)


def _judged(
    followed: Followed,
    from_release: bool,
    samples: Samples,
    names: tuple[str, ...],
    name: str,
    level: float,
    lowpass: float | None,
) -> HistoryFit:
    """Find the noise, follow the record once more as that allows, and judge what is left over."""
    cutoff = usable_cutoff(_noise(followed, samples, None).cutoff_hz if lowpass is None else lowpass, samples)
    for attempt in range(MOST_CUTOFFS):
        stretch = stretch_of(samples, followed.decay, from_release=from_release, cutoff_hz=cutoff)
        followed = follow(followed.decay, stretch, names)
        noise = _noise(followed, samples, cutoff if attempt > 0 and lowpass is None else lowpass)
        if from_release and _first_arc_left_over(followed, noise):
            followed, from_release = replace(followed, decay=without_first(followed.decay)), False
            continue
        if lowpass is not None or cutoff is None or _probability(followed, noise, len(names)) >= UNLIKELY:
            break
        # What is left over lies at the corners: there the cut-off shows more clearly than in the noise.
        closer = usable_cutoff(closest_cutoff(followed.decay, stretch, cutoff), samples)
        if closer is None or abs(closer - cutoff) < SAME_CUTOFF * cutoff:
            break
        cutoff = closer
    if followed.decay.count < FEWEST_ARCS:
        raise UnfollowedError(f"only {followed.decay.count} arcs could be followed, {FEWEST_ARCS} are needed")
    probability = _probability(followed, noise, len(names))
    covariance = _covariance(followed, names, noise, consistent=probability >= UNLIKELY)
    error = sqrt(covariance[0, 0])
    counted = int(np.isfinite(followed.residual).sum())
    half = float(stats.t.ppf((1 + level) / 2, max(min(noise.freedom, counted) - len(names), 1.0))) * error
    logarithm = followed.decay.values["restitution"]
    low, value, high = (exp(bound) for bound in (logarithm - half, logarithm, logarithm + half))
    model = name.removeprefix("history-")
    logarithmic = np.array([each in ("restitution", *OPTIONAL) for each in names])
    values = np.array([followed.decay.values[each] for each in names])
    values = np.where(logarithmic, np.exp(values), values)
    by_logarithm = np.where(logarithmic, values, 1.0)
    return HistoryFit(
        Estimate(name, value, low, high, value * error, level, ASSUMPTIONS, residual=sqrt(followed.mean_square)),
        model,
        followed.decay,
        names,
        covariance,
        noise,
        probability,
        FittedHistory(
            stretch.time,
            followed.angle,
            followed.residual,
            model,
            names,
            values,
            covariance * np.outer(by_logarithm, by_logarithm),
            probability,
            cutoff,
        ),
        float(stretch.time[0]),
        float(stretch.time[-1]),
    )


def _noise(followed: Followed, samples: Samples, lowpass: float | None) -> Noise:
    if samples.interval is None:
        count = int(np.isfinite(followed.residual).sum())
        return Noise(followed.mean_square, None, 0.0, 1.0, count)
    noise = fit_noise(followed.residual, samples.interval, cutoff_hz=lowpass)
    # What the unknowns have taken up is missing in the residuals.
    return replace(noise, level=noise.level / max(1 - len(ALWAYS) / noise.freedom, 0.5))


def usable_cutoff(cutoff_hz: float | None, samples: Samples) -> float | None:
    """Return a cut-off (Hz) that rounds what the samples show; else None."""
    if cutoff_hz is None or samples.interval is None or cutoff_hz > FINEST_CUTOFF / samples.interval:
        return None
    return cutoff_hz


def _lessened(followed: Followed) -> tuple[Array, NDArray[np.int_]]:
    """By how much freeing its peak and time would lessen each arc's sum of squares, and how many unknowns these are."""
    products, gradients = followed.products[:, :2, :2], followed.gradients[:, :2]
    scale = np.sqrt(np.maximum(products.diagonal(axis1=1, axis2=2), 1e-300))
    scaled = products / (scale[:, :, None] * scale[:, None, :])
    values, vectors = np.linalg.eigh(scaled)
    determined = (values > 1e-6) & (products[:, :1, 0] > 0)
    along = np.einsum("nji,nj->ni", vectors, gradients / scale)
    return np.where(determined, along**2 / np.where(determined, values, 1.0), 0.0).sum(axis=1), determined.sum(axis=1)


def _probability(followed: Followed, noise: Noise, unknowns: int) -> float:
    lessened, freed = _lessened(followed)
    # The offset is not freed arc by arc.
    freedom = int(freed.sum()) - (unknowns - 1)
    if freedom < 1 or not noise.level > 0:
        return 0.0
    by_arc = float(stats.f.sf(lessened.sum() / freedom / noise.level, freedom, max(noise.freedom, 1.0)))
    excess = followed.mean_square / max(noise.variance, 1e-300)
    # Within arcs what is left over is judged by its power beside that of the noise as its spectrum has it.
    within = float(stats.f.sf(excess / ALLOWED_EXCESS, noise.freedom, noise.freedom))
    return min(by_arc, within)


def _first_arc_left_over(followed: Followed, noise: Noise) -> bool:
    lessened, freed = _lessened(followed)
    if freed[0] == 0:
        return False
    return bool(stats.f.sf(lessened[0] / freed[0] / noise.level, freed[0], max(noise.freedom, 1.0)) < 1e-3)


def _covariance(followed: Followed, names: tuple[str, ...], noise: Noise, *, consistent: bool) -> Array:
    jacobian = followed.jacobian(names)
    if consistent or noise.freedom < 20:
        inverse = np.linalg.inv(filtered_products(jacobian, noise)) if noise.cutoff_hz else followed.inverse
        products = weighted_products(jacobian, noise)
    else:
        inverse = followed.inverse
        products = measured_products(jacobian, followed.residual, noise.interval)
    return np.asarray(inverse @ products @ inverse)
