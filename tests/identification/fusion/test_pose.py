from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, point_displacement
from colonnade.identification.fusion import pose
from colonnade.identification.fusion.pose import rocking_angle
from colonnade.identification.fusion.sensors import Transducer
from prism import PRISM as SOLID

HALF_WIDTH = 0.0485
BLOCK = Block.cylinder(diameter=2 * HALF_WIDTH, height=0.455, mass=26.3)
TAPER = -0.0224
ROUND, CONE = Outline(HALF_WIDTH, HALF_WIDTH, is_round=True), Outline(HALF_WIDTH, HALF_WIDTH, True, TAPER)
PRISM = Outline(HALF_WIDTH, 0.04)
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
TOP, BACK, ANCHOR = (HALF_WIDTH, 0.0, 0.4), (-HALF_WIDTH, 0.0, 0.4), (-0.35, 0.05, 0.45)
OFF_AXIS = (0.8 * HALF_WIDTH, 0.6 * HALF_WIDTH, 0.38)
CONE_RADIUS = HALF_WIDTH + TAPER * 0.38
ON_CONE = (0.8 * CONE_RADIUS, 0.6 * CONE_RADIUS, 0.38)
TILTED = (np.cos(0.1), 0.0, np.sin(0.1))
NOISE = 5e-5

KINDS = {
    "point": ([Transducer("point", X, TOP)], PRISM),
    "laser on a face": ([Transducer("surface", X, TOP, normal=X)], PRISM),
    "laser from behind, inclined": ([Transducer("surface", TILTED, BACK, normal=(-1.0, 0.0, 0.0))], PRISM),
    "laser on a cylinder, off its axis": ([Transducer("surface", X, OFF_AXIS)], ROUND),
    "laser on a cone, off its axis": ([Transducer("surface", X, ON_CONE)], CONE),
    "wire from behind": ([Transducer("wire", X, TOP, anchor=ANCHOR)], PRISM),
    "wire from ahead": ([Transducer("wire", X, TOP, anchor=(0.4, -0.1, 0.3))], PRISM),
    "inclinometer": ([Transducer("angle", Y)], PRISM),
    "vertical pair on the edges": ([Transducer("point", Z, (x, 0.0, 0.0)) for x in (-HALF_WIDTH, HALF_WIDTH)], PRISM),
    "laser above and wire below": (
        [
            Transducer("surface", X, TOP, normal=X),
            Transducer("wire", X, (HALF_WIDTH, 0.0, 0.03), anchor=(-0.4, 0.0, 0.1)),
        ],
        PRISM,
    ),
}
NO_POINT = {
    "laser": "laser on a face",
    "string pot": "wire from behind",
    "laser on a cone": "laser on a cone, off its axis",
}


def fit_pose(readings, transducers, block, *, noise=(NOISE,), outline=PRISM, base=None):
    base = np.zeros((3, readings.shape[1])) if base is None else base
    noise = np.broadcast_to(noise, len(transducers))
    return pose.fit_pose(readings, transducers, block, outline, noise=noise, base=base)


def _read(block, each, outline=PRISM):
    """What a transducer reads of a moved block."""
    if each.sensing == "angle":
        return np.arctan2(block.matrix[0, 2], block.matrix[2, 2])
    if each.sensing == "wire":
        return block.wire(each.at, each.direction, each.anchor)
    if each.sensing == "point":
        return block.point(each.at, each.direction)
    if each.normal is None:
        return block.laser_on_side(each.at, each.direction, HALF_WIDTH, outline.taper)
    return block.laser_on_face(each.at, each.direction, np.abs(each.normal))


def _measured(kind, block):
    """Readings of a pose that is held, with noise."""
    transducers, outline = KINDS[kind]
    readings = np.array([_read(block, each, outline) for each in transducers])
    rng = np.random.default_rng(7)
    return readings[:, None] + NOISE * rng.standard_normal((readings.size, 400))


def _in_standard_errors(fit, angle):
    return (fit.angle - angle) / fit.standard_error["rocking_angle"]


