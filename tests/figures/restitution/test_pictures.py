"""Figures of e: estimates, impacts, peaks, the fitted history and the joint region, with marks of what was used."""

import numpy as np
import pytest
from matplotlib.container import ErrorbarContainer
from scipy import stats

from colonnade.dynamics.block import Block
from colonnade.figures.files.table import columns_of
from colonnade.figures.panels.curve import Curve
from colonnade.figures.restitution.decay import (
    EstimateRow,
    ImpactSeries,
    PeakSeries,
    impact_restitution,
    peak_decay,
)
from colonnade.figures.restitution.estimators import estimators_side_by_side, fitted_history, joint_region
from colonnade.figures.style import MEASURED, model_style
from colonnade.identification.restitution.peaks import angle_of_energy
from prism import PRISM

NOTHING = EstimateRow("impact by impact", np.nan, np.nan, np.nan)


def test_estimates_stand_side_by_side_with_their_intervals():
    rows = [EstimateRow("peaks", 0.95, 0.949, 0.951), EstimateRow("whole history", 0.9505, 0.9503, 0.9507, True)]
    axes = estimators_side_by_side({"free-01": [*rows, NOTHING]}, rigid=0.9496).axes[0]
    ends = [path.vertices[:, 0].tolist() for bar in axes.collections for path in bar.get_paths()]
    assert ends == [pytest.approx([0.949, 0.951]), pytest.approx([0.9503, 0.9507])]
    told = {text.get_text(): text.get_fontweight() for text in axes.texts}
    colours = {text.get_text(): text.get_color() for text in axes.texts}
    assert colours["whole history"] != colours["peaks"]
    assert told["0.9505 ± 0.0002"] == "bold"
    assert "none" in told
    assert " rigid body 0.9496 " in told


@pytest.mark.parametrize(("rigid", "told"), [(0.5, "← rigid body 0.5000 "), (0.9999, " rigid body 0.9999 →")])
def test_a_rigid_body_value_far_away_does_not_squeeze_the_estimates(rigid, told):
    axes = estimators_side_by_side({"": [EstimateRow("peaks", 0.95, 0.949, 0.951)]}, rigid=rigid).axes[0]
    assert np.ptp(axes.get_xlim()) < 0.01
    assert told in [text.get_text() for text in axes.texts]


def impacts(title="free-01", *, count=20, error=1e-3, used=True):
    velocity = np.linspace(2.0, 0.2, count)
    e = 0.95 + 0.002 * np.sin(np.arange(count))
    return ImpactSeries(title, velocity, e, np.full(count, error), np.full(count, used))


def named(axes):
    return axes.get_legend_handles_labels()[1]


@pytest.mark.parametrize("count", [2, 60])
def test_the_axis_of_e_shows_the_bars_of_the_surest_impacts_and_not_what_scatters_at_the_end(count):
    series = impacts(count=count)
    series.restitution[-1], series.standard_error[-1] = (0.2, 0.5) if count > 2 else (0.95, 1e-3)
    low, high = impact_restitution([series], level=NOTHING, rigid=0.8).axes[0].get_ylim()
    assert low < 0.948
    assert high > 0.952
    assert high - low < 0.1


def decay(title="free-01", *, count=20, restitution=0.95, used=None):
    number = np.arange(1, count + 1)
    angle = np.asarray(angle_of_energy(0.8 * restitution ** (2 * number), PRISM.critical_angle)) * (-1.0) ** number
    chosen = number <= (count if used is None else used)
    return PeakSeries(title, angle, np.full(count, 1e-4), np.where(chosen, angle, np.nan), chosen)


