"""Table 1 of the paper (solid steel models, 1:20), and measured values beside dimensions."""

import math

import pytest

from colonnade.campaign.specimen import Cone, Cylinder, Measured, Prism

PRISM = {"shape": "prism", "width": "86 mm", "depth": "86 mm", "height": "456 mm", "mass": "26.10 kg"}
CYLINDER = {"shape": "cylinder", "diameter": "97 mm", "height": "455 mm", "mass": "26.30 kg"}
CONE = {"shape": "cone", "base_diameter": "97 mm", "top_diameter": "75.5 mm", "height": "480 mm", "mass": "21.94 kg"}
STATUE = {"shape": "measured", "mass": "80 kg", "pole_distance": "610 mm", "critical_angle": "0.21 rad"}
STATUE |= {"inertia": "41.2 kg m^2"}

# As printed: distance of the centre of mass from the pole (m), critical angle (rad), inertia (kg m²), p (rad/s).
TABLE_1 = {
    "prism": (0.232, 0.1886, 1.873, 5.631),
    "cylinder": (0.227, 0.2132, 1.883, 5.631),
    "cone": (0.220, 0.2203, 1.527, 5.631),
}
GRAVITY = 9.81


def test_table_1_prism_agrees_but_for_its_angle():
    distance, _, inertia, p = TABLE_1["prism"]
    block = Prism.model_validate(PRISM).block(GRAVITY)
    assert block.pole_distance == pytest.approx(distance, abs=5e-4)
    assert block.inertia == pytest.approx(inertia, abs=5e-4)
    assert block.p == pytest.approx(p, abs=5e-4)
    assert block.inertia == pytest.approx(4 / 3 * 26.10 * block.pole_distance**2, rel=1e-12)


@pytest.mark.parametrize(
    ("model", "written", "name"), [(Prism, PRISM, "prism"), (Cylinder, CYLINDER, "cylinder"), (Cone, CONE, "cone")]
)
def test_table_1_prints_tangents_in_place_of_critical_angles(model, written, name):
    block = model.model_validate(written).block(GRAVITY)
    printed = TABLE_1[name][1]
    assert math.tan(block.critical_angle) == pytest.approx(printed, abs=1e-4)
    assert abs(block.critical_angle / printed - 1) > 0.01


@pytest.mark.parametrize(
    ("model", "written", "name", "distance", "inertia", "p"),
    [(Cylinder, CYLINDER, "cylinder", 0.2326, 1.892, 5.632), (Cone, CONE, "cone", 0.2254, 1.540, 5.613)],
)
def test_table_1_prints_heights_in_place_of_pole_distances(model, written, name, distance, inertia, p):
    block = model.model_validate(written).block(GRAVITY)
    assert block.pole_distance * math.cos(block.critical_angle) == pytest.approx(TABLE_1[name][0], abs=6e-4)
    assert block.pole_distance == pytest.approx(distance, abs=5e-5)
    assert block.inertia == pytest.approx(inertia, abs=5e-4)
    assert block.p == pytest.approx(p, abs=5e-4)


def test_table_1_as_written_in_the_paper_is_warned_of():
    def printed(name):
        distance, angle, inertia, _ = TABLE_1[name]
        return {"critical_angle": f"{angle} rad", "pole_distance": f"{distance} m", "inertia": f"{inertia} kg m^2"}

    prism = Prism.model_validate(PRISM | printed("prism"))
    cylinder = Cylinder.model_validate(CYLINDER | printed("cylinder"))
    cone = Cone.model_validate(CONE | printed("cone"))
    assert [told.split()[0] for told in prism.deviations(GRAVITY)] == ["critical_angle"]
    for specimen in (cylinder, cone):
        assert [told.split()[0] for told in specimen.deviations(GRAVITY)] == ["critical_angle", "pole_distance"]


def test_a_measured_value_overrides_the_one_of_the_dimensions():
    block = Prism.model_validate(PRISM | {"inertia": "2 kg m^2"}).block(GRAVITY)
    assert block.inertia == 2.0
    assert block.critical_angle == pytest.approx(math.atan2(86, 456))


@pytest.mark.parametrize(("inertia", "warned"), [("1.89 kg m^2", False), ("1.85 kg m^2", True), ("1.90 kg m^2", True)])
def test_a_measured_value_is_warned_of_beyond_one_per_cent(inertia, warned):
    deviations = Prism.model_validate(PRISM | {"inertia": inertia}).deviations(GRAVITY)
    assert bool(deviations) is warned
    assert all("kg m² that the dimensions give; the given value is used" in told for told in deviations)


def test_a_measured_specimen_has_no_dimensions_to_deviate_from():
    statue = Measured.model_validate(STATUE)
    assert statue.deviations(GRAVITY) == []
    assert statue.block(GRAVITY).p == pytest.approx(math.sqrt(80 * GRAVITY * 0.61 / 41.2))


def test_a_specimen_that_is_not_symmetric_has_two_sides():
    statue = Measured.model_validate(STATUE | {"critical_angle": ["0.21 rad", "0.19 rad"], "restitution": [0.9, 0.92]})
    block = statue.block(GRAVITY)
    assert (block.negative.critical_angle, block.positive.critical_angle) == (0.21, 0.19)
    assert statue.restitution == (0.9, 0.92)
    assert block.critical_angle == 0.19
