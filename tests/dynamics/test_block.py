import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from colonnade.dynamics.block import Block, pair
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.reactions import reactions
from colonnade.dynamics.rock import rock

LENGTHS = st.floats(1e-2, 10.0)


def test_prism_has_the_closed_form_of_a_rectangle():
    block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    radius = math.hypot(0.043, 0.228)
    assert block.critical_angle == pytest.approx(math.atan(86 / 456), rel=1e-14)
    assert block.inertia == pytest.approx(4 / 3 * 26.10 * radius**2, rel=1e-14)
    assert block.p == pytest.approx(math.sqrt(3 * 9.81 / (4 * radius)), rel=1e-14)
    assert block.restitution == pytest.approx(1 - 1.5 * math.sin(block.critical_angle) ** 2, rel=1e-14)
    assert block.uplift_acceleration == pytest.approx(9.81 * 86 / 456, rel=1e-14)


def test_a_block_too_wide_to_rock_on_stands_after_one_impact():
    wide = Block.prism(width=1.0, depth=0.5, height=0.5, mass=100.0)
    assert wide.restitution == 0.0
    history = rock(wide, theta0=0.1, duration=3.0, model="nonlinear")
    assert history.impact_times.size == 1
    assert history.angle[-1] == 0.0


@given(width=LENGTHS, height=LENGTHS)
def test_cylinder_is_a_cone_of_equal_diameters_with_its_textbook_inertia(width, height):
    block = Block.cylinder(diameter=width, height=height, mass=3.0)
    transverse = 3.0 * (3 * (width / 2) ** 2 + height**2) / 12
    assert block.inertia == pytest.approx(transverse + 3.0 * block.pole_distance**2, rel=1e-12)


def test_cone_agrees_with_a_sum_over_thin_discs():
    block = Block.cone(base_diameter=0.097, top_diameter=0.0755, height=0.480, mass=21.94)
    edges = np.linspace(0, 0.480, 200_001)
    z = (edges[1:] + edges[:-1]) / 2
    radius = 0.0485 + (0.03775 - 0.0485) * z / 0.480
    share = radius**2 / (radius**2).sum() * 21.94
    centre = (share * z).sum() / 21.94
    inertia = (share * (radius**2 / 4 + z**2)).sum() + 21.94 * 0.0485**2
    assert block.pole_distance == pytest.approx(math.hypot(0.0485, centre), rel=1e-9)
    assert block.inertia == pytest.approx(inertia, rel=1e-9)


def test_measured_block_takes_a_value_for_each_side_and_is_governed_by_the_smaller_angle():
    block = Block.measured(mass=80.0, pole_distance=0.61, critical_angle=(0.21, 0.19), inertia=41.2)
    assert block.critical_angle == 0.19
    assert block.negative.critical_angle == 0.21
    assert not block.is_symmetric


def test_the_values_at_an_angle_are_those_of_the_side_it_is_on():
    block = Block.measured(mass=80.0, pole_distance=(0.61, 0.62), critical_angle=(0.21, 0.19), inertia=(41.2, 42.0))
    angle = np.array([[-0.1, 0.1], [0.0, np.nan]])
    assert block.critical_angle_at(angle).tolist() == [[0.21, 0.19], [0.19, 0.19]]
    assert block.p_at(-0.1) == block.side_p(block.negative)


def test_a_measured_value_overrides_the_one_from_dimensions_alone():
    block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    assert block.override(critical_angle=0.18).critical_angle == 0.18
    assert block.override(critical_angle=0.18).inertia == block.inertia
    assert block.override(inertia=(1.8, 1.9)).positive.inertia == 1.9


@pytest.mark.parametrize("wrong", [{"width": 0.0}, {"height": -1.0}, {"mass": 0.0}, {"gravity": math.nan}])
def test_a_value_that_is_not_positive_is_refused_by_its_name(wrong):
    arguments = {"width": 0.1, "depth": 0.1, "height": 0.5, "mass": 1.0} | wrong
    with pytest.raises(ValueError, match=next(iter(wrong))):
        Block.prism(**arguments)


def test_an_angle_of_half_a_turn_and_more_is_refused():
    with pytest.raises(ValueError, match="critical_angle"):
        Block.measured(mass=1.0, pole_distance=1.0, critical_angle=math.pi / 2, inertia=1.0)


def test_pair_spreads_one_value_and_passes_two():
    assert pair(0.2) == (0.2, 0.2)
    assert pair((0.2, 0.3)) == (0.2, 0.3)


def test_a_pole_distance_in_millimetres_is_refused():
    with pytest.raises(ValueError, match=r"pole_distance of 610 m .* at least m R² = 2.977e\+07 kg m²"):
        Block.measured(mass=80, pole_distance=610, critical_angle=0.21, inertia=41.2)


COLUMNS = {
    "prism": Block.prism(width=0.9, depth=0.7, height=6.0, mass=12000.0),
    "cylinder": Block.cylinder(diameter=1.2, height=6.0, mass=15000.0),
}


class Parts:
    """Columns and beam of a frame that leans on side s, as bodies of their own: the principle of virtual work."""

    def __init__(self, column, beam_mass, columns, sign):
        half, height = column.negative.half_width, column.pole_distance * math.cos(column.critical_angle)
        about_centre = column.inertia - column.mass * column.pole_distance**2
        # From the pole: the centre of each column and, on the other edge of its top, its share of the beam.
        self.arms = np.array([[-sign * half, height], [-2 * sign * half, 2 * height]])
        self.masses = np.array([columns * column.mass, beam_mass])
        self.inertia, self.gravity = columns * about_centre, column.gravity

    def turned(self, angle):
        """d/dθ and d²/dθ² of the places."""
        c, s = math.cos(angle), math.sin(angle)
        along, above = self.arms.T
        return np.array([-along * s + above * c, -above * s - along * c]), -np.array(
            [along * c + above * s, above * c - along * s]
        )

    def bend(self, angle, rate, pull):
        first, second = self.turned(angle)
        load = -(self.masses * (pull * first[0] + self.gravity * first[1] + rate**2 * (first * second).sum(0))).sum()
        return load / ((self.masses * (first**2).sum(0)).sum() + self.inertia)