def test_bars_that_would_merge_are_a_band_about_e_and_stay_in_the_table():
    speed = np.geomspace(1.0, 0.1, 80)
    series = ImpactSeries("free-01", speed, np.full(80, 0.95), 2e-3 / speed, np.full(80, True))
    figure = impact_restitution([series], level=EstimateRow("e identified", 0.95, 0.948, 0.952), rigid=0.8)
    axes = figure.axes[0]
    (band,) = (each for each in axes.collections if each.get_label() == "± two standard errors of an impact")
    outline = band.get_paths()[0].vertices
    (near,) = {round(y, 9) for x, y in outline if x == speed[40] and y > 0.95}
    assert near == pytest.approx(0.95 + 4e-3 / speed[40])
    (bars,) = (each for each in axes.containers if isinstance(each, ErrorbarContainer))
    assert bars[2][0].get_linewidth() == 0
    columns = columns_of(figure)
    low = next(values for name, values in columns.items() if "impact used, low" in name)
    np.testing.assert_allclose(low, 0.95 - 4e-3 / speed)


def test_impacts_and_peaks_that_are_not_there_are_said():
    without = impacts()._replace(restitution=np.full(20, np.nan))
    figures = impact_restitution([without], level=NOTHING, rigid=0.8), peak_decay([decay(count=0)], PRISM)
    assert [figure.axes[0].texts[0].get_text() for figure in figures] == ["no impacts", "no peaks"]


def test_a_constant_restitution_is_a_straight_line_of_slope_two_ln_e():
    axes = peak_decay([decay()], PRISM).axes[0]
    fit = next(line for line in axes.lines if line.get_label() == "fit")
    slopes = np.diff(np.log(fit.get_ydata()))
    assert slopes == pytest.approx(2 * np.log(0.95), rel=1e-9)
    assert axes.get_yscale() == "log"


def test_an_asymmetric_block_scales_each_side_by_its_own_angle():
    block = Block.measured(mass=80, pole_distance=0.61, critical_angle=(0.1, 0.2), inertia=41.2)
    angle = np.array([0.05, -0.05, 0.15, -0.15])
    peaks = PeakSeries("statue", angle, np.zeros(4), np.full(4, np.nan), np.ones(4, dtype=bool))
    shown = peak_decay([peaks], block).axes[0].containers[0].lines[0].get_ydata()
    assert shown == pytest.approx([0.4375, 0.75, 0.9375], abs=2e-3)  # 1 − (1 − |θ|/α)², and −0.15 is beyond α


TIME = np.linspace(0, 6, 601)
MEASURED_ANGLE = Curve(TIME, 0.5 * np.exp(-TIME / 3) * np.cos(4 * TIME))
PART = slice(100, 500)


def test_a_fitted_history_shows_measured_fit_and_what_is_left_over():
    fitted = Curve(TIME[PART], MEASURED_ANGLE.values[PART] + 1e-3)
    residual = Curve(TIME[PART], np.full(400, -1e-3))
    figure = fitted_history(MEASURED_ANGLE, fitted, residual, 1e-3)
    above, below = figure.axes
    assert named(above) == ["measured", "fitted, nonlinear model"]
    assert above.lines[0].get_color() == MEASURED["color"]
    assert above.lines[1].get_color() == model_style("nonlinear")["color"]
    assert below.lines[0].get_ydata() == pytest.approx(np.full(400, -1.0))  # 10⁻³ α
    assert below.texts[0].get_text() == "RMS 1·10⁻³ α"
    assert above.get_xlim() == (0, 6)


def test_the_joint_region_holds_its_share_of_a_normal_distribution():
    centre = np.array([0.95, 1.01])
    covariance = np.array([[4e-6, 3e-6], [3e-6, 9e-6]])
    axes = joint_region("free-01", centre, covariance, fixed=EstimateRow("", 0.949, 0.948, 0.95)).axes[0]
    for line, level in zip(axes.lines[:2], (0.5, 0.95), strict=True):
        away = np.column_stack(line.get_data()) - centre
        distance = np.einsum("ij,jk,ik->i", away, np.linalg.inv(covariance), away)
        assert distance == pytest.approx(np.full(away.shape[0], stats.chi2.ppf(level, 2)))
    assert "e with α as given" in axes.get_legend_handles_labels()[1]
