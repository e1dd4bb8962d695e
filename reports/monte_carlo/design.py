"""The random design: what varies from record to record, in which levels, and the noisy record of one draw."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.signals.filters import default_lowpass, lowpass
from monte_carlo.integration import integrated_angle
from monte_carlo.truth import FreeRocking

LEVELS: dict[str, tuple[float, ...]] = {
    "restitution": (0.80, 0.85, 0.90, 0.95, 0.995),
    "slenderness": (3.0, 5.0, 7.0, 9.0, 12.0),
    "height": (0.2, 0.5, 1.0, 2.2, 5.0),
    "release": (0.2, 0.375, 0.55, 0.725, 0.9),
    "rate": (100.0, 266.0, 707.0, 1880.0, 5000.0),
    "noise": (1e-4, 3.16e-4, 1e-3, 3.16e-3, 1e-2),
    "offset": (-0.01, -0.005, 0.0, 0.005, 0.01),
    "impacts": (5.0, 10.0, 20.0, 35.0, 61.0),
    "scatter": (0.0, 0.0, 0.001, 0.002, 0.005),
}
"""Edges of the levels of each factor; a draw falls into each level with the same chance."""

BEYOND: dict[str, tuple[float, ...]] = LEVELS | {
    "rate": (100.0, 266.0),
    "noise": (1e-2, 3e-2, 1e-1, 3e-1),
    "impacts": (3.0, 5.0, 9.0),
    "scatter": (0.0, 0.0),
}
"""Records beyond the design, which hold less and less about e: where is a value refused?"""

LOGARITHMIC = ("height", "rate", "noise", "impacts")
"""Factors that are spread evenly by their logarithm within a level; the others are by their value."""

PINK = 0.8
"""Share of the noise's variance that has a power of 1/f, in the records that have such noise: a third of them."""

SPREAD = 3.0
"""Standard deviations of e from impact to impact by which the mean of e stays below 1."""

LONGEST_HOLD = 1.0
"""s, in the hand before the release; half of the records begin with it, the others at the release."""

REST = 2.0
"""s after the last of the motion, where a record reaches it."""

MOST_IMPACTS = 400
"""For which an e of their own is drawn; the last of them is that of all later ones."""

STOOD = 1e-6
"""|θ|/α below which the block stands."""


