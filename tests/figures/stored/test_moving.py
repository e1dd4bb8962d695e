"""The moving block of a stored test: who moves, and on what."""

from __future__ import annotations

from dataclasses import replace

import pytest

from colonnade.figures.stored.moving import animation


@pytest.fixture
def moving(filled_campaign, known):
    def of(name, *, without=()):
        test, _, stored, block = known(name)
        kept = {key: data for key, data in stored.datasets.items() if key[0] not in without}
        return animation(test, filled_campaign[0].specimens[test.specimen], replace(stored, datasets=kept), block)

    return of


def named(movie) -> list[str]:
    (legend,) = movie.figure.legends
    return [text.get_text() for text in legend.get_texts()]


def test_measured_and_each_model_move(moving):
    movie = moving("span-2.0")
    assert named(movie) == ["measured", "linear model", "nonlinear model"]
    assert movie.title == "span-2.0: the rocking block"
    assert movie.description.startswith("measured and predicted, on ")


def test_what_was_measured_alone_is_said_to_be(moving):
    movie = moving("span-2.0", without=("predict",))
    assert named(movie) == ["measured"]
    assert movie.description.startswith("measured, on ")


def test_without_an_angle_nothing_moves(moving):
    assert moving("later") is None
    assert moving("span-2.0", without=("predict", "rocking")) is None
