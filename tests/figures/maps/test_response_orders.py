"""The figure of steady responses shows their orders by colour, curves of their amplitudes, and measured points."""

import numpy as np
import pytest

from colonnade.dynamics.maps import SteadyResponse
from colonnade.figures.maps.response_orders import response_orders

OMEGAS, LEVELS = np.linspace(2.0, 8.0, 7), np.linspace(0.8, 3.0, 5)
OPTIONS = {"model": "linear", "settling": 400, "ramp": 2.0, "phase": 0.0}
OPTIONS |= {"restitution_negative": 0.9, "restitution_positive": 0.9}


def response():
    """At rest below, every cycle, then a third, irregular and overturned above."""
    order = np.tile(np.array([0, 1, 3, -1, -2], dtype=np.int8), (7, 1))
    amplitude = np.tile(np.array([0.0, 0.2, 0.5, 0.6, np.nan]), (7, 1)) * (10.0 / OMEGAS)[:, None] / 5.0
    return SteadyResponse(OMEGAS, LEVELS, order, amplitude)


def test_every_order_has_the_colour_that_its_legend_names():
    figure = response_orders(response(), [], OPTIONS)
    mesh = figure.axes[0].collections[0]
    numbers = mesh.get_array().reshape(5, 7)[:, 0]
    assert numbers.tolist() == [0, 1, 3, -1, -2]
    (legend,) = figure.legends
    named = dict(zip([text.get_text() for text in legend.get_texts()], legend.get_patches(), strict=True))
    assert list(named) == ["at rest", "every cycle", "sub-harmonic 1/3", "irregular", "overturned"]
    shown = mesh.cmap(mesh.norm(numbers))
    np.testing.assert_allclose(shown, [patch.get_facecolor() for patch in named.values()], atol=1e-6)


def test_curves_break_where_the_order_changes_and_dots_mark_what_is_not_every_cycle():
    over_amplitude = response_orders(response(), [], OPTIONS).axes[2]
    curve, dots = over_amplitude.lines[:2]
    assert curve.get_label() == "Ω = 2.00"
    joined = [not np.isnan(curve.get_ydata()[place : place + 2]).any() for place in range(len(curve.get_ydata()) - 1)]
    assert not any(joined)
    np.testing.assert_allclose(dots.get_xdata(), LEVELS[2:4])
    np.testing.assert_allclose(dots.get_ydata(), [0.5, 0.6])


def test_a_block_that_nowhere_rocks_has_no_curves_and_a_single_column_is_no_map():
    resting, one = (
        SteadyResponse(omegas, LEVELS, *[np.zeros((omegas.size, 5), dtype=np.int8)] * 2)
        for omegas in (OMEGAS, OMEGAS[:1])
    )
    assert [len(axes.lines) for axes in response_orders(resting, [], OPTIONS).axes[1:]] == [0, 0]
    with pytest.raises(ValueError, match="at least two of each"):
        response_orders(one, [], OPTIONS)
