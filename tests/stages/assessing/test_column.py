"""The real column of a specimen: by its scale, by what is given, with the e that is assumed."""

from __future__ import annotations

from math import sqrt

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from colonnade.campaign.assessing.prototype import Prototype
from colonnade.dynamics.block import Block
from colonnade.stages.assessing.column import ColumnInputs, real_column

MODEL = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.1)


def pooled(e=(0.976, 0.976), tests=(0.975, 0.977), source="identified"):
    return xr.Dataset(
        {
            "side_restitution": ("side", np.array(e)),
            "level": ((), 0.95),
            "test_restitution": ("test", np.array(tests)),
            "test_restitution_standard_error": ("test", np.full(len(tests), 1e-6)),
        },
        attrs={"restitution_source": source},
    )


GIVEN = pooled(tests=(), source="given")
OF_TWO = stats.t.ppf(0.975, 1) * np.sqrt(1.5) * np.std([0.975, 0.977], ddof=1)
OF_ONE = stats.norm.ppf(0.975) * 0.005  # the usual scatter between tests


def column(scale=20.0, stored=None, **written):
    inputs = ColumnInputs(block=MODEL, scale=scale, prototype=Prototype.model_validate(written))
    return real_column(inputs, pooled() if stored is None else stored)


@given(st.floats(0.1, 1000.0))
def test_a_larger_column_is_the_one_of_its_own_dimensions(scale):
    found, _ = column(scale, restitution=0.9)
    same = Block.prism(width=0.086 * scale, depth=0.086 * scale, height=0.456 * scale, mass=26.1 * scale**3)
    assert found.block.critical_angle == pytest.approx(same.critical_angle)
    assert found.block.p == pytest.approx(same.p)
    assert found.block.p == pytest.approx(MODEL.p / sqrt(scale))
    assert found.block.inertia == pytest.approx(same.inertia)


def test_what_is_given_replaces_what_follows_from_the_model():
    found, _ = column(
        restitution=0.9, critical_angle="0.17 rad", p="1.3 rad/s", friction=0.6, friction_range=[0.5, 0.7]
    )
    assert (found.block.critical_angle, found.block.p) == pytest.approx((0.17, 1.3))
    assert (found.friction, found.friction_range) == (0.6, (0.5, 0.7))


@pytest.mark.parametrize(
    ("written", "stored", "value", "limits", "source"),
    [
        ({"restitution": "identified"}, pooled(), 0.976, (0.976 - OF_TWO, 0.976 + OF_TWO), "identified"),
        ({"restitution": "identified"}, pooled(tests=[0.976]), 0.976, (0.976 - OF_ONE, 0.976 + OF_ONE), "identified"),
        ({"restitution": "identified"}, GIVEN, 0.976, (0.956, 0.996), "given"),
        ({"restitution": "identified", "restitution_range": [0.9, 0.99]}, pooled(), 0.976, (0.9, 0.99), "identified"),
        ({"restitution": 0.95}, pooled(), 0.95, (0.93, 0.97), "given"),
        ({"restitution": 0.99}, pooled(), 0.99, (0.97, 1.0), "given"),
        ({"restitution": "rigid-body"}, pooled(), MODEL.restitution, None, "rigid-body"),
    ],
)
def test_e_is_the_one_that_is_stated(written, stored, value, limits, source):
    found, came_from = column(stored=stored, **written)
    limits = limits or (value - 0.02, value + 0.02)
    assert (found.restitution, came_from) == (pytest.approx(value), source)
    assert found.restitution_range == pytest.approx(limits)


def test_two_sides_keep_their_own_e():
    found, _ = column(stored=pooled((0.96, 0.98)), restitution="identified")
    assert found.restitution == (0.96, 0.98)
