"""Arguments of the identification as a notebook gives them: each wrong one is named."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.identification.restitution.arguments import check_records, check_settings
from every import every
from prism import PRISM

SETTINGS = {"block": PRISM, "level": 0.95, "lowest_amplitude": 0.02, "noise": None, "lowpass": None, "free": ()}
TIME = np.arange(5.0)


def settings(**changed):
    given = SETTINGS | changed
    return check_settings(given.pop("block"), **given)


@pytest.mark.parametrize("free", [(), ("p",), ["p", "critical_angle"]])
def test_what_is_freed_comes_back_as_a_tuple(free):
    assert settings(free=free) == tuple(free)


@every(
    ("changed", "said"),
    [
        ({"block": "prism"}, "block"),
        ({"level": 1.0}, "level"),
        ({"level": "95 %"}, "level"),
        ({"lowest_amplitude": -0.1}, "lowest_amplitude"),
        ({"noise": -1e-5}, "noise"),
        ({"lowpass": 0.0}, "lowpass"),
        ({"free": "p"}, "free is"),
        ({"free": ("restitution",)}, "free names 'restitution'"),
    ],
)
def test_a_setting_out_of_its_range_is_named(changed, said):
    with pytest.raises(ValueError, match=said):
        settings(**changed)


def test_records_become_arrays_and_gaps_stay():
    times, angles = check_records(TIME.tolist(), [0, 1, np.nan, 3, 4], slide=np.zeros(5), uplift=None)
    assert times.dtype == angles.dtype == np.float64
    assert np.isnan(angles[2])


@pytest.mark.parametrize(
    ("time", "angle", "others", "said"),
    [
        (TIME, TIME[:4], {}, r"time has shape \(5,\) and angle \(4,\)"),
        (TIME, TIME, {"slide": TIME[:2]}, r"and slide \(2,\)"),
        (TIME[::-1], TIME, {}, "time does not increase after sample 0"),
        ([0, 1, 1, 2, 3], TIME, {}, "time does not increase after sample 1"),
        (["a"] * 5, TIME, {}, "time"),
    ],
)
def test_records_that_do_not_belong_together_are_refused(time, angle, others, said):
    with pytest.raises(ValueError, match=said):
        check_records(time, angle, **others)