@pytest.mark.parametrize("angle", [0.02, 0.3, -0.02, -0.3, 0.6])
@pytest.mark.parametrize("kind", KINDS)
def test_the_angle_of_every_kind_of_transducer_is_within_its_standard_error(kind, angle, moved_block):
    transducers, outline = KINDS[kind]
    fit = fit_pose(_measured(kind, moved_block(angle)), transducers, BLOCK, outline=outline)
    errors = _in_standard_errors(fit, angle)
    assert np.mean(np.abs(errors) < 3) > 0.985
    assert np.std(errors) == pytest.approx(1.0, abs=0.15)
    assert abs(errors.mean()) < 4 / np.sqrt(errors.size)


@pytest.mark.parametrize("kind", NO_POINT.values(), ids=NO_POINT)
def test_a_laser_or_wire_taken_for_a_point_is_off_by_more_than_its_standard_error(kind, moved_block):
    transducers, outline = KINDS[kind]
    taken = [replace(each, sensing="point", normal=None, anchor=None) for each in transducers]
    fit = fit_pose(_measured(kind, moved_block(0.3)), taken, BLOCK, outline=outline)
    assert np.mean(np.abs(_in_standard_errors(fit, 0.3)) > 3) > 0.99


SPATIAL = [
    Transducer("point", X, (HALF_WIDTH, 0.0, 0.4)),
    Transducer("surface", X, (HALF_WIDTH, 0.03, 0.1), normal=X),
    Transducer("surface", X, (HALF_WIDTH, -0.03, 0.1), normal=X),
    Transducer("surface", Z, (-HALF_WIDTH, 0.0, 0.0), normal=Z),
    Transducer("point", Z, (HALF_WIDTH, 0.0, 0.0)),
    Transducer("wire", Y, (0.0, 0.04, 0.4), anchor=(0.0, 0.6, 0.4)),
    Transducer("point", Y, (0.0, 0.04, 0.02)),
]


def _read_in_space(block):
    return np.array([_read(block, each) for each in SPATIAL])


@pytest.mark.parametrize("angle", [0.02, 0.3, -0.25])
def test_all_six_unknowns_are_told_apart_at_large_rotations(angle, moved_block):
    moved = {"lean": 0.04, "yaw": -0.06, "slide": 0.004, "rise": 0.003, "across": -0.002}
    readings = _read_in_space(moved_block(angle, **moved))[:, None]
    fit = fit_pose(readings, SPATIAL, BLOCK)
    expected = {
        "rocking_angle": angle,
        "slide": 0.004,
        "out_of_plane_angle": 0.04,
        "transverse_slide": -0.002,
        "yaw": -0.06,
    }
    for name, value in expected.items():
        assert fit.values[name][0] == pytest.approx(value, abs=1e-11), name
    corners = [(x, y, 0.0) for x in (-HALF_WIDTH, HALF_WIDTH) for y in (-0.04, 0.04)]
    lowest = min(moved_block(angle, **moved).place(corner)[2] for corner in corners)
    assert fit.values["uplift"][0] == pytest.approx(lowest, abs=1e-11)
    np.testing.assert_allclose(fit.residual, 0.0, atol=1e-12)


@pytest.mark.parametrize("angle", [0.02, 0.3, -0.3])
def test_all_six_unknowns_are_within_their_standard_errors(angle, moved_block):
    moved = {"lean": 0.02, "yaw": -0.01, "slide": 0.002, "rise": 0.001, "across": 0.001}
    noise = np.array([1, 2, 2, 1, 1, 3, 1]) * NOISE
    scatter = np.random.default_rng(2).standard_normal((noise.size, 400)) * noise[:, None]
    readings = _read_in_space(moved_block(angle, **moved))[:, None] + scatter
    fit = fit_pose(readings, SPATIAL, BLOCK, noise=noise, outline=Outline(HALF_WIDTH, 0.0))
    exact = fit_pose(readings - scatter, SPATIAL, BLOCK, noise=noise, outline=Outline(HALF_WIDTH, 0.0))
    assert len(fit.values) == 6
    for name, values in fit.values.items():
        errors = (values - exact.values[name]) / fit.standard_error[name]
        assert np.mean(np.abs(errors) < 3) > 0.98, name
        assert np.std(errors) == pytest.approx(1.0, abs=0.2), name


