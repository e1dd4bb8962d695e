"""Each example of the gallery runs without a screen, draws, and shows something true that has a source of its own."""

import contextlib
import io
import math
import runpy
import warnings
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from matplotlib import pyplot

import colonnade

pytestmark = pytest.mark.whole

FOLDER = Path(__file__).parents[1] / "examples"
EXAMPLES = {path.stem.removeprefix("plot_"): path for path in sorted(FOLDER.glob("*.py"))}


class Example(NamedTuple):
    """What an example left: its names, what it printed, and the axes of its figures."""

    names: dict[str, Any]
    printed: str
    axes: list[Any]


@pytest.fixture
def example(request):
    """The example that a test is called after."""
    name = request.node.name.removeprefix("test_").split("__")[0]
    printed = io.StringIO()
    pyplot.close("all")
    with contextlib.redirect_stdout(printed), warnings.catch_warnings():
        warnings.simplefilter("error")
        names = runpy.run_path(str(EXAMPLES[name]))
    figures = [pyplot.figure(number) for number in pyplot.get_fignums()]
    assert figures
    yield Example(names, printed.getvalue(), [axes for figure in figures for axes in figure.axes])
    pyplot.close("all")


def test_01_free_rocking__has_housners_period_and_peaks_and_moves(example, tmp_path):  # Housner 1963, eqs. 3 and 11
    assert example.names["history"].impact_times[0] == pytest.approx(example.names["quarter"], rel=1e-9)
    computed, circles = example.axes[0].lines
    found = np.interp(circles.get_xdata(), computed.get_xdata(), computed.get_ydata())
    np.testing.assert_allclose(found, circles.get_ydata(), atol=2e-4)
    example.names["animation"].save(tmp_path / "rocking.gif", writer="pillow", dpi=20)
    assert (tmp_path / "rocking.gif").stat().st_size > 10_000


def test_02_size__scales_time_by_the_root_of_the_size(example):  # similitude: p ∝ 1/√R
    names = example.names
    assert names["model"].p / names["column"].p == pytest.approx(math.sqrt(20.0), rel=1e-12)
    assert (names["small"].outcome, names["large"].outcome, names["alike"].outcome) == (
        "overturned", "rocking", "overturned"
    )  # fmt: skip
    np.testing.assert_allclose(names["alike"].angle, names["small"].angle, atol=1e-9)


def test_03_pulse__overturns_from_its_closed_form(example):
    block, limit = example.names["block"], example.names["limit"]
    assert limit / (block.gravity * block.critical_angle) == pytest.approx(1.800724, abs=5.1e-7)
    assert list(example.names["outcomes"].values()) == ["rocking", "rocking", "overturned", "overturned"]


def test_04_spectra__have_a_band_that_is_survived_and_are_of_single_blocks(example):
    spectrum, sizes = example.names["spectrum"], example.names["sizes"]
    at_three = spectrum.interval_frequency_ratio == spectrum.frequency_ratio[20]
    assert at_three.sum() >= 2  # between two intervals that overturn a stronger pulse is survived
    assert sizes.overturned[0].sum() > sizes.overturned[2].sum() > 0


def test_05_vertical_motion__that_is_constant_is_gravity(example):
    assert example.names["difference"] < 1e-12
    assert example.names["with_it"].peak_ratio != pytest.approx(example.names["without"].peak_ratio, rel=0.05)


def test_06_measured_block__rocks_on_each_side_with_its_own_period(example):
    statue = example.names["statue"]
    for sign, side in zip((-1, 1), statue.sides, strict=True):
        released = colonnade.rock(statue, theta0=0.5 * sign * side.critical_angle, restitution=0.9, duration=2.0)
        quarter = math.acosh(2.0) / statue.side_p(side)  # Housner 1963, eq. 3
        assert released.impact_times[0] == pytest.approx(quarter, rel=1e-9)
    to_negative, to_positive = (float(line.split()[-2]) for line in example.printed.splitlines()[-2:])
    assert to_positive < to_negative


def test_07_friction__is_that_of_the_table_before_uplift_and_of_impulses_at_impacts(example):
    names = example.names
    forces, motion, block = names["forces"], names["motion"], names["block"]
    stands = names["time"] < 1.4
    np.testing.assert_allclose(
        forces.required_friction[stands], np.abs(motion.acceleration[stands]) / block.gravity, atol=1e-12
    )
    expected = 0.15 / (1.85 * math.tan(block.critical_angle))
    np.testing.assert_allclose(forces.impact_friction, expected, rtol=1e-9)
    assert names["broken"][0] == names["history"].time[np.argmax(forces.required_friction > 0.3)]


