"""The document on the estimators says what the program gives today."""

from __future__ import annotations

from pathlib import Path

import pytest

import linear_bias

PROJECT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def measured():
    return linear_bias.measure((0.85,), (3.0, 6.0, 12.0), (0.4,))


def test_the_documents_figures_are_those_of_the_program(measured):
    text = linear_bias.DOCUMENT.read_text(encoding="utf-8")
    own = text.split(f"Bias of the whole history by the linear model, e = {measured[0].restitution:g}:")[1]
    column = linear_bias.RELEASES.index(measured[0].release) + 2
    for bias in measured:
        row = next(line for line in own.splitlines() if line.startswith(f"| {bias.slenderness:g} |"))
        assert float(row.split("|")[column]) == pytest.approx(bias.by_estimator[linear_bias.LINEAR], abs=2e-5)


def test_the_linear_models_bias_falls_with_the_square_of_the_slenderness(measured):
    stocky, middle, slender = (bias.by_estimator[linear_bias.LINEAR] for bias in measured)
    assert stocky > middle > slender > 0
    assert stocky / middle == pytest.approx(4, rel=0.15)
    assert middle / slender == pytest.approx(4, rel=0.15)


@pytest.mark.parametrize("name", ["peaks", "half-periods", "impact-by-impact", "history-nonlinear"])
def test_the_other_estimators_have_none(measured, name):
    for bias in measured:
        assert abs(bias.by_estimator[name]) < 1e-4
        assert abs(bias.by_estimator[name]) < 0.5 * abs(bias.by_estimator[linear_bias.LINEAR])