def test_the_uplift_of_a_round_base_is_that_of_its_rim(moved_block):
    moved = {"lean": 0.05, "slide": 0.002, "rise": 0.006}
    block = moved_block(0.2, **moved)
    transducers = [
        Transducer("point", X, TOP),
        Transducer("point", X, (HALF_WIDTH, 0.0, 0.02)),
        Transducer("point", Y, (0.0, HALF_WIDTH, 0.4)),
        Transducer("point", Z, (-HALF_WIDTH, 0.0, 0.0)),
        Transducer("point", Z, (HALF_WIDTH, 0.0, 0.0)),
    ]
    readings = np.array([[_read(block, each)] for each in transducers])
    fit = fit_pose(readings, transducers, BLOCK, outline=ROUND)
    around = np.linspace(0, 2 * np.pi, 20001)
    rim = HALF_WIDTH * np.stack((np.cos(around), np.sin(around), 0 * around))
    lowest = (block.pole + block.shift)[2] + (block.matrix @ (rim - block.pole[:, None]))[2].min()
    assert fit.values["uplift"][0] == pytest.approx(lowest, abs=1e-9)


def test_both_ends_of_the_base_that_rise_are_an_uplift_and_no_rotation():
    pair, outline = KINDS["vertical pair on the edges"]
    fit = fit_pose(np.full((2, 5), 0.004), pair, BLOCK, outline=outline)
    np.testing.assert_allclose(fit.angle, 0.0, atol=1e-12)
    np.testing.assert_allclose(fit.values["uplift"], 0.004, atol=1e-12)


def test_a_transducer_on_the_ground_has_the_tables_motion_taken_off_where_it_looks(moved_block):
    rng = np.random.default_rng(1)
    angles, table = rng.uniform(-0.3, 0.3, 20), rng.normal(0, 0.05, 20)
    anchor = (-0.8, 0.0, 0.5)
    readings = []
    for angle, moved in zip(angles, table, strict=True):
        block = moved_block(angle, slide=moved)
        readings.append([block.wire(TOP, X, anchor), block.laser_on_face((HALF_WIDTH, 0.0, 0.1), X, X)])
    ground = [
        Transducer("wire", X, TOP, anchor=anchor, on_ground=True),
        Transducer("surface", X, (HALF_WIDTH, 0.0, 0.1), normal=X, on_ground=True),
    ]
    base = np.array([table, 0 * table, 0 * table])
    fit = fit_pose(np.array(readings).T, ground, BLOCK, base=base)
    np.testing.assert_allclose(fit.angle, angles, atol=1e-10)
    np.testing.assert_allclose(fit.values["slide"], 0.0, atol=1e-10)


def test_samples_without_the_tables_displacement_leave_the_angle_to_what_is_on_the_table(moved_block):
    readings = np.repeat([[moved_block(0.1).point(TOP, X)]], 3, axis=1)
    base = np.array([[0.0, 0.02, np.nan], [0.0] * 3, [0.0] * 3])
    both = np.vstack((readings, readings + base[0]))
    transducers = [Transducer("point", X, TOP), Transducer("point", X, TOP, on_ground=True)]
    fit = fit_pose(both, transducers, BLOCK, base=base)
    np.testing.assert_allclose(fit.angle, 0.1, atol=1e-11)
    assert np.isnan(fit.residual[1, 2])


