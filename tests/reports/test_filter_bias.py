"""The document on the low-pass says what the program gives today."""

import re
from pathlib import Path

import pytest

import filter_bias

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
