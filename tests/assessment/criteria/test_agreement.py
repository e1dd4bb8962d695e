"""The table of predicted and computed."""

import numpy as np
import pytest

from colonnade.assessment.criteria.agreement import agreement


def test_every_motion_is_counted_once():
    found = agreement([0.5, 2, 3, 0.2, np.nan, 1.5], [False, False, True, True, True, True])
    assert (found.hits, found.false_alarms, found.misses, found.rejections, found.unknown) == (2, 1, 1, 1, 1)


@pytest.mark.parametrize(
    ("happened", "fails"),
    [
        pytest.param([True, False], "never", id="all right"),
        pytest.param([False, False], "to the safe side", id="predicts too much"),
        pytest.param([True, True], "to the unsafe side", id="predicts too little"),
        pytest.param([False, True], "to both sides", id="both"),
    ],
)
def test_it_says_in_which_direction_it_fails(happened, fails):
    assert agreement([2.0, 0.5], happened).fails == fails


def test_other_shapes_are_refused():
    with pytest.raises(ValueError, match="truth values"):
        agreement([2.0, 0.5], [True])
