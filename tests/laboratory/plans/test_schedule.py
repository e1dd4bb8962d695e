"""The days of a virtual campaign: working days, in the order of the tests."""

from __future__ import annotations

import numpy as np

from colonnade.laboratory.plans.schedule import TESTS_A_DAY, begun


def test_tests_follow_each_other_on_working_days_between_nine_and_four() -> None:
    moments = [begun(position) for position in range(10 * TESTS_A_DAY)]
    assert moments == sorted(set(moments))
    assert len({moment.date() for moment in moments}) == 10
    assert np.is_busday([moment.date() for moment in moments]).all()
    assert {moment.hour for moment in moments} == set(range(9, 16))