def test_08_rolling_cylinder__has_no_impacts_and_keeps_its_energy(example):
    rocking, rolling = example.names["rocking"], example.names["rolling"]
    assert rocking.warnings == ()
    assert rolling.warnings == ()
    assert np.abs(rocking.angle).max() < 1e-9
    assert rolling.lean.min() > 0.15
    assert example.names["kept"]["pushed sideways"] > 0.9 > example.names["kept"]["let go"]


def test_09_transducers__give_back_the_angle_that_moved_them(example):
    names = example.names
    np.testing.assert_allclose(names["exact"], names["truth"], atol=1e-12)
    assert np.nanstd(names["angle"] - names["truth"]) < 2e-4
    assert (np.isnan(names["angle"]) == np.isnan(names["readings"]).any(axis=0)).all()


def test_10_restitution__is_identified_within_its_interval(example):
    result, truth = example.names["result"], example.names["truth"]
    assert result.low < truth < result.high
    assert result.high - result.low < 1e-4


def test_11_estimators__name_the_tilt(example):
    level, tilted = example.names["results"].values()
    assert level.departures == ()
    assert [each.name for each in tilted.departures] == ["unequal sides"]
    assert tilted.departures[0].size == pytest.approx(
        example.names["tilt"], abs=3 * tilted.departures[0].standard_error
    )
    assert tilted.low < example.names["truth"] < tilted.high


def test_12_speed_dependent__follows_its_law_or_is_refused(example):
    result, law, refused = (example.names[name] for name in ("result", "law", "refused"))
    impacts = result.impacts
    error = (impacts.restitution - law(impacts.velocity)) / impacts.restitution_standard_error
    assert np.mean(np.abs(error[impacts.used]) < 2) > 0.9
    assert [each.name for each in result.departures] == ["speed-dependent restitution"]
    assert refused.value is None
    assert "peaks" in refused.reason


def test_13_record__is_what_was_written_in_its_unit(example):
    names = example.names
    assert 'unit="g"' in example.printed
    np.testing.assert_allclose(names["motion"].acceleration, 0.02 * 9.80665 * names["shaking"], atol=1e-4)
    assert "drifts" in example.printed


def test_14_ensemble__spreads_with_what_is_uncertain(example):
    names = example.names
    assert 0.0 < names["spread"].overturning_probability < 0.5
    assert 0.0 < names["horizon"] < names["time"][-1]


def test_15_sine__has_two_steady_responses(example):
    assert example.names["orders"] == [1, 3]


def test_16_stability_map__lifts_where_the_linear_model_does(example):
    chart, alpha = example.names["chart"], example.names["alpha"]
    assert chart.no_rocking[0] == pytest.approx(alpha / math.tan(alpha), rel=1e-12)
    assert (chart.outcome[:, chart.amplitude_ratio < chart.no_rocking[0]] == 0).all()
    assert {1, 2} <= set(chart.outcome.ravel())


def test_18_fragility__rises_and_is_read_from_the_curve_that_fits(example):
    found = example.names["found"]
    assert (np.diff(found.isotonic.probability.value) >= 0).all()
    assert found.taken == "lognormal"
    assert found.reaches(0.05).value < found.reaches(0.5).value == pytest.approx(found.lognormal.median.value)


def test_20_campaign__finds_the_restitution_that_was_simulated(example):
    e = example.names["e"]
    assert e["low"] < 0.95 < e["high"]
    assert "restitution: done" in example.printed


def test_21_frame__is_harder_to_overturn_than_its_column(example):
    column, gate = example.names["column"], example.names["gate"]
    assert gate.critical_angle == column.critical_angle
    assert gate.p < column.p


def test_22_drums_and_frames__rock_and_stay_with_residuals(example):
    history, moved = example.names["history"], example.names["moved"]
    assert (history.outcome, moved.outcome) == ("rocking", "rocking")
    assert list(history.residuals) == ["low", "middle", "high"]
    assert "mm along x" in example.printed


def test_every_example_is_tested_and_short():
    tests = [name.removeprefix("test_").split("__")[0] for name in globals() if name.startswith("test_")]
    assert [name for name in tests if name in EXAMPLES] == list(EXAMPLES)
    assert len(EXAMPLES) == 20
    for path in EXAMPLES.values():
        assert 15 <= len(path.read_text(encoding="utf-8").splitlines()) <= 100