def test_a_missing_reading_leaves_the_rest_where_they_separate_the_unknowns(moved_block):
    readings = np.repeat(_read_in_space(moved_block(0.1, slide=0.002))[:, None], 4, axis=1)
    readings[0, 1] = np.nan
    readings[[5, 6], 2] = np.nan
    readings[:, 3] = np.nan
    fit = fit_pose(readings, SPATIAL, BLOCK)
    np.testing.assert_allclose(fit.angle, [0.1, 0.1, np.nan, np.nan], atol=1e-11)
    np.testing.assert_allclose(fit.values["slide"], [0.002, 0.002, np.nan, np.nan], atol=1e-11)
    assert np.isnan(fit.residual[0, 1])
    assert fit.standard_error["rocking_angle"][1] > 1.05 * fit.standard_error["rocking_angle"][0]


def test_a_long_record_is_the_same_as_its_parts(monkeypatch):
    rng = np.random.default_rng(0)
    readings = 0.4 * rng.uniform(-0.2, 0.2, (1, 300))
    whole = fit_pose(readings, [Transducer("point", X, TOP)], BLOCK)
    monkeypatch.setattr("colonnade.identification.fusion.pose.CHUNK", 64)
    np.testing.assert_array_equal(fit_pose(readings, [Transducer("point", X, TOP)], BLOCK).angle, whole.angle)


AT_TOP, BOTTOM, ALONG_X, UPWARDS = [0.043, 0.0, 0.440], [0.043, 0.0, 0.020], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]
ANGLES = np.concatenate((np.linspace(-0.6, 0.6, 241), [0.0, 1e-9, -1e-9]))


def _readings(at, direction):
    displacement = point_displacement(ANGLES, at, SOLID)
    return np.einsum("mnk,mk->mn", displacement, np.asarray(direction))


@pytest.mark.parametrize(
    ("at", "direction"),
    [
        ([AT_TOP], [ALONG_X]),
        ([AT_TOP, BOTTOM], [ALONG_X, ALONG_X]),
        ([AT_TOP, [-0.043, 0.0, 0.0]], [ALONG_X, UPWARDS]),
        ([AT_TOP, BOTTOM, [0.0, 0.0, 0.3]], [ALONG_X, ALONG_X, [0.8, 0.0, 0.6]]),
    ],
    ids=["one at the top", "top and bottom", "top and a lifting edge", "three, one inclined"],
)
def test_the_exact_finite_rotation_is_recovered(at, direction):
    angle = rocking_angle(_readings(at, direction), at, direction, SOLID)
    np.testing.assert_allclose(angle, ANGLES, rtol=0, atol=1e-12)


def test_disagreeing_transducers_raise_the_standard_error():
    at, direction = [AT_TOP, BOTTOM, [0.0, 0.0, 0.3]], [ALONG_X] * 3
    transducers = [Transducer("point", tuple(ALONG_X), tuple(point)) for point in at]
    agreeing, readings = _readings(at, direction), _readings(at, direction)
    readings[2] *= 1.1
    error, least = (
        fit_pose(each, transducers, SOLID, noise=1e-5).standard_error["rocking_angle"] for each in (readings, agreeing)
    )
    assert np.median(error / least) > 20


@given(scale=st.floats(0.1, 10))
def test_the_angle_does_not_depend_on_the_size_of_the_specimen(scale):
    block = Block.prism(width=0.086 * scale, depth=0.086 * scale, height=0.456 * scale, mass=1.0)
    at = scale * np.array([AT_TOP, BOTTOM])
    readings = scale * _readings([AT_TOP, BOTTOM], [ALONG_X, ALONG_X])
    np.testing.assert_allclose(rocking_angle(readings, at, [ALONG_X] * 2, block), ANGLES, atol=1e-10)


def test_positions_that_do_not_match_the_records_are_refused():
    with pytest.raises(ValueError, match="2 records, 1 positions"):
        rocking_angle(np.zeros((2, 3)), AT_TOP, ALONG_X, SOLID)


def test_displacements_in_millimetres_are_refused():
    at, direction = [AT_TOP, BOTTOM], [ALONG_X, ALONG_X]
    with pytest.raises(ValueError, match="metres, relative to the table, were expected"):
        rocking_angle(1e3 * _readings(at, direction), at, direction, SOLID)