@dataclass(frozen=True)
class Draw:
    """
    One record of the study.

    Attributes
    ----------
    restitution, slenderness : float
        e; height over width.
    height : float
        m.
    release, noise, offset : float
        Release angle, standard deviation of the white noise and zero offset, all over α.
    rate : float
        Samples a second.
    impacts : int
        Passes from side to side in the record; a block that loses much stands before, and the record ends at rest.
    scatter : float
        Standard deviation of e from impact to impact; `restitution` is the mean of all impacts that there could be.
    pink : float
        Share of the noise's variance that has a power of 1/f.
    filtered : bool
        Whether the record went through the low-pass of the condition stage.
    hold : float
        s, from the record's start to the release.
    side : float
        1 or −1: where the block was released.
    phase : float
        Share of the sampling interval between the clock's zero and the record's; and share of the last arc recorded.
    seed : tuple of int
        Of the study, and the record's number: gives the noise, and e of each impact.
    by_speed, mean_speed : float
        Change of e from an impact at rest to one with p α; speed, over p α, at which e is as drawn.
    drift : float
        Of the zero over the record, over α.
    """

    restitution: float
    slenderness: float
    height: float
    release: float
    noise: float
    offset: float
    rate: float
    impacts: int
    scatter: float
    pink: float
    filtered: bool
    hold: float
    side: float
    phase: float
    seed: tuple[int, int]
    by_speed: float = 0.0
    mean_speed: float = 0.0
    drift: float = 0.0

    @property
    def block(self) -> Block:
        """A prism of this height and slenderness; mass and depth do not matter."""
        return Block.prism(width=self.height / self.slenderness, depth=0.3, height=self.height, mass=100.0)

    @property
    def rocking(self) -> FreeRocking:
        """What the block truly does."""
        block = self.block
        alpha = block.critical_angle
        return FreeRocking(
            alpha, block.p, self.restitution, self.side * self.release * alpha, self.hold, self.offset * alpha
        )

    @property
    def cutoff(self) -> float | None:
        """Hz; None without a filter."""
        return default_lowpass(self.block.p, self.rate) if self.filtered else None

    def restitutions(self) -> Array:
        """Return e of each impact before its speed counts; drawn once, the same for every call."""
        random = np.random.default_rng((*self.seed, 2))
        at_rest = self.restitution - self.by_speed * self.mean_speed
        return at_rest + self.scatter * random.normal(size=MOST_IMPACTS)

    def clock(self) -> Array:
        """Times of the samples, s; as the mean e would have the impacts."""
        rocking = self.rocking
        impacts, peaks = rocking.impact_times(), rocking.peak_angles()
        standing = int(np.argmax(np.abs(peaks) < STOOD * rocking.critical_angle)) or peaks.size
        if self.impacts < min(impacts.size, standing):
            end = impacts[self.impacts - 1] + self.phase * (impacts[self.impacts] - impacts[self.impacts - 1])
        else:
            end = impacts[standing - 1] + REST
        return (np.arange(int(end * self.rate)) + self.phase) / self.rate

    def motion(self, time: Array) -> tuple[Array, Array, Array]:
        """Angle without noise at these times, rad; times of the impacts so far, s, and e of each."""
        return integrated_angle(self.rocking, time, self.restitutions(), self.by_speed)

    def record(self) -> tuple[Array, Array]:
        """Times, s, and measured angles, rad."""
        time, alpha = self.clock(), self.block.critical_angle
        random = np.random.default_rng(self.seed)
        noise = np.sqrt(1 - self.pink) * random.normal(0.0, self.noise * alpha, time.size)
        if self.pink:
            noise += np.sqrt(self.pink) * self.noise * alpha * pink_noise(time.size, random)
        drift = self.drift * alpha * np.linspace(-0.5, 0.5, time.size)
        angle = self.motion(time)[0] + noise + drift
        return time, angle if self.cutoff is None else lowpass(angle, 1 / self.rate, self.cutoff)


def pink_power(count: int) -> Array:
    """Power of noise of variance 1 at the frequencies of 2 `count` samples but 0: it falls as 1/f."""
    number = np.arange(1, count + 1)
    # The highest frequency of an even number of samples counts once, all others twice.
    shares = np.where(number == count, 1.0, 2.0) / (2 * count)
    return 1 / number / float((shares / number).sum())


def pink_noise(count: int, random: np.random.Generator) -> Array:
    """Noise of variance 1, on average over all that it may be, with a power of 1/f from half a record's length on."""
    transform = np.fft.rfft(random.normal(size=2 * count))
    transform[0] = 0.0
    transform[1:] *= np.sqrt(pink_power(count))
    return np.fft.irfft(transform, 2 * count)[:count]


def draw(seed: int, number: int, levels: dict[str, tuple[float, ...]] = LEVELS) -> Draw:
    """Draw the `number`-th record of a study; it is the same however many records are drawn."""
    rng = np.random.default_rng((seed, number, 1))
    values = {}
    for factor, edges in levels.items():
        level = rng.integers(len(edges) - 1)
        low, high = edges[level], edges[level + 1]
        values[factor] = float(low * (high / low) ** rng.random()) if factor in LOGARITHMIC else rng.uniform(low, high)
    pink = PINK if levels is LEVELS and number % 3 == 0 else 0.0
    restitution = min(values["restitution"], 1 - SPREAD * values["scatter"] - 1e-3)
    return Draw(
        **values | {"impacts": int(values["impacts"]), "restitution": restitution},
        pink=pink,
        filtered=bool(rng.integers(2)),
        hold=float(rng.integers(2) * rng.uniform(0.1, LONGEST_HOLD)),
        side=float(rng.choice([-1.0, 1.0])),
        phase=float(rng.random()),
        seed=(seed, number),
    )
