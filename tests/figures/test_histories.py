import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from colonnade.dynamics.models import MODELS
from colonnade.figures.histories import (
    LARGEST_RATIO,
    SMALLEST_RATIO,
    Spread,
    bands_over_time,
    draw_angle,
    limit_of,
    time_limits,
)
from colonnade.figures.panels.curve import Curve
from colonnade.figures.stored.record import HEIGHT, LOWER, rocking_angle
from colonnade.figures.style import COLUMNS, MEASURED, journal, model_style

TIME = np.linspace(0.0, 10.0, 2001)


def swing(amplitude):
    return Curve(TIME, amplitude * np.sin(2 * np.pi * TIME))


def drawn(curves, limit=0.5, **options):
    axes = Figure().subplots()
    draw_angle(axes, curves, limit, **options)
    return axes


def test_measured_and_models_have_their_own_colours_and_dashes():
    axes = drawn({"measured": swing(0.4)} | {model: swing(0.3) for model in MODELS})
    expected = [MEASURED["color"], *(model_style(model)["color"] for model in MODELS)]
    assert [to_hex(line.get_color()) for line in axes.lines] == expected
    assert len({model_style(model)["linestyle"] for model in MODELS}) == len(MODELS)


def test_in_small_panels_only_the_models_lines_are_thinner():
    measured, linear = drawn({"measured": swing(0.4), "linear": swing(0.3)}, thinness=0.5).lines
    assert measured.get_linewidth() == MEASURED["linewidth"]
    assert linear.get_linewidth() == 0.5 * model_style("linear")["linewidth"]


def test_the_widest_band_of_an_ensemble_is_shaded_below_the_lines():
    levels = np.array([0.05, 0.25, 0.5, 0.75, 0.95])
    centre = swing(0.3).values
    spread = Spread(TIME, levels, centre + np.linspace(-0.1, 0.1, 5)[:, None], 0.0, 3.0)
    axes = drawn({"measured": swing(0.3), "nonlinear": swing(0.3)}, spreads={"nonlinear": spread})
    (band,) = axes.collections
    assert band.get_label() == "nonlinear 90\u00a0% band"
    assert to_hex(band.get_facecolor()[0]) == model_style("nonlinear")["color"]
    assert band.get_zorder() < min(line.get_zorder() for line in axes.lines)
    heights = band.get_paths()[0].vertices[:, 1]
    assert (heights.min(), heights.max()) == pytest.approx((-0.4, 0.4), abs=1e-3)
    (mark,) = (text for text in axes.texts if text.get_text() == "horizon")
    assert mark.xy[0] == 3.0


def test_without_any_angle_the_panel_says_so():
    assert "no rocking angle" in drawn({}).texts[0].get_text()


def test_the_critical_angle_is_marked_where_the_axis_reaches_it():
    assert [text.get_text() for text in drawn({"measured": swing(2.0)}, 1.35).texts] == ["α"]
    assert not drawn({"measured": swing(0.4)}, 0.5).texts


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


MEASURED_CURVE = Curve(TIME, 0.4 * np.sin(6 * TIME))
LINEAR = Curve(TIME, 0.3 * np.sin(6 * TIME))


def test_measured_and_models_are_drawn_with_what_was_done_above_them():
    (axes,) = rocking_angle({"measured": MEASURED_CURVE, "linear": LINEAR}, title="prism, Ω = 4.00").axes
    assert axes.get_title(loc="left") == "prism, Ω = 4.00"
    assert axes.get_xlabel() == "time (s)"
    measured, linear = axes.lines[:2]
    assert measured.get_color() == MEASURED["color"]
    np.testing.assert_allclose(np.abs(linear.get_ydata()).max(), 0.3, rtol=1e-3)
    assert axes.get_xlim() == pytest.approx((0.0, 10.0), abs=0.5)


def test_in_a_single_column_the_panel_is_lower():
    with journal("double"):
        wide = rocking_angle({"measured": MEASURED_CURVE}, title="").get_size_inches()
    with journal("single"):
        narrow = rocking_angle({"measured": MEASURED_CURVE}, title="").get_size_inches()
    assert (wide[0], narrow[0]) == pytest.approx((COLUMNS["double"], COLUMNS["single"]))
    assert wide[1] - narrow[1] == pytest.approx(HEIGHT - LOWER, abs=0.2)


LEVELS = np.array([0.05, 0.25, 0.5, 0.75, 0.95])
FINE = np.linspace(0.0, 10.0, 5001)
CENTRE = 0.4 * np.sin(4 * FINE)
BANDS = CENTRE + np.array([[-0.1], [-0.05], [0.0], [0.05], [0.1]]) * FINE / 10


def spread(probability=0.0, horizon=10.0):
    return Spread(FINE, LEVELS, BANDS, probability, horizon)


def shades(axes):
    """Outlines of the bands, the widest first."""
    return [collection.get_paths()[0].vertices for collection in axes.collections]


def test_each_model_has_a_panel_with_its_bands_and_the_measured_angle():
    figure = bands_over_time({"measured": Curve(FINE, CENTRE)}, {"linear": spread(), "nonlinear": spread()})
    said = [axes.get_title(loc="right") for axes in figure.axes]
    assert said[0] == "measured, and bands of 90\u00a0% and 50\u00a0% of the linear model's runs"
    assert "of the nonlinear model's runs" in said[1]
    for axes in figure.axes:
        assert len(shades(axes)) == 2
        assert [line.get_label() for line in axes.lines] == ["measured"]
    assert figure.axes[0].collections[0].get_facecolor()[0, :3] != pytest.approx(
        figure.axes[1].collections[0].get_facecolor()[0, :3]
    )


def test_the_probability_of_overturning_is_written_where_there_is_one():
    def said(probability):
        return bands_over_time({}, {"linear": spread(probability)}).axes[0].get_title(loc="right")

    assert "12\u00a0% overturn" in said(0.12)
    assert "overturn" not in said(0.0)


def test_each_model_has_its_horizon_marked_unless_it_is_the_records_end():
    figure = bands_over_time({}, {"linear": spread(horizon=4.0), "nonlinear": spread(horizon=7.0), "contact": spread()})
    marks = [[line.get_xdata()[0] for line in axes.lines if len(line.get_xdata()) == 2] for axes in figure.axes]
    assert marks == [[4.0], [7.0], []]
    assert ["horizon" in [text.get_text() for text in axes.texts] for axes in figure.axes] == [True, True, False]
