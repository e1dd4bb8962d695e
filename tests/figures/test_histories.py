import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from colonnade.dynamics.models import MODELS
from colonnade.figures.histories import (
    LARGEST_RATIO,
    SMALLEST_RATIO,
    draw_angle,
    limit_of,
)
from colonnade.figures.panels.curve import Curve
from colonnade.figures.style import MEASURED, model_style

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


def test_without_any_angle_the_panel_says_so():
    assert "no rocking angle" in drawn({}).texts[0].get_text()


@pytest.mark.parametrize(
    ("amplitude", "limit"),
    [(0.001, SMALLEST_RATIO), (0.5, 0.56), (1.0, 1.12), (8.4, LARGEST_RATIO)],
    ids=["a block at rest", "rocking", "up to the critical angle", "overturned"],
)
def test_the_angle_axis_shows_rocking_and_not_noise_or_the_fall(amplitude, limit):
    assert limit_of([swing(amplitude)]) == pytest.approx(limit, rel=1e-3)
