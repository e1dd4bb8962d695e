"""Campaigns of the study of forecasts: random specimens, their tests, what was truly observed, and forecasts of it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy import signal

from colonnade.arrays import Array
from colonnade.campaign.settings import PlaneEnsembleSettings
from colonnade.dynamics.block import Block
from colonnade.dynamics.ensemble import ensemble
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.dynamics.uncertainty import INPUTS, MotionDraws, Uncertainty, draw_inputs, member_block
from colonnade.identification.forecasts import Forecast, Response, forecast_of
from colonnade.identification.restitution.identify import identify_restitution
from colonnade.identification.restitution.pooling import Pooled, pool
from colonnade.readers.motion import el_centro

HEIGHTS = (0.3, 0.456, 0.6, 1.5)
"""Of the prisms, m."""

SLENDERNESS = (4.0, 7.0)
RESTITUTION = (0.90, 0.97)
"""Ranges of height over width, and of the mean of the true e."""

SCATTER = 0.001
"""Standard deviation of the true e from test to test."""

RELEASES = (0.6, -0.5, 0.7)
"""θ/α from which the free vibrations start."""

FREE_RATE, FREE_DURATION, ANGLE_NOISE = 250.0, 10.0, 0.002
"""Of the free vibrations: samples a second; s; noise of the angle over α."""

INTERVAL, DURATION, QUIET = 0.005, 12.0, 0.5
"""Of the motions, s: sampling interval, length, and rest before each."""

NOISE, CUTOFF = 0.01, 40.0
"""Of the table's acceleration: m/s² after its low-pass; Hz."""

KINDS = ("earthquake", "sine", "earthquake", "El Centro", "earthquake")
"""Motions of a campaign's tests, in turn."""


@dataclass(frozen=True)
class Specimen:
    """
    One campaign's specimen.

    Attributes
    ----------
    block : Block
        As the campaign has it.
    true_block : Block
    true_restitution : float
        Its mean; each test has its own.
    gain : float
        True acceleration of the table over the recorded one.
    identified : Pooled
        e from the free vibrations.
    """

    block: Block
    true_block: Block
    true_restitution: float
    gain: float
    identified: Pooled

    @property
    def uncertainty(self) -> Uncertainty:
        """What the campaign knows of its errors: e in a new test, and the default settings for all others."""
        return uncertainty(*self.identified.of_new_test(PlaneEnsembleSettings().restitution))


def uncertainty(restitution: float, freedom: int | None = None) -> Uncertainty:
    """Errors of the default settings, with a standard deviation of e and its degrees of freedom."""
    known = {name: getattr(PlaneEnsembleSettings(), name) for name in ("critical_angle", "p", "gain", "clock")}
    return Uncertainty(restitution=restitution, restitution_freedom=freedom, noise=NOISE, cutoff=CUTOFF, **known)


def draw_specimen(random: np.random.Generator) -> Specimen:
    """Draw a specimen, and identify its e from free vibrations of the true block with the known one."""
    height = random.choice(HEIGHTS)
    width = height / random.uniform(*SLENDERNESS)
    block = Block.prism(width=width, depth=width, height=height, mass=100.0)
    errors = dict(zip(INPUTS, draw_inputs(uncertainty(0.0), random).tolist(), strict=True))
    true_block = member_block(block, errors["critical_angle"], errors["p"])
    restitution = random.uniform(*RESTITUTION)
    still = Motion(np.zeros(round(FREE_RATE * FREE_DURATION) + 1), 1 / FREE_RATE)
    found = []
    for release in RELEASES:
        start = release * block.critical_angle
        true = restitution + SCATTER * random.standard_normal()
        freed = rock(true_block, still, restitution=true, model="nonlinear", theta0=start)
        noise = random.normal(0.0, ANGLE_NOISE * block.critical_angle, freed.time.size)
        found.append(identify_restitution(freed.time, freed.angle + noise, block))
    taken = [(each.value, each.standard_error) for each in found if each.value is not None]
    return Specimen(block, true_block, restitution, errors["gain"], pool(*zip(*taken, strict=True)))


def draw_motion(kind: str, block: Block, random: np.random.Generator) -> Motion:
    """Draw a motion whose largest acceleration is 1 m/s²; its periods go with those of the block."""
    time = np.arange(round(DURATION / INTERVAL)) * INTERVAL
    rocking = block.p / (2 * np.pi)
    if kind == "sine":
        ramp = np.clip(np.minimum((time - QUIET) / 0.5, (8.0 - time) / 1.0), 0.0, 1.0)
        shape = ramp * np.sin(2 * np.pi * rocking * random.uniform(1.5, 4.0) * time)
    elif kind == "earthquake":
        shape = _synthetic(rocking * random.uniform(2.0, 5.0), time, random)
    else:
        record = el_centro()
        scale = random.uniform(0.25, 0.5)
        own = QUIET + record.time * scale
        shape = random.choice([-1, 1]) * np.interp(time, own, record.acceleration, left=0.0, right=0.0)
    return Motion(shape / np.abs(shape).max(), INTERVAL)


