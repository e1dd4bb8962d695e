from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.figures import PeakSeries, peak_decay
from colonnade.identification.restitution.arcs.energy import angle_of_energy
from prism import PRISM


def decay(title: str = "free-01", *, count: int = 20, restitution: float = 0.95, used: int | None = None) -> PeakSeries:
    number = np.arange(1, count + 1)
    angle = np.asarray(angle_of_energy(0.8 * restitution ** (2 * number), PRISM.critical_angle)) * (-1.0) ** number
    chosen = number <= (count if used is None else used)
    return PeakSeries(title, angle, np.full(count, 1e-4), np.where(chosen, angle, np.nan), chosen)


def test_a_constant_restitution_is_a_straight_line_of_slope_two_ln_e():
    axes = peak_decay([decay()], PRISM).axes[0]
    fit = next(line for line in axes.lines if line.get_label() == "fit")
    slopes = np.diff(np.log(fit.get_ydata()))
    assert slopes == pytest.approx(2 * np.log(0.95), rel=1e-9)
    assert axes.get_yscale() == "log"


def test_peaks_left_out_are_told_from_peaks_used():
    axes = peak_decay([decay(used=15)], PRISM).axes[0]
    drawn = {box.get_label(): box.lines[0] for box in axes.containers}
    assert drawn["peak used"].get_xdata().size == 15
    assert drawn["peak left out"].get_xdata().tolist() == [16, 17, 18, 19, 20]
    assert drawn["peak used"].get_markerfacecolor() != drawn["peak left out"].get_markerfacecolor()


def test_a_refused_identification_has_peaks_and_no_line():
    axes = peak_decay([decay(used=0)], PRISM).axes[0]
    assert "fit" not in axes.get_legend_handles_labels()[1]
    assert axes.get_legend_handles_labels()[1] == ["peak left out"]


def test_tests_side_by_side_have_the_same_scales():
    figure = peak_decay([decay(f"free-{k}", count=10 + 10 * k) for k in range(4)], PRISM)
    assert len({(axes.get_xlim(), axes.get_ylim()) for axes in figure.axes}) == 1
    assert len(figure.axes) == 4
    assert figure.axes[0].get_xlim()[1] >= 40


def test_an_asymmetric_block_scales_each_side_by_its_own_angle():
    block = Block.measured(mass=80, pole_distance=0.61, critical_angle=(0.1, 0.2), inertia=41.2)
    angle = np.array([0.05, -0.05, 0.15, -0.15])
    peaks = PeakSeries("statue", angle, np.zeros(4), np.full(4, np.nan), np.ones(4, dtype=bool))
    shown = peak_decay([peaks], block).axes[0].containers[0].lines[0].get_ydata()
    assert shown == pytest.approx([0.4375, 0.75, 0.9375], abs=2e-3)  # 1 − (1 − |θ|/α)², and −0.15 is beyond α


def test_no_peak_at_all_is_said():
    empty = np.empty(0)
    figure = peak_decay([PeakSeries("free-01", empty, empty, empty, empty.astype(bool))], PRISM)
    assert figure.axes[0].texts[0].get_text() == "no peaks"


def test_no_series_is_refused():
    with pytest.raises(ValueError, match="no free vibration was given"):
        peak_decay([], PRISM)


def test_housners_line_has_its_band_and_peaks_at_the_noise_do_not_stretch_the_scale():
    block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    number = np.arange(30)
    angle = np.asarray(angle_of_energy(0.8 * 0.9 ** (2 * number), block.critical_angle)) * (-1.0) ** number
    angle[-3:] = [1e-9, -1e-9, 1e-9]
    used = number < 20
    band = np.full(30, 0.1)
    peaks = PeakSeries("free-01", angle, np.full(30, 1e-4), np.where(used, angle, np.nan), used, band)
    axes = peak_decay([peaks], block).axes[0]
    line = next(line for line in axes.lines if line.get_label() == "fit").get_ydata()
    outline = axes.collections[-1].get_paths()[0].vertices[:, 1]
    assert outline.min() == pytest.approx(line.min() * np.exp(-0.1))
    assert outline.max() == pytest.approx(line.max() * np.exp(0.1))
    assert axes.get_ylim()[0] > 1e-4
