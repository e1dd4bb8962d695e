"""The kinds of record of the study: what varies from record to record, and the noisy record of one draw."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block, Side
from colonnade.signals.filters import default_lowpass, lowpass
from monte_carlo.truth import FreeRocking

SPREAD: dict[str, tuple[float, float]] = {
    "restitution": (0.85, 0.985),
    "slenderness": (3.0, 10.0),
    "height": (0.2, 3.0),
    "release": (0.3, 0.85),
    "rate": (100.0, 2000.0),
    "noise": (1e-4, 5e-3),
    "offset": (-0.005, 0.005),
    "impacts": (6.0, 40.0),
}
"""Limits of what varies in every kind: e; height over width; m; over α; Hz; over α; over α; impacts."""

LOGARITHMIC = ("height", "rate", "noise", "impacts")
"""What is spread evenly by its logarithm; the others are by their value."""

LOWEST = 0.02
"""Of α: a record ends before its peaks are lower."""

PINK = 0.8
"""Share of the noise's variance that has a power of 1/f in records with such noise."""

BY_SPEED = -0.02
"""Change of e from the slowest to the fastest impact, in the records where it depends on the speed."""

LONGEST_HOLD = 1.0
"""s, in the hand before the release; half of the records begin with it, the others at the release."""

ASYMMETRY = 0.15
"""Largest eccentricity of the centre of mass of an asymmetric block, over half its width."""


@dataclass(frozen=True)
class Kind:
    """Records of one kind: error of α, p and gain (s), scatter of e, and what else is fixed."""

    name: str
    error: float
    scatter: float
    fixed: dict[str, Any] = field(default_factory=dict)


def kinds() -> list[Kind]:
    """List the kinds of the study."""
    crossed = [
        Kind(f"s {100 * error:g} %, scatter {scatter:g}", error, scatter)
        for error in (0.0, 0.0025, 0.005, 0.01)
        for scatter in (0.0, 0.001, 0.005)
    ]
    usual = 0.005, 0.002
    return [
        *crossed,
        Kind("white noise, not filtered", *usual, {"pink": 0.0, "filtered": False}),
        Kind("1/f noise, not filtered", *usual, {"pink": PINK, "filtered": False}),
        Kind("white noise, filtered", *usual, {"pink": 0.0, "filtered": True}),
        Kind("1/f noise, filtered", *usual, {"pink": PINK, "filtered": True}),
        Kind("1/f noise, one e, known block", 0.0, 0.0, {"pink": PINK}),
        Kind("6 to 10 impacts", *usual, {"impacts": (6.0, 11.0)}),
        Kind("20 to 40 impacts", *usual, {"impacts": (20.0, 41.0)}),
        Kind("prisms", *usual, {"shape": "prism"}),
        Kind("cylinders", *usual, {"shape": "cylinder"}),
        Kind("asymmetric blocks", *usual, {"shape": "asymmetric"}),
        Kind("e changes with speed", 0.005, 0.0, {"by_speed": BY_SPEED}),
        Kind("e changes with speed and scatters", *usual, {"by_speed": BY_SPEED}),
    ]


@dataclass(frozen=True)
class Draw:
    """
    One record of the study.

    Attributes
    ----------
    block : Block
        As the laboratory knows it.
    errors : tuple of float
        ln of true over known α and p, and of measured over true angle.
    width : float
        Their standard deviation, as the estimator is given it.
    scatter : float
        Standard deviation of e from impact to impact.
    rocking : FreeRocking
        What the block truly does.
    noise, offset : float
        Standard deviation of the noise, zero offset, over α.
    rate : float
        Hz.
    pink : float
        Share of the noise's variance that has a power of 1/f.
    filtered : bool
        Whether the record went through the low-pass of the condition stage.
    phase : float
        Share of the sampling interval between the clock's zero and the record's.
    seed : tuple of int
        Of the noise.
    truth : float
        e, or its mean.
    chance : ndarray, shape (m,)
        What chance adds to e at each impact.
    """

    block: Block
    errors: tuple[float, float, float]
    width: float
    scatter: float
    rocking: FreeRocking
    noise: float
    offset: float
    rate: float
    pink: float
    filtered: bool
    phase: float
    seed: tuple[int, ...]
    truth: float
    chance: Array

    @property
    def cutoff(self) -> float | None:
        """Hz; None without a filter."""
        return default_lowpass(self.block.p, self.rate) if self.filtered else None

    def clock(self) -> Array:
        """Times of the samples, s."""
        return np.asarray((np.arange(int(self.rocking.end() * self.rate)) + self.phase) / self.rate)

    def record(self) -> tuple[Array, Array]:
        """Times, s, and measured angles, rad."""
        time, alpha = self.clock(), self.block.critical_angle
        random = np.random.default_rng(self.seed)
        noise = np.sqrt(1 - self.pink) * random.normal(size=time.size)
        if self.pink:
            noise += np.sqrt(self.pink) * pink_noise(time.size, random)
        angle = np.exp(self.errors[2]) * self.rocking.angle(time) + self.offset * alpha + self.noise * alpha * noise
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


