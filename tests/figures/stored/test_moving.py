"""The moving block of a stored test: who moves, and on what."""

from dataclasses import replace

import numpy as np
import pytest

from colonnade.figures.moving import animation
from colonnade.figures.stored.record import measured_ratio


@pytest.fixture
def moving(filled_campaign, known):
    def of(name, *, without=()):
        test, _, stored, block = known(name)
        kept = {key: data for key, data in stored.datasets.items() if key[0] not in without}
        return animation(test, filled_campaign[0].specimens[test.specimen], replace(stored, datasets=kept), block)

    return of


def named(movie):
    (legend,) = movie.figure.legends
    return [text.get_text() for text in legend.get_texts()]


def test_measured_and_each_model_move(moving):
    movie = moving("span-2.0")
    assert named(movie) == ["measured", "linear model", "nonlinear model"]
    assert movie.title == "span-2.0: the rocking block"
    assert movie.description == "measured and predicted; base: recorded acceleration integrated twice."


def test_what_was_measured_alone_is_said_to_be(moving):
    movie = moving("span-2.0", without=("predict",))
    assert named(movie) == ["measured"]
    assert movie.description.startswith("measured; base: ")


def test_without_an_angle_nothing_moves(moving):
    assert moving("later") is None
    assert moving("span-2.0", without=("predict", "rocking")) is None


def test_it_shows_what_the_page_shows_the_zero_taken_off_on_a_base_that_moves(filled_campaign, known):
    test, _, stored, block = known("span-2.0")
    compared = stored.datasets["compare", None].assign(zero_offset=0.02)
    stored = replace(stored, datasets=stored.datasets | {("compare", None): compared})
    movie = animation(test, filled_campaign[0].specimens[test.specimen], stored, block)
    times, ratio = measured_ratio(stored, block)
    frame = int(np.nanargmax(np.interp(np.linspace(times[0], times[-1], movie.frames), times, ratio)))
    movie.show(frame)
    lower = movie.figure.axes[0].patches[0].get_xy()[:2]
    leaned = np.arctan2(*(lower[0] - lower[1])[::-1]) - np.pi  # of the base's edge, which lies along x at rest
    expected = np.interp(np.linspace(times[0], times[-1], movie.frames), times, ratio * block.critical_angle_at(ratio))
    assert abs(np.angle(np.exp(1j * leaned))) == pytest.approx(abs(expected[frame]), rel=1e-6)
    (table,) = movie.figure.axes[0].lines
    places = []
    for each in range(movie.frames):
        movie.show(each)
        places.append(table.get_xdata()[0])
    assert 1e-4 < np.ptp(places) < 0.5
