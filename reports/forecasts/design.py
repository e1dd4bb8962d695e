"""The random design: specimens whose e is identified from virtual free vibrations, and the motions of their tests."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import signal

from colonnade.arrays import Array
from colonnade.campaign.settings import PlaneEnsembleSettings
from colonnade.dynamics.block import Block
from colonnade.dynamics.ensembles.uncertainty import INPUTS, Uncertainty, draw_inputs, member_block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
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
    settings = PlaneEnsembleSettings()
    return Uncertainty(
        restitution=restitution,
        restitution_freedom=freedom,
        critical_angle=settings.critical_angle,
        p=settings.p,
        gain=settings.gain,
        clock=settings.clock,
        noise=NOISE,
        cutoff=CUTOFF,
    )


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
