import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from colonnade.dynamics.models import MODELS
from colonnade.figures.histories import LARGEST_RATIO, SMALLEST_RATIO, Spread, draw_angle, limit_of, time_limits
from colonnade.figures.panels.curve import Curve
from colonnade.figures.style import MEASURED, model_style

TIME = np.linspace(0.0, 10.0, 2001)


def swing(amplitude):
    return Curve(TIME, amplitude * np.sin(2 * np.pi * TIME))


def drawn(measured, predicted, limit=0.5, **options):
    axes = Figure().subplots()
    draw_angle(axes, measured, predicted, limit, **options)
    return axes


def test_measured_and_models_have_their_own_colours_and_dashes():
    axes = drawn(swing(0.4), {model: swing(0.3) for model in MODELS})
    expected = [MEASURED["color"], *(model_style(model)["color"] for model in MODELS)]
    assert [to_hex(line.get_color()) for line in axes.lines] == expected
    assert len({model_style(model)["linestyle"] for model in MODELS}) == len(MODELS)


def test_in_small_panels_only_the_models_lines_are_thinner():
    measured, linear = drawn(swing(0.4), {"linear": swing(0.3)}, thinness=0.5).lines
    assert measured.get_linewidth() == MEASURED["linewidth"]
    assert linear.get_linewidth() == 0.5 * model_style("linear")["linewidth"]


def test_the_widest_band_of_an_ensemble_is_shaded_below_the_lines():
    levels = np.array([0.05, 0.25, 0.5, 0.75, 0.95])
    centre = swing(0.3).values
    spread = Spread(TIME, levels, centre + np.linspace(-0.1, 0.1, 5)[:, None], 0.0, 3.0)
    axes = drawn(swing(0.3), {"nonlinear": swing(0.3)}, spreads={"nonlinear": spread})
    (band,) = axes.collections
    assert band.get_label() == "nonlinear 90\u00a0% band"
    assert to_hex(band.get_facecolor()[0]) == model_style("nonlinear")["color"]
    assert band.get_zorder() < min(line.get_zorder() for line in axes.lines)
    heights = band.get_paths()[0].vertices[:, 1]
    assert (heights.min(), heights.max()) == pytest.approx((-0.4, 0.4), abs=1e-3)
    (mark,) = (text for text in axes.texts if text.get_text() == "horizon")
    assert mark.xy[0] == 3.0


def test_a_model_without_a_style_is_refused():
    with pytest.raises(ValueError, match='Unknown model "clay"'):
        model_style("clay")


def test_what_was_not_measured_is_not_named():
    assert drawn(None, {"linear": swing(0.3)}).get_legend_handles_labels()[1] == ["linear model"]


def test_without_any_angle_the_panel_says_so():
    assert "no rocking angle" in drawn(None, {}).texts[0].get_text()


def test_the_critical_angle_is_marked_where_the_axis_reaches_it():
    assert [text.get_text() for text in drawn(swing(2.0), {}, 1.35).texts] == ["α"]
    assert not drawn(swing(0.4), {}, 0.5).texts


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
