from __future__ import annotations

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from colonnade.figures import Curve, SpanPanel, history_with_base, rocking_history, spans_together
from colonnade.figures.histories import LARGEST_RATIO, SMALLEST_RATIO, limit_of, time_limits
from colonnade.figures.style import MEASURED, MODELS, model_style

TIME = np.linspace(0.0, 10.0, 2001)


def swing(amplitude: float, frequency: float = 1.0) -> Curve:
    return Curve(TIME, amplitude * np.sin(2 * np.pi * frequency * TIME))


def legend(figure: Figure) -> list[str]:
    return [text.get_text() for box in figure.legends for text in box.get_texts()]


def test_measured_and_models_keep_their_colours_in_every_figure():
    predicted = {model: swing(0.3) for model in MODELS}
    drawn = [
        rocking_history(swing(0.4), predicted).axes[0],
        history_with_base(swing(0.4), predicted, swing(2.0)).axes[0],
        spans_together([SpanPanel("Span 2.0", swing(0.4), predicted)]).axes[0],
    ]
    expected = [MEASURED["color"], *(style["color"] for style in MODELS.values())]
    for axes in drawn:
        assert [to_hex(line.get_color()) for line in axes.lines[:4]] == expected
    assert len({style["linestyle"] for style in MODELS.values()}) == len(MODELS)


def test_a_model_without_a_style_is_refused():
    with pytest.raises(ValueError, match="no line style for the model 'clay'"):
        model_style("clay")


def test_history_and_base_motion_share_the_time_axis():
    figure = history_with_base(swing(0.4), {}, Curve(TIME[:1000], TIME[:1000]))
    upper, lower = figure.axes
    assert upper.get_xlim() == lower.get_xlim() == (0.0, 10.0)
    assert lower.get_ylabel().endswith("(m/s²)")
    assert lower.get_xlabel() == "time (s)"


def test_the_legend_names_each_line_once():
    assert legend(history_with_base(swing(0.4), {"linear": swing(0.3)}, swing(2.0))) == ["measured", "linear model"]


def test_what_was_not_measured_is_not_in_the_legend():
    assert legend(rocking_history(None, {"linear": swing(0.3)})) == ["linear model"]


def test_without_any_angle_the_figure_says_so():
    figure = history_with_base(None, {}, swing(2.0))
    assert "no rocking angle" in figure.axes[0].texts[0].get_text()


@pytest.mark.parametrize(
    ("amplitude", "limit"),
    [(0.001, SMALLEST_RATIO), (0.5, 0.56), (1.0, 1.12), (8.4, LARGEST_RATIO)],
    ids=["a block at rest", "rocking", "up to the critical angle", "overturned"],
)
def test_the_angle_axis_shows_rocking_and_not_noise_or_the_fall(amplitude, limit):
    assert limit_of([swing(amplitude)]) == pytest.approx(limit, rel=1e-3)


def test_curves_without_values_have_limits_too():
    assert limit_of([]) == SMALLEST_RATIO
    assert limit_of([Curve(TIME, np.full(TIME.size, np.nan))]) == SMALLEST_RATIO
    assert time_limits([]) == (0.0, 1.0)


@pytest.mark.parametrize(("uplift", "lines"), [(1.5, 3), (5.0, 1), (None, 1)], ids=["within", "beyond", "not known"])
def test_the_uplift_acceleration_is_drawn_where_the_motion_reaches_it(uplift, lines):
    figure = history_with_base(swing(0.4), {}, swing(2.0), uplift=uplift)
    assert len(figure.axes[1].lines) == lines


def test_spans_have_the_same_scales():
    panels = [SpanPanel(f"Span {k}", swing(0.2 * k), {"linear": swing(0.25 * k)}) for k in (1, 2, 3)]
    figure = spans_together(panels)
    assert len({axes.get_ylim() for axes in figure.axes}) == 1
    assert figure.axes[0].get_ylim() == pytest.approx((-0.84, 0.84))
    assert {axes.get_xlim() for axes in figure.axes} == {(0.0, 10.0)}
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["Span 1", "Span 2", "Span 3"]


def test_no_span_is_refused():
    with pytest.raises(ValueError, match="no test was given"):
        spans_together([])


def test_figures_can_be_drawn_into_axes_of_ones_own():
    own = Figure()
    axes = own.subplots(4)
    assert rocking_history(swing(0.4), {}, axes=axes[0]) is own
    assert history_with_base(swing(0.4), {}, swing(2.0), axes=(axes[1], axes[2])) is own
    assert spans_together([SpanPanel("Span 2.0", swing(0.4), {})], axes=[axes[3]]) is own
    assert all(one.lines for one in axes)
    assert not own.legends


def test_drawing_changes_no_setting_of_matplotlib():
    import matplotlib

    before = dict(matplotlib.rcParams)
    rocking_history(swing(0.4), {})
    assert dict(matplotlib.rcParams) == before
