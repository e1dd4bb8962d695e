import re

import numpy as np
import pytest

from colonnade.readers.motion import read_motion
from colonnade.signals.filters import lowpass
from colonnade.signals.named_motion import Series, best_scale, check_motion, laid_on, match

SCALE = 1 / np.sqrt(20)
STEP = 0.02


def _motion(seed, seconds=40.0):
    rng = np.random.default_rng(seed)
    time = STEP * np.arange(int(seconds / STEP))
    shape = np.clip(time / 2, 0, 1) * np.exp(-np.clip(time - 8, 0, None) / 12)
    return lowpass(rng.normal(size=time.size), STEP, 5.0) * shape


VALLEY, HILL = _motion(1), _motion(2)
HOLED = np.where(np.isin(np.arange(VALLEY.size) * STEP // 1, (5, 6)), 0.0, VALLEY)


def _record(motion, *, scale=SCALE, step=STEP, gain=1.7, noise=0.02):
    """What a table recorded that played a motion: rest, motion, rest."""
    time = np.arange(0, 7.5 + step * scale * motion.size, 1 / 500)
    values = np.interp(time - 1.5, step * scale * np.arange(motion.size), motion, left=0, right=0)
    level = gain * np.abs(values).max()
    return Series(gain * values + np.random.default_rng(0).normal(0, noise * level, time.size), 1 / 500)


def _said(record, motion=VALLEY, **options):
    given = {"time_scale": SCALE, "others": {"Hill": Series(HILL, STEP)}} | options
    return " ".join(map(str, check_motion(record, "Valley", Series(motion, STEP), **given)))


def test_the_motion_named_is_recognised_whatever_its_amplitude():
    record = _record(VALLEY)
    assert _said(record) == ""
    assert _said(Series(-0.001 * record.acceleration, record.interval), motion=-VALLEY) == ""
    found = match(record, Series(VALLEY, STEP), SCALE)
    assert found.begin / 500 == pytest.approx(1.5, abs=2e-3)
    assert found.correlation > 0.99


def test_a_time_scale_that_is_not_told_is_found():
    record = _record(VALLEY, scale=0.3)
    assert _said(record, time_scale=None) == ""
    assert best_scale(record, Series(VALLEY, STEP)) == pytest.approx(0.3, rel=3e-3)


@pytest.mark.parametrize(
    ("record", "said"),
    [
        (_record(-VALLEY), "with the other polarity"),
        (_record(VALLEY, scale=1.0), r"but with time scale (1|1\.00\d|0\.99\d\d?) "),
        (_record(VALLEY, scale=0.25), "but with time scale 0.2[45]"),
        (_record(HILL), 'it moved as "Hill"'),
        (_record(_motion(3)), "it is another motion, or the table did not follow"),
        (_record(HOLED), "from (4|5).* to (7|8).* s of its own time: a part is missing or differs"),
        (
            Series(_record(VALLEY).acceleration[: 500 * 5], 1 / 500),
            r"from 1[4-6]\S* to [34]\d\S* s of its own time",
        ),
        (Series(_record(VALLEY).acceleration[1000:], 1 / 500), r"from 0\S* to 2\S* s of its own time"),
    ],
    ids=["polarity", "full scale", "other scale", "known other", "unknown other", "hole", "cut off", "late"],
)
def test_what_is_not_as_named_is_told(record, said):
    told = _said(record)
    assert re.search(said, told), told


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("elcentro_chopra_xy.dat", ""),
        ("elcentro_damaged_copy.txt", "from 24.* to 25.* s of its own time"),
        ("elcentro_s00e_reversed.dat", "another motion"),
    ],
)
def test_other_versions_of_el_centro_are_told_from_the_one_named(name, said, shared_data):
    folder = shared_data / "motion"
    named = read_motion(folder / "elcentro_chopra_8f10.dat")
    played = read_motion(folder / name, unit="g", dt=0.02)
    found = check_motion(
        _record(played.acceleration), "El Centro", Series(named.acceleration, named.dt), time_scale=SCALE, others={}
    )
    told = " ".join(map(str, found))
    assert (told == "") == (said == "")
    assert re.search(said, told)


def test_a_motion_is_laid_on_its_record_with_delay_and_factor_and_another_is_not():
    usual = _record(VALLEY, gain=1.7)
    record = Series(-usual.acceleration, usual.interval)
    laid = laid_on(record, Series(VALLEY, STEP), time_scale=SCALE)
    assert laid.factor == pytest.approx(-1.7, rel=2e-2)
    assert laid.correlation < -0.95
    misfit = record.acceleration - laid.acceleration
    assert np.std(misfit) < 0.15 * np.std(record.acceleration)
    assert laid_on(record, Series(_motion(99), STEP), time_scale=SCALE) is None
