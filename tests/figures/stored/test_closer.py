"""The closer look at stored tests: the separatrix against the equation of motion, and steady cycles in phase."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from colonnade.campaign import Test
from colonnade.campaign.forms.summary import TestSummary
from colonnade.figures import closer
from colonnade.figures.moving import animation
from colonnade.figures.stored.subject import OfTest
from colonnade.store.records.stored import Stored
from prism import PRISM


def test_the_free_motion_on_the_separatrix_arrives_at_the_critical_angle_at_rest():
    """Integrated backwards from just below α with θ'' = −p² sin(α − θ): the same curve (nonlinear model, a = 0)."""
    found = closer.separatrix(PRISM)
    alpha, p, step = PRISM.critical_angle, PRISM.p, 1e-5
    angle, velocity = alpha * (1 - 1e-3), alpha * p * 1e-3
    while angle > 0:
        velocity += step * p**2 * np.sin(alpha - angle)
        angle -= step * velocity
    assert found.velocity[40] == pytest.approx(velocity / (p * alpha), rel=1e-3)
    assert (found.velocity[0], found.velocity[-1]) == (0.0, 0.0)


def sine(record, stored):
    campaign = SimpleNamespace(block=lambda specimen: PRISM)
    return OfTest(campaign, Test.model_construct(id="sine", specimen="prism"), record, stored)


def test_a_steady_sine_is_drawn_over_the_phase_of_the_base():
    time = np.arange(0, 12, 0.004)
    base = 3 * np.sin(2 * np.pi * 2.0 * (time - 0.2))
    angle = 0.05 * np.sin(np.pi * 2.0 * (time - 0.2))  # repeats after two periods of the base
    stored = Stored(
        datasets={
            ("rocking", None): xr.Dataset(
                {"rocking_angle": ("elapsed", angle), "base_acceleration": ("elapsed", base)}, {"elapsed": time}
            ),
            ("compare", None): xr.Dataset({"forcing_frequency": 2.0, "steady_start": 1.0, "steady_stop": 11.0}),
        }
    )
    record = TestSummary(status="done", kind="sine", specimen="prism", outcome="rocking", order=2)
    picture = closer.picture(sine(record, stored))
    assert picture.note == "Right: the rocking angle, last 12 periods of the steady part."
    portrait, steady = picture.figure.axes
    phase, ratio = steady.lines[0].get_data()
    assert steady.get_xlabel() == "phase of the base (periods)"
    assert (np.nanmin(phase), np.nanmax(phase)) == pytest.approx((0, 2), abs=0.02)
    known = np.isfinite(phase)
    due = 0.05 * np.sin(np.pi * phase[known]) / PRISM.critical_angle
    assert np.minimum(np.abs(ratio[known] - due), np.abs(ratio[known] + due)) == pytest.approx(0, abs=1e-3)
    assert portrait.get_ylabel() == "θ′ / (p α)"
    velocity = np.abs(portrait.lines[0].get_ydata()).max()
    assert velocity == pytest.approx(0.05 * np.pi * 2.0 / (PRISM.p * PRISM.critical_angle), rel=1e-2)


def test_an_earthquake_is_enlarged_about_its_largest_angle(reported):
    picture = closer.picture(reported["span-2.0"])
    axes = picture.figure.axes[1]
    low, high = np.nanmin(axes.lines[0].get_xdata()), np.nanmax(axes.lines[0].get_xdata())
    assert low < reported["span-2.0"].record.peak_time < high
    assert axes.texts[0].get_text() == "about the largest angle"
    assert picture.note == "Right: the rocking angle, about the largest angle."


def named(movie):
    (legend,) = movie.figure.legends
    return [text.get_text() for text in legend.get_texts()]


def test_measured_and_each_model_move(reported):
    movie = animation(reported["span-2.0"])
    assert named(movie) == ["measured", "linear model", "nonlinear model"]
    assert movie.title == "span-2.0: the rocking block"
    assert movie.description == "measured and predicted; base: recorded acceleration integrated twice."


def test_it_shows_what_the_page_shows_the_zero_taken_off(reported):
    one = reported["span-2.0"]
    compared = one.stored.datasets["compare", None].assign(zero_offset=0.02)
    one = replace(one, stored=replace(one.stored, datasets=one.stored.datasets | {("compare", None): compared}))
    movie = animation(one)
    times, ratio = one.measured_ratio()
    angles = np.interp(np.linspace(times[0], times[-1], movie.frames), times, ratio * PRISM.critical_angle)
    frame = int(np.nanargmax(angles))
    movie.show(frame)
    right, left = movie.figure.axes[0].patches[0].get_xy()[:2]  # of the base, which lies along x at rest
    assert abs(np.arctan(np.divide(*(left - right)[::-1]))) == pytest.approx(abs(angles[frame]), rel=1e-6)


def test_without_an_angle_nothing_moves(reported):
    one = reported["span-2.0"]
    kept = {key: data for key, data in one.stored.datasets.items() if key[0] not in ("predict", "rocking")}
    assert animation(reported["later"]) is animation(replace(one, stored=replace(one.stored, datasets=kept))) is None
