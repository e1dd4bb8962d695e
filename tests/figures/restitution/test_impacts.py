from __future__ import annotations

import numpy as np
import pytest

from colonnade.figures import ImpactSeries, Level, impact_restitution


def impacts(title="free-01", *, count=20, error=1e-3, used=True):
    velocity = np.linspace(2.0, 0.2, count)
    e = 0.95 + 0.002 * np.sin(np.arange(count))
    return ImpactSeries(title, velocity, e, np.full(count, error), np.full(count, used))


def named(axes):
    return axes.get_legend_handles_labels()[1]


def test_each_impact_has_its_bar_and_the_constant_its_band():
    level = Level(0.95, 0.949, 0.951, "e = 0.9500 ± 0.0010")
    axes = impact_restitution([impacts()], level=level, rigid=0.9505).axes[0]
    assert set(named(axes)) == {"impact used", "e = 0.9500 ± 0.0010", "rigid body"}
    segments = axes.containers[0].lines[2][0].get_segments()
    assert [np.ptp(segment[:, 1]) for segment in segments] == pytest.approx([4e-3] * 20)


def test_a_rigid_body_value_off_the_axis_is_told_at_its_edge():
    axes = impact_restitution([impacts()], rigid=0.8).axes[0]
    assert axes.get_ylim()[0] > 0.8
    assert [text.get_text() for text in axes.texts] == ["rigid body 0.8000 ↓"]


def test_impacts_left_out_are_hollow_and_several_tests_have_marks_of_their_own():
    figure = impact_restitution([impacts(), impacts("free-02", used=False)])
    first, second = figure.axes[0].containers
    assert first.lines[0].get_markerfacecolor() != second.lines[0].get_markerfacecolor()
    assert first.lines[0].get_marker() != second.lines[0].get_marker()
    assert named(figure.axes[0]) == ["free-01", "impact left out"]


@pytest.mark.parametrize("count", [2, 60])
def test_the_axis_of_e_shows_the_bars_of_the_surest_impacts_and_not_what_scatters_at_the_end(count):
    series = impacts(count=count)
    series.restitution[-1], series.standard_error[-1] = (0.2, 0.5) if count > 2 else (0.95, 1e-3)
    low, high = impact_restitution([series]).axes[0].get_ylim()
    assert low < 0.948
    assert high > 0.952
    assert high - low < 0.1


def test_impacts_without_a_value_are_said():
    series = impacts()._replace(restitution=np.full(20, np.nan))
    assert impact_restitution([series]).axes[0].texts[-1].get_text() == "no impacts"


def test_no_series_is_refused():
    with pytest.raises(ValueError, match="no free vibration"):
        impact_restitution([])
