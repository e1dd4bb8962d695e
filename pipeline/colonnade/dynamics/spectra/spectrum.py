"""Rocking spectrum of a recorded motion: the largest angle of rectangular blocks over their size and slenderness."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Mask
from colonnade.digest import Digested
from colonnade.dynamics.block import STANDARD_GRAVITY, Block, Sided, pair
from colonnade.dynamics.maps.chart import MOST_THREADS
from colonnade.dynamics.models.nonlinear import NONLINEAR
from colonnade.dynamics.models.plane import PlaneModel
from colonnade.dynamics.models.registry import plane_model_of
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.outcomes import prepared
from colonnade.dynamics.plane.run import expect_usable, series_of
from colonnade.validation import instance, number, samples, sided, whole


@dataclass(frozen=True, repr=False)
class RockingSpectrum(Digested):
    """
    Largest angles of blocks on one motion.

    Attributes
    ----------
    critical_angle : ndarray, shape (n,)
        α, rad.
    period : ndarray, shape (m,)
        2π/p, s.
    peak_ratio : ndarray, shape (n, m)
        Largest |θ|/α; NaN where the block overturns, 0 where it does not uplift.
    peak_velocity_ratio : ndarray, shape (n, m)
        Largest |θ'|/p, rad, up to overturning.
    overturned : ndarray of bool, shape (n, m)
        Whether the block overturns.
    restitution : ndarray, shape (n, 2)
        e of each α, of impacts that end an arc at θ < 0, and at θ > 0.
    model : str
        Its name.

    Examples
    --------
    >>> import numpy as np
    >>> import colonnade
    >>> motion = colonnade.Motion(3.0 * np.sin(np.pi * np.arange(51) / 25), 0.01)
    >>> found = colonnade.rocking_spectrum(motion, critical_angle=[0.2], period=[1.0, 2.0])
    >>> found.overturned.tolist(), found.digest()["overturned"]
    ([[True, False]], '1 of 2')
    """

    critical_angle: Array
    period: Array
    peak_ratio: Array
    peak_velocity_ratio: Array
    overturned: Mask
    restitution: Array
    model: str

    def digest(self) -> dict[str, str]:
        """
        Return model, axes and how many blocks overturn.

        Returns
        -------
        digest : dict of str to str
            Names and values with their units, as a notebook shows them.
        """
        angles, periods = self.critical_angle, self.period
        return {
            "model": self.model,
            "α": f"{angles.min():.3g} to {angles.max():.3g} rad in {angles.size}",
            "2π/p": f"{periods.min():.3g} to {periods.max():.3g} s in {periods.size}",
            "overturned": f"{int(self.overturned.sum())} of {self.overturned.size}",
        }


def rocking_spectrum(
    motion: Motion,
    *,
    critical_angle: ArrayLike,
    period: ArrayLike,
    restitution: Sided | None = None,
    model: str = NONLINEAR.name,
    gravity: float = STANDARD_GRAVITY,
    threads: int = 1,
) -> RockingSpectrum:
    """
    Compute the rocking spectrum of a recorded motion.

    Parameters
    ----------
    motion : Motion
        Along x and, if given, z.
    critical_angle : array_like, shape (n,)
        α of the blocks, rad.
    period : array_like, shape (m,)
        2π/p of the blocks, s; for a rectangular block p² = 3 g/(4 R).
    restitution : float or pair of float, optional
        e, the pair for impacts that end an arc at (θ < 0, θ > 0); by default that of a rigid rectangular
        block without bounce, 1 − (3/2) sin² α.
    model : str, optional
        A plane one.
    gravity : float, optional
        m/s².
    threads : int, optional
        Blocks computed at a time. The result is the same to the last bit.

    Returns
    -------
    spectrum : RockingSpectrum

    Raises
    ------
    ValueError
        If an angle, a period or e is out of its range or the model is not known.

    Notes
    -----
    After Makris and Konstantinidis (2003): p, unlike a natural period, is a measure of size only, and the spectrum has
    to be read for one slenderness at a time.

    Examples
    --------
    >>> motion = Motion(3.0 * np.sin(np.linspace(0, 2 * np.pi, 200)), 0.005)
    >>> spectrum = rocking_spectrum(motion, critical_angle=[0.2, 0.4], period=[0.8, 6.0])
    >>> spectrum.overturned.tolist()
    [[True, False], [False, False]]
    """
    instance("motion", motion, Motion)
    angles, periods = (_axis(*each) for each in (("critical_angle", critical_angle), ("period", period)))
    gravity = number("gravity", gravity, "a positive acceleration in m/s²", above=0.0)
    if restitution is not None:
        restitution = sided("restitution", restitution, "a number between 0 and 1", low=0.0, high=1.0)
    chosen = plane_model_of(model)
    threads = whole("threads", threads, 1, MOST_THREADS)
    blocks = [rectangular(alpha, one, gravity) for alpha in angles.tolist() for one in periods.tolist()]
    expect_usable(max(blocks, key=lambda block: block.p), motion)
    with ThreadPoolExecutor(threads) as pool:
        found = np.array(list(pool.map(lambda block: _peaks(block, motion, restitution, chosen), blocks)))
    peak, velocity, overturned = found.T.reshape(3, angles.size, periods.size)
    e = np.array([pair(blocks[row * periods.size].restitution) for row in range(angles.size)])
    if restitution is not None:
        e[:] = restitution
    return RockingSpectrum(angles, periods, peak, velocity, overturned > 0.0, e, model)


def _peaks(block: Block, motion: Motion, restitution: Sided | None, model: PlaneModel) -> tuple[float, float, float]:
    """Largest |θ|/α and |θ'|/p of a block from rest, and 1 if it overturns."""
    from colonnade.dynamics.plane.sampled_march import propagate

    alpha = block.critical_angle
    if motion.vertical is None and motion.peak <= block.gravity * model.uplift_threshold(alpha):
        return 0.0, 0.0, 0.0
    sides = prepared(block, block.restitution if restitution is None else restitution)
    base, series = motion.acceleration / block.gravity, series_of(model, motion, block.gravity)
    angle, velocity, _, _, overturning = propagate(base, motion.dt, sides, 0.0, 0.0, series)
    if np.isfinite(overturning):
        standing = velocity[: int(overturning / motion.dt) + 1]
        return float("nan"), float(np.abs(standing).max()) / block.p, 1.0
    return float(np.abs(angle).max()) / alpha, float(np.abs(velocity).max()) / block.p, 0.0


def _axis(name: str, values: ArrayLike) -> Array:
    return samples(name, values, dimensions=(0, 1)).ravel()


def rectangular(critical_angle: float, period: float, gravity: float = STANDARD_GRAVITY) -> Block:
    """
    Build a rectangular block by its α (rad) and 2π/p (s); its mass is 1 kg.

    Raises
    ------
    ValueError
        If one of them is out of its range.
    """
    period = number("period", period, "a positive number of seconds", above=0.0)
    distance = 0.75 * gravity / (2 * pi / period) ** 2
    return Block.measured(
        mass=1.0,
        pole_distance=distance,
        critical_angle=critical_angle,
        inertia=4 / 3 * distance**2,
        gravity=gravity,
    )
