"""The base's motion from its channels, and readings as changes from rest."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from colonnade.identification.fusion.inertial import Accelerometer
from colonnade.stages.parts.conditioned import axes, base_motion, group
from colonnade.stages.parts.transducers import Transducers

TIME = np.arange(0.0, 4.0, 0.005)
OMEGA = 2 * np.pi * 1.5
WAVE = np.sin(OMEGA * TIME)


def _conditioned(**channels):
    named = {name: ("elapsed", values, {"cutoff_hz": 40.0, "channel": name}) for name, values in channels.items()}
    return xr.Dataset(named, coords={"elapsed": ("elapsed", TIME)})


def _table(accelerations=(), displacements=()):
    x = (1.0, 0.0, 0.0)
    return Transducers(
        positions={},
        gyroscopes={},
        accelerometers={},
        accelerations=dict.fromkeys(accelerations, x),
        displacements=dict.fromkeys(displacements, x),
    )


@pytest.mark.parametrize(
    ("factor", "severity", "said"),
    [(1.02, "note", "they agree to 1.0\u00a0%"), (2.0, "warning", "but they differ")],
    ids=["alike", "different"],
)
def test_several_accelerometers_are_averaged_and_compared(factor, severity, said):
    warnings = []
    base = base_motion(_conditioned(a=WAVE, b=factor * WAVE), _table(("a", "b")), warnings)
    np.testing.assert_allclose(base["base_acceleration"], (1 + factor) / 2 * WAVE)
    assert (warnings[0].severity, said in warnings[0].text) == (severity, True)


@pytest.mark.parametrize(("accelerometers", "severity"), [((), "note"), (("dead",), "warning")], ids=["meant", "not"])
def test_without_a_usable_accelerometer_the_displacement_is_differentiated(accelerometers, severity):
    warnings = []
    base = base_motion(_conditioned(stroke=WAVE), _table(accelerometers, ("stroke",)), warnings)
    middle = slice(100, -100)
    np.testing.assert_allclose(base["base_acceleration"][middle], -(OMEGA**2) * WAVE[middle], atol=0.02 * OMEGA**2)
    assert [(warning.kind, warning.severity) for warning in warnings] == [("derived base motion", severity)]


def test_an_axis_that_was_not_recorded_does_not_move():
    moved = axes({"vertical_base_acceleration": WAVE}, "acceleration", TIME)
    np.testing.assert_array_equal(moved, [0 * TIME, 0 * TIME, WAVE])


def test_gravity_is_subtracted_unless_the_zero_was():
    upright = {"block": Accelerometer((0.0, 0.0, 1.0), (0.0, 0.0, 0.4))}
    whole = _conditioned(block=WAVE + 9.81)
    _, readings = group(whole, upright, 9.81)
    np.testing.assert_allclose(readings.values[0], WAVE, atol=1e-12)
    whole["block"].attrs |= {"zero": 0.1, "rest_value": 9.81}
    np.testing.assert_allclose(group(whole, upright, 9.81)[1].values[0], WAVE, atol=1e-12)
