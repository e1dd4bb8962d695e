"""Every step of the ladders keeps 1 % away from the boundaries of the map, which the steps enclose."""

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.laboratory.programme import CYCLES, LADDERS, LASTING, MARGIN, RAMP, RAMPS, SPECIMENS, sine

RUNGS = [(name, frequency) for name, steps in LADDERS.items() for frequency in steps]


def outcomes(name, frequency, looks, samples_per_cycle):
    """Outcomes around each step, by the nonlinear model: not the integrator that makes the truth."""
    specimen, steps = SPECIMENS[name], LADDERS[name]
    cycles, ramp = CYCLES.get(frequency, LASTING), RAMPS.get(frequency, RAMP)
    table = sine(specimen.block, "sine", frequency, 1.0, cycles=cycles, ramp=ramp).table
    dt = 1 / (frequency * samples_per_cycle)
    unit = table.acceleration(np.arange(0.0, table.stop + 1.0, dt))

    def outcome(amplitude):
        motion = Motion(amplitude * unit, dt)
        return rock(specimen.block, motion, restitution=specimen.restitution, model="nonlinear").outcome

    around = np.linspace(1 - MARGIN, 1 + MARGIN, looks)
    return [set(map(outcome, step * around)) for step in steps[frequency]]


@pytest.mark.parametrize(("name", "frequency"), RUNGS)
def test_the_outcome_is_the_same_at_the_ends_of_every_steps_neighbourhood(name, frequency):
    found = outcomes(name, frequency, looks=3, samples_per_cycle=300)
    assert {len(around) for around in found} == {1}
    in_order = [next(iter(around)) for around in found]
    assert in_order[0] == "no-rocking"
    assert in_order[-1] == "overturned"
    assert ("rocking" in in_order) == (frequency >= 3.0)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "frequency"), RUNGS)
def test_no_boundary_lies_within_one_percent_of_a_step(name, frequency):
    assert {len(around) for around in outcomes(name, frequency, looks=21, samples_per_cycle=1000)} == {1}