@pytest.mark.parametrize("name", COLUMNS)
@pytest.mark.parametrize(("beam_mass", "columns"), [(0.0, 1), (24000.0, 2), (300000.0, 3)])
def test_a_frame_moves_as_its_columns_and_its_beam_by_virtual_work(name, beam_mass, columns):
    column = COLUMNS[name]
    frame = Block.frame(column, beam_mass=beam_mass, columns=columns)
    time = np.linspace(0.0, 2.5, 50_001)
    pulled = lambda t: 1.8 * frame.uplift_acceleration * np.cos(2.0 * t)  # noqa: E731
    motion = Motion(pulled(time), time[1])
    history = rock(frame, motion, model="nonlinear")
    until = int(np.searchsorted(time, history.impact_times[0])) if history.impacts else time.size
    until = min(until, int(np.argmax(np.abs(history.angle) > 1.0)) or until)
    parts = Parts(column, beam_mass, columns, -1.0)
    found = solve_ivp(
        lambda t, y: [y[1], parts.bend(y[0], y[1], pulled(t))],
        (0.0, time[until - 1]), [0.0, 0.0], "DOP853", rtol=1e-12, atol=1e-15, t_eval=time[:until],
    )  # fmt: skip
    assert np.abs(found.y[0]).max() > 0.2 * frame.critical_angle
    np.testing.assert_allclose(history.angle[:until], found.y[0], atol=7e-7 * frame.critical_angle)

    # The forces of the base are what moves all masses.
    forces = reactions(history, motion)
    for place in (100, until // 2, until - 2):
        angle, rate = history.angle[place], history.angular_velocity[place]
        first, second = parts.turned(angle)
        moved = first * parts.bend(angle, rate, motion.acceleration[place]) + second * rate**2
        carried = np.array([[motion.acceleration[place]], [frame.gravity]])
        expected = (parts.masses * (moved + carried)).sum(1)
        np.testing.assert_allclose((forces.horizontal[place], forces.vertical[place]), expected, rtol=1e-6)


@pytest.mark.parametrize("name", COLUMNS)
@pytest.mark.parametrize("ratio", [0.0, 0.3, 1.0, 10.0])
def test_an_impact_of_a_frame_is_that_of_impulses_on_its_parts(name, ratio):
    """Makris and Vassiliou (2013): of prisms, e = (1 − 3/2 sin² α + 3γ cos 2α)/(1 + 3γ)."""
    column = COLUMNS[name]
    frame = Block.frame(column, beam_mass=2 * ratio * column.mass)
    half, height = column.negative.half_width, column.pole_distance * math.cos(column.critical_angle)
    about_centre = column.inertia / column.mass - column.pole_distance**2
    # Unknown, over the mass of a column: ω after, impulses on it at its new pole (−b, −h) and its new top edge (b, h).
    along, above = height, -half
    equations = np.array([
        [along, -1.0, 0.0, -1.0, 0.0],
        [above, 0.0, -1.0, 0.0, -1.0],
        [about_centre, height, -half, -height, half],
        [2 * ratio * along, 0.0, 0.0, 1.0, 0.0],
        [2 * ratio * above, 0.0, 0.0, 0.0, 1.0],
    ])  # fmt: skip
    before = [height, half, about_centre, 2 * ratio * height, 2 * ratio * half]
    assert frame.restitution == pytest.approx(np.linalg.solve(equations, before)[0], rel=1e-12)
    if name == "prism":
        alpha = column.critical_angle
        theirs = (1 - 1.5 * math.sin(alpha) ** 2 + 3 * ratio * math.cos(2 * alpha)) / (1 + 3 * ratio)
        assert frame.restitution == pytest.approx(theirs, rel=1e-12)
        assert frame.p == pytest.approx(column.p * math.sqrt((1 + 2 * ratio) / (1 + 3 * ratio)), rel=1e-12)


@pytest.mark.parametrize(
    "column",
    [
        Block.cone(base_diameter=1.2, top_diameter=1.19, height=6.0, mass=15000.0),
        COLUMNS["prism"].override(inertia=1.001 * COLUMNS["prism"].inertia),
        COLUMNS["prism"].override(critical_angle=(0.14, 0.15)),
        COLUMNS["cylinder"].override(pole_distance=3.05),
        Block.measured(mass=80.0, pole_distance=0.61, critical_angle=0.2, inertia=41.2),
        Block.frame(COLUMNS["prism"], beam_mass=1000.0),
    ],
    ids=["a cone", "of measured inertia", "of unequal sides", "of measured size", "measured", "a frame"],
)
def test_no_frame_is_made_of_what_carries_a_beam_elsewhere(column):
    with pytest.raises(ValueError, match="column is not an upright prism or cylinder of uniform density"):
        Block.frame(column, beam_mass=100.0)


@pytest.mark.parametrize("wrong", [{"beam_mass": -1.0}, {"columns": 0}, {"columns": 1.5}])
def test_an_impossible_frame_is_refused_by_the_name_of_its_number(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        Block.frame(COLUMNS["prism"], **({"beam_mass": 100.0} | wrong))