def block_of(shape: str, height: float, slenderness: float, random: np.random.Generator) -> Block:
    """Return a block of a shape; mass and depth do not matter."""
    width = height / slenderness
    if shape == "cylinder":
        return Block.cylinder(diameter=width, height=height, mass=100.0)
    prism = Block.prism(width=width, depth=0.3, height=height, mass=100.0)
    if shape == "prism":
        return prism
    about_centre = prism.inertia - 100.0 * prism.pole_distance**2
    shift = random.uniform(-ASYMMETRY, ASYMMETRY) * width / 2
    sides = []
    for half in (width / 2 + shift, width / 2 - shift):
        distance = float(np.hypot(half, height / 2))
        sides.append(Side(float(np.arctan2(half, height / 2)), distance, about_centre + 100.0 * distance**2))
    return replace(prism, negative=sides[0], positive=sides[1])


def draw(kind: Kind, seed: int, number: int) -> Draw:
    """Draw the `number`-th record of a kind; it is the same however many records are drawn."""
    random = np.random.default_rng((seed, number, 1))
    value: dict[str, float] = {}
    for factor, limits in SPREAD.items():
        low, high = kind.fixed.get(factor, limits)
        share = random.random()
        value[factor] = float(low * (high / low) ** share if factor in LOGARITHMIC else low + share * (high - low))
    shape = kind.fixed.get("shape", str(random.choice(["prism", "cylinder", "asymmetric"])))
    block = block_of(shape, value["height"], value["slenderness"], random)
    errors = tuple(kind.error * random.normal(size=3))
    sides = block.sides
    alpha = tuple(float(side.critical_angle * np.exp(errors[0])) for side in sides)
    p = tuple(float(block.side_p(side) * np.exp(errors[1])) for side in sides)
    release = random.choice([-1.0, 1.0]) * value["release"] * min(alpha)
    # As many impacts as leave peaks that can be seen.
    lost = np.log(LOWEST * (2 - LOWEST) / (value["release"] * (2 - value["release"])))
    impacts = max(min(int(value["impacts"]), int(lost / (2 * np.log(value["restitution"])))), 6)
    e = np.minimum(value["restitution"] + kind.scatter * random.normal(size=impacts), 0.9995)
    chance = e - value["restitution"]
    hold = float(random.integers(2) * random.uniform(0.1, LONGEST_HOLD))
    rocking = FreeRocking(alpha, p, e, release, hold)
    while not rocking.course()[2].min() > 1e-3 * np.sin(min(alpha) / 2) ** 2:
        rocking = replace(rocking, release_angle=0.9 * rocking.release_angle)
    truth = value["restitution"]
    if change := kind.fixed.get("by_speed", 0.0):
        speeds = np.sqrt(value["release"] * (2 - value["release"])) * value["restitution"] ** np.arange(impacts)
        by_speed = -change / float(np.ptp(speeds))
        rocking = replace(rocking, restitution=e + by_speed * float(speeds.mean()), by_speed=by_speed)
        truth = float(rocking.course()[1].mean())
    return Draw(
        block, errors, kind.error, kind.scatter, rocking, value["noise"], value["offset"], value["rate"],
        kind.fixed.get("pink", PINK if number % 3 == 0 else 0.0),
        kind.fixed.get("filtered", bool(random.integers(2))),
        float(random.random()), (seed, number), truth, chance,
    )  # fmt: skip