def _synthetic(frequency: float, time: Array, random: np.random.Generator) -> Array:
    """
    Acceleration of an earthquake on soil of a frequency, Hz: white noise filtered as by Kanai (1957) and Tajimi (1960)
    with a damping of 0.6, without its low frequencies (Clough and Penzien 1975), under an envelope.
    """
    soil, damping = 2 * np.pi * frequency, 0.6
    rock_noise = random.standard_normal(time.size)
    filtered = signal.lfilter(
        *signal.bilinear([2 * damping * soil, soil**2], [1.0, 2 * damping * soil, soil**2], 1 / INTERVAL), rock_noise
    )
    high = signal.butter(2, 0.2 * frequency, "high", fs=1 / INTERVAL, output="sos")
    envelope = np.interp(time, [QUIET, QUIET + 1.0, 4.0, 9.0], [0.0, 1.0, 1.0, 0.0])
    return np.asarray(signal.sosfilt(high, filtered) * envelope)


MODEL = "nonlinear"

WRONG = 0.01
"""Error of e in the forecasts that have to be found wrong, up and down."""

FORECASTS = {"identified": 0.0, "too high": WRONG, "too low": -WRONG}
"""What is added to the identified e. The last forecast, "rigid", uses e of a rigid body, without a scatter of e."""

RIGID = "rigid"

LEVELS = np.geomspace(1.0, 8.0, 16)
"""Largest accelerations that are tried, over that of uplift."""

PILOTS = 6
"""Runs at each of them."""

CLEAR = (0.6, 1.3)
"""Range of the level of one test in `EVERY`, whatever it is predicted to do."""

EVERY = 5


@dataclass(frozen=True)
class Tried:
    """
    A test.

    Attributes
    ----------
    kind : str
    level : float
        Largest acceleration over that of uplift.
    observed : Response
    forecasts : dict of str to Forecast
    """

    kind: str
    level: float
    observed: Response
    forecasts: dict[str, Forecast]


@dataclass(frozen=True)
class Campaign:
    """Specimen and tests."""

    specimen: Specimen
    tests: list[Tried]


def run_campaign(seed: int, number: int, tests: int, members: int) -> Campaign:
    """Draw the `number`-th campaign of a study with so many tests, and forecast each by so many members."""
    specimen = draw_specimen(np.random.default_rng((seed, number)))
    return Campaign(specimen, [_test(specimen, (seed, number, test), members) for test in range(tests)])


def _test(specimen: Specimen, place: tuple[int, int, int], members: int) -> Tried:
    random = np.random.default_rng(place)
    kind = KINDS[place[-1] % len(KINDS)]
    unit = draw_motion(kind, specimen.block, random)
    low, high = CLEAR if place[-1] % EVERY == EVERY - 1 else _undecided(specimen, unit, random)
    level = float(np.exp(random.uniform(np.log(low), np.log(high))))
    motion = _scaled(specimen, unit, level)
    forecasts = {
        name: _forecast(specimen, motion, specimen.identified.value + wrong, specimen.uncertainty, members)
        for name, wrong in FORECASTS.items()
    }
    rigid = replace(specimen.uncertainty, restitution=0.0)
    forecasts[RIGID] = _forecast(specimen, motion, specimen.block.restitution, rigid, members)
    return Tried(kind, level, _observe(specimen, motion, random), forecasts)


def _observe(specimen: Specimen, motion: Motion, random: np.random.Generator) -> Response:
    """Run the true specimen on what truly was the motion, given the recorded one."""
    known = specimen.uncertainty
    true = MotionDraws(motion, known).draw(
        random, gain=specimen.gain, clock=float(np.exp(known.clock * random.standard_normal())), cutoff=1.0
    )
    restitution = specimen.true_restitution + SCATTER * random.standard_normal()
    history = rock(specimen.true_block, true, restitution=restitution, model=MODEL)
    return Response.observed(history.outcome, history.peak_ratio)


def _forecast(
    specimen: Specimen, motion: Motion, restitution: float, uncertainty: Uncertainty, members: int
) -> Forecast:
    found = ensemble(
        specimen.block, motion, restitution=restitution, uncertainty=uncertainty, count=members, model=MODEL
    )
    return forecast_of(found.peak_ratio)


def _undecided(specimen: Specimen, unit: Motion, random: np.random.Generator) -> tuple[float, float]:
    """
    Range of one step about one of `LEVELS` between the predicted limits: some pilot runs overturn there and some stand.

    If there is none, it is the step that ends where all pilot runs overturn, or the last one.
    """
    shares = np.array([_pilot(specimen, unit, level) for level in LEVELS])
    undecided = np.flatnonzero((shares > 0) & (shares < 1))
    certain = np.flatnonzero(shares == 1)
    step = np.sqrt(LEVELS[1] / LEVELS[0])
    between = LEVELS[certain[0] if certain.size else -1] / step
    level = LEVELS[random.choice(undecided)] if undecided.size else between
    return level / step, level * step


def _pilot(specimen: Specimen, unit: Motion, level: float) -> float:
    motion = _scaled(specimen, unit, level)
    return _forecast(specimen, motion, specimen.identified.value, specimen.uncertainty, PILOTS).overturning_probability


def _scaled(specimen: Specimen, unit: Motion, level: float) -> Motion:
    return Motion(unit.acceleration * level * specimen.block.uplift_acceleration, unit.dt)
