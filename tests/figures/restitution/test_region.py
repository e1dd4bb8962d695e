from __future__ import annotations

import numpy as np
import pytest
from scipy import stats

from colonnade.figures import Region, joint_region


def test_the_joint_region_holds_its_share_of_a_normal_distribution():
    centre = np.array([0.95, 1.01])
    covariance = np.array([[4e-6, 3e-6], [3e-6, 9e-6]])
    axes = joint_region([Region("free-01", centre, covariance)], fixed=(0.949, 0.948, 0.95)).axes[0]
    for line, level in zip(axes.lines[:2], (0.5, 0.95), strict=True):
        away = np.column_stack(line.get_data()) - centre
        distance = np.einsum("ij,jk,ik->i", away, np.linalg.inv(covariance), away)
        assert distance == pytest.approx(np.full(away.shape[0], stats.chi2.ppf(level, 2)))
    assert "e with α as given" in axes.get_legend_handles_labels()[1]


@pytest.mark.parametrize(
    ("regions", "said"),
    [([], "no fit"), ([Region("one", np.ones(2), np.zeros((2, 2)))], "one: .* not positive definite")],
    ids=["none", "a covariance of nothing"],
)
def test_a_region_that_cannot_be_drawn_is_refused(regions, said):
    with pytest.raises(ValueError, match=said):
        joint_region(regions)
