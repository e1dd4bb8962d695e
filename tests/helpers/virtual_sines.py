"""Virtual sine tests of a prism whose truth differs from the model that predicts its limits."""

from dataclasses import dataclass
from functools import cached_property
from math import pi

import numpy as np

from colonnade.dynamics.block import Block, Side
from colonnade.dynamics.maps import stability_map
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.dynamics.uncertainty import member_block, member_restitution
from prism import PRISM

RESTITUTION = 0.976
"""The paper's prism, as the predicting model knows it."""

FREQUENCIES = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0)
"""Hz, the paper's."""

WRONG_RESTITUTION = 0.01
"""By how much e of the truth differs, up or down."""

WRONG_BLOCK, WRONG_GAIN = 0.005, 0.02
"""Standard deviations, relative: of α and p of the truth from those measured, and of the table's calibration."""

PHASE, RESTITUTION_SCATTER, TILT, GAIN = np.deg2rad(3.0), 0.002, 0.002, 0.005
"""
Standard deviations from test to test: of the start phase, rad (1 ms at 7 Hz, 8 ms at 1 Hz); of e, as free vibrations
scatter; of the tilt at rest over α (0.4 mrad, 0.03 mm across the base: dust, roughness); of the true A over that
achieved, relative, as accelerometers and controllers go.
"""

DRAWS = 60
"""Tests that are drawn at each A for the true boundary."""

SAMPLES_A_CYCLE = 100


@dataclass(frozen=True)
class Truth:
    """A true prism on a true table, which moves by one sine cycle: e, factors of α, p and of the amplitude."""

    restitution: float
    critical_angle: float
    p: float
    gain: float

    @classmethod
    def drawn(cls, seed):
        """Draw the truth of a seed; e is wrong upwards for even seeds and downwards for odd ones."""
        rng = np.random.default_rng([seed, 1])
        angle, p = np.exp(WRONG_BLOCK * rng.standard_normal(2))
        sign = 1 if seed % 2 == 0 else -1
        return cls(RESTITUTION + sign * WRONG_RESTITUTION, angle, p, float(np.exp(WRONG_GAIN * rng.standard_normal())))

    @cached_property
    def block(self):
        return member_block(PRISM, self.critical_angle, self.p)

    def overturns(self, frequency, amplitude_ratio, rng):
        """Run one test by the nonlinear model."""
        return self._run(frequency, amplitude_ratio, rng.standard_normal(4))

    def _run(self, frequency, amplitude_ratio, drawn):
        phase, restitution, tilt, gain = drawn * (PHASE, RESTITUTION_SCATTER, TILT, GAIN)
        dt = 1 / (frequency * SAMPLES_A_CYCLE)
        acceleration = np.sin(2 * pi * np.arange(SAMPLES_A_CYCLE + 1) / SAMPLES_A_CYCLE + phase)
        factor = amplitude_ratio * self.gain * np.exp(gain) * PRISM.uplift_acceleration
        motion = Motion(np.append(factor * acceleration, 0.0), dt)
        history = rock(
            _tilted(self.block, tilt),
            motion,
            restitution=member_restitution(self.restitution, restitution),
            model="nonlinear",
        )
        return history.outcome == "overturned"

    def surface(self, frequency, amplitudes, draws):
        """Share of tests that overturn at each A, the same draws at all of them."""
        drawn = np.random.default_rng(12345).standard_normal((draws, 4))
        return np.array([np.mean([self._run(frequency, a, d) for d in drawn]) for a in amplitudes])

    def boundary(self, frequency, near, draws=DRAWS):
        """A at which half of the tests overturn, for the first time going up over at least 1 %; NaN if never."""
        coarse = near * np.exp(np.arange(-0.16, 0.2, 0.02))
        share = self.surface(frequency, coarse, draws // 3)
        if not (share >= 0.5).any():
            return float("nan")
        first = int(np.argmax(share >= 0.5))
        fine = coarse[first] * np.exp(np.arange(-0.06, 0.04, 0.004))
        share = self.surface(frequency, fine, draws)
        lasting = (share[:-3] >= 0.5) & (share[1:-2] >= 0.5) & (share[2:-1] >= 0.5) & (share[3:] >= 0.5)
        at = int(np.argmax(lasting))
        if at == 0:
            return float("nan")
        return float(np.interp(0.5, share[at - 1 : at + 1], fine[at - 1 : at + 1]))


def _tilted(block, tilt):
    """The block at rest on a base that leans by a fraction of α: sooner over to one side, later to the other."""
    sides = (
        Side(side.critical_angle * (1 + sign * tilt), side.pole_distance, side.inertia)
        for side, sign in zip(block.sides, (1, -1), strict=True)
    )
    return Block(block.mass, block.gravity, *sides, block.solid)


def predicted_limits(restitution=RESTITUTION, frequencies=FREQUENCIES):
    """`lower` of the linear model's map at the frequencies of the tests."""
    chart = stability_map(
        PRISM,
        frequency_ratio=2 * pi * np.array(frequencies) / PRISM.p,
        amplitude_ratio=[0.9, 9.0],
        restitution=restitution,
        cycles=1.0,
        ramp=0.0,
        model="linear",
    )
    return chart.lower
