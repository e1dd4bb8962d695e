"""The documents on the low-pass and on the linear model say what the program gives today."""

import re
from pathlib import Path

import pytest

import filter_bias
import linear_bias

PROJECT = Path(__file__).resolve().parents[2]
RATE, RESTITUTION = 200.0, 0.976


def _row(text, cutoff):
    cells = re.search(rf"\| {RATE:g} \| {RESTITUTION:g} \| {cutoff} \|(.*)\|", text)[1].split("|")
    return [float("nan") if cell.strip() == "refused" else float(cell.strip(" %")) for cell in cells]


def test_the_biases_are_those_of_the_document_and_those_of_the_default_are_small():
    text = (PROJECT / "docs" / "explanation" / "filter.md").read_text(encoding="utf-8")
    low, default = filter_bias.measure((RATE,), (RESTITUTION,), (5.0,))
    for bias, cutoff in ((low, "5"), (default, r"\*\*34.9\*\* \(default\)")):
        *peaks, restitution = _row(text, cutoff)
        assert [100 * value for value in bias.peaks] == pytest.approx(peaks, abs=5e-3)
        assert bias.restitution == pytest.approx(restitution, abs=1e-4, nan_ok=True)
    assert max(map(abs, default.peaks)) < 1e-4
    assert abs(default.restitution) < 1e-4
    assert max(map(abs, low.peaks)) > 1e-2


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


@pytest.mark.parametrize("name", ["peaks", "impact-by-impact", "history-nonlinear"])
def test_the_other_estimators_have_none(measured, name):
    for bias in measured:
        assert abs(bias.by_estimator[name]) < 1e-4
        assert abs(bias.by_estimator[name]) < 0.5 * abs(bias.by_estimator[linear_bias.LINEAR])
