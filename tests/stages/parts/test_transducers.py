"""A set-up's channels, sorted by what they measure; and the outline of each shape."""

from __future__ import annotations

import pytest

from colonnade.campaign import Channel
from colonnade.campaign.specimen import Cone, Cylinder, Measured, Prism
from colonnade.dynamics.kinematics import pole_position
from colonnade.stages.parts.transducers import outline, transducers

AT = ["43 mm", "0 mm", "400 mm"]


def _channel(quantity, unit, on, **more):
    return Channel(**{"column": "a", "quantity": quantity, "unit": unit, "on": on, "direction": [1, 0, 0]} | more)


CHANNELS = {
    "top": _channel("displacement", "mm", "specimen", at=AT, relative_to="ground"),
    "tilt.meter": _channel("angle", "deg", "specimen", direction=[0, 1, 0]),
    "gyro": _channel("angular_velocity", "deg/s", "specimen", direction=[0, 1, 0]),
    "block": _channel("acceleration", "g", "specimen", at=AT),
    "nowhere": _channel("acceleration", "g", "specimen"),
    "table": _channel("acceleration", "g", "table"),
    "stroke": _channel("displacement", "mm", "table"),
    "temperature": _channel("other", "V", None, direction=None),
}


def test_each_channel_is_what_it_measures_by_the_name_of_its_variable():
    found = transducers(CHANNELS)
    assert set(found.positions) == {"top", "tilt_meter"}
    assert (found.positions["top"].sensing, found.positions["top"].on_ground) == ("point", True)
    assert found.positions["tilt_meter"].sensing == "angle"
    assert set(found.gyroscopes) == {"gyro"}
    assert set(found.accelerations) == {"table"}
    assert set(found.displacements) == {"stroke"}


def test_an_accelerometer_on_the_specimen_counts_only_with_its_place():
    found = transducers(CHANNELS)
    assert set(found.accelerometers) == {"block"}
    assert set(found.on_specimen) == {"top", "tilt_meter", "gyro", "block"}


@pytest.mark.parametrize(
    ("specimen", "half_width", "half_depth", "taper"),
    [
        (Prism(shape="prism", width="86 mm", depth="60 mm", height="456 mm", mass="26 kg"), 0.043, 0.03, 0.0),
        (Cylinder(shape="cylinder", diameter="97 mm", height="455 mm", mass="26 kg"), 0.0485, 0.0485, 0.0),
        (
            Cone(shape="cone", base_diameter="97 mm", top_diameter="75 mm", height="0.5 m", mass="22 kg"),
            *(0.0485, 0.0485, -0.022),
        ),
    ],
    ids=["prism", "cylinder", "cone"],
)
def test_the_outline_is_half_the_dimensions(specimen, half_width, half_depth, taper):
    found = outline(specimen, specimen.block(9.81))
    assert found.half_width == pytest.approx(half_width)
    assert found.half_depth == pytest.approx(half_depth)
    assert found.taper == pytest.approx(taper)


def test_a_measured_specimen_is_as_wide_as_its_poles_are_apart():
    statue = Measured(
        shape="measured", mass="80 kg", pole_distance="610 mm", critical_angle="0.21 rad", inertia="41.2 kg m^2"
    )
    block = statue.block(9.81)
    assert outline(statue, block).half_width == pole_position(block)
