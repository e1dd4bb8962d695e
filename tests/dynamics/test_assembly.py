"""The one block as which bodies rock that keep together."""

import numpy as np
import pytest

from colonnade.dynamics.assembly import Assembly, Placed, as_one, is_frame, standing_on
from colonnade.dynamics.block import Block

DRUM = Block.prism(width=0.3, depth=0.3, height=0.2, mass=36.0)
BEAM = Block.prism(width=1.2, depth=0.3, height=0.2, mass=180.0)


def test_equal_drums_are_one_prism():
    column = Assembly.stack(a=DRUM, b=DRUM, c=DRUM)
    whole = Block.prism(width=0.3, depth=0.3, height=0.6, mass=108.0)
    one = as_one(column)
    for name in ("critical_angle", "p", "inertia", "mass", "restitution"):
        assert getattr(one, name) == pytest.approx(getattr(whole, name), rel=1e-12)
    assert as_one(column, "b").p == pytest.approx(Block.prism(width=0.3, depth=0.3, height=0.4, mass=72.0).p)


def test_a_drum_off_the_axis_gives_each_side_its_own_angle():
    column = Assembly({"low": Placed(DRUM), "high": Placed(DRUM, "low", (0.05, 0.0))})
    one, x, z = as_one(column), 0.025, 0.2
    assert one.positive.critical_angle == pytest.approx(np.arctan2(0.15 - x, z))
    assert one.negative.critical_angle == pytest.approx(np.arctan2(0.15 + x, z))
    own = 36.0 * (0.3**2 + 0.2**2) / 12
    about = 2 * own + 36.0 * ((0.15**2 + 0.1**2) + (0.1**2 + 0.3**2))
    assert one.positive.inertia == pytest.approx(about)


def test_a_frame_is_the_block_of_a_frame_and_its_beam_stands_on_no_column_alone():
    frame = Assembly.frame(DRUM, BEAM, span=0.9)
    assert is_frame(frame)
    assert as_one(frame) == Block.frame(DRUM, beam_mass=180.0)
    assert standing_on(frame, "left") == ("left",)
    assert not is_frame(Assembly.stack(low=DRUM, high=DRUM))
    assert not is_frame(Assembly.colonnade(DRUM, BEAM, columns=3, spacing=0.9))
