from __future__ import annotations

import numpy as np
import pytest

from colonnade.figures import EstimateGroup, EstimateRow, estimators_side_by_side

NOTHING = EstimateRow("half-periods", np.nan, np.nan, np.nan, remark="too few impacts")


def test_estimates_stand_side_by_side_with_their_intervals():
    rows = [EstimateRow("peaks", 0.95, 0.949, 0.951), EstimateRow("whole history", 0.9505, 0.9503, 0.9507, True)]
    axes = estimators_side_by_side([EstimateGroup("free-01", [*rows, NOTHING])], rigid=0.9496).axes[0]
    ends = [path.vertices[:, 0].tolist() for bar in axes.collections for path in bar.get_paths()]
    assert ends == [pytest.approx([0.949, 0.951]), pytest.approx([0.9503, 0.9507])]
    told = {text.get_text(): text.get_fontweight() for text in axes.texts}
    colours = {text.get_text(): text.get_color() for text in axes.texts}
    assert colours["whole history"] != colours["peaks"]
    assert told["0.9505 ± 0.0002"] == "bold"
    assert "too few impacts" in told
    assert " rigid body 0.9496 " in told


@pytest.mark.parametrize(("rigid", "told"), [(0.5, "← rigid body 0.5000"), (0.9999, "rigid body 0.9999 →")])
def test_a_rigid_body_value_far_away_does_not_squeeze_the_estimates(rigid, told):
    axes = estimators_side_by_side([EstimateGroup("", [EstimateRow("peaks", 0.95, 0.949, 0.951)])], rigid=rigid).axes[0]
    assert np.ptp(axes.get_xlim()) < 0.01
    assert told in [text.get_text() for text in axes.texts]


def test_one_estimate_far_off_is_an_arrow_at_the_edge():
    rows = [EstimateRow(str(n), 0.95, 0.949, 0.951) for n in range(4)] + [EstimateRow("off", 0.7, 0.699, 0.701)]
    axes = estimators_side_by_side([EstimateGroup("", rows)]).axes[0]
    mark = next(line for line in axes.lines if line.get_marker() == "<")
    assert mark.get_transform() == axes.get_yaxis_transform()
    assert mark.get_xdata()[0] == 0.0
    assert axes.get_xlim()[0] > 0.9


def test_a_refusal_by_all_estimators_has_no_scale():
    axes = estimators_side_by_side([EstimateGroup("", [NOTHING])], rigid=0.95).axes[0]
    assert axes.get_xticks().size == 0
    assert [text.get_text() for text in axes.texts] == ["half-periods", "too few impacts"]


def test_no_estimate_is_refused():
    with pytest.raises(ValueError, match="no estimate"):
        estimators_side_by_side([])
