"""Hundreds of free vibrations of one specimen: figures that stay small and say what all records show."""

import time

import numpy as np
import pytest

from colonnade.figures.restitution.estimators import EstimateGroup, EstimateRow
from colonnade.figures.restitution.impacts import ImpactSeries, Level, impacts_of_many
from colonnade.figures.restitution.peaks import LINES, PeakSeries, middle_of, peaks_of_many
from colonnade.figures.stored import restitution as pictures
from colonnade.identification.restitution.peaks import angle_of_energy
from prism import PRISM

LEVEL = Level(0.95, 0.949, 0.951, "e pooled")


def many(count):
    random = np.random.default_rng(7)
    peaks, impacts = [], []
    for index in range(count):
        number = np.arange(1, 31)
        energy = 0.8 * (0.95 + 0.002 * random.standard_normal()) ** (2 * number)
        angle = np.asarray(angle_of_energy(energy, PRISM.critical_angle))
        used = number < 25
        title = f"free-{index}"
        peaks.append(PeakSeries(title, angle, np.full(30, 1e-4), np.where(used, angle, np.nan), used))
        e = 0.95 + 0.01 * random.standard_normal(30)
        impacts.append(ImpactSeries(title, np.sqrt(energy), e, np.full(30, 0.01), used))
    return peaks, impacts


def test_three_hundred_records_give_figures_of_one_panel_that_do_not_grow():
    start = time.process_time()
    sizes = {}
    for count in (60, 300):
        peaks, impacts = many(count)
        drawn = (
            pictures.peaks("peaks", peaks, PRISM),
            pictures.impacts("impacts", impacts, LEVEL, PRISM.restitution),
            pictures.estimators(
                "estimators",
                [
                    EstimateGroup(f"{k}", [EstimateRow("a", 0.9, 0.8, 1.0), EstimateRow("b", 0.91, 0.9, 1.0, True)])
                    for k in range(count)
                ],
                PRISM.restitution,
            ),
        )
        assert [len(picture.figure.axes) for picture in drawn] == [1, 1, 1]
        assert all("its own page" in picture.note for picture in drawn)
        sizes[count] = [len(picture.svg) for picture in drawn]
    assert np.array(sizes[300]) == pytest.approx(np.array(sizes[60]), rel=0.2)
    assert time.process_time() - start < 30


def test_a_line_for_some_records_and_the_median_of_all():
    peaks, _ = many(300)
    axes = peaks_of_many(peaks, PRISM).axes[0]
    assert len(axes.collections[0].get_paths()) == LINES
    median = axes.lines[0].get_ydata()
    assert np.exp(np.diff(np.log(median)).mean() / 2) == pytest.approx(0.95, abs=2e-3)
    assert f"{LINES} of 300 records" in [text.get_text() for text in axes.figure.legends[0].get_texts()]


def test_the_median_of_the_impacts_is_where_they_are():
    _, impacts = many(100)
    axes = impacts_of_many(impacts, level=LEVEL, rigid=0.95).axes[0]
    assert axes.containers[0].lines[0].get_ydata() == pytest.approx(0.95, abs=0.01)


def test_classes_with_few_values_have_no_median():
    place = np.array([0.1, 0.2, 0.3, 1.5, 2.1, 2.2, 2.3, 2.4])
    found = middle_of(place, 10 * place, np.array([0.0, 1.0, 2.0, 3.0]))
    assert found.place.tolist() == [0.5, 2.5]
    assert found.median == pytest.approx([2.0, 22.5])


def test_estimates_of_many_records_are_a_row_an_estimator():
    groups = [
        EstimateGroup(
            f"free-{k}",
            [EstimateRow("fit", 0.9 + 1e-3 * k, 0.8, 1.0, True), EstimateRow("peaks", np.nan, np.nan, np.nan)],
        )
        for k in range(21)
    ]
    groups.append(EstimateGroup("all together", [EstimateRow("pooled", 0.91, 0.9, 0.92, True)]))
    picture = pictures.estimators("estimators", groups, 0.9)
    written = [text.get_text() for text in picture.figure.axes[0].texts]
    assert written[0] == "21 free vibrations"
    assert "fit (21)" in written
    assert not any("peaks" in text for text in written)
    assert "pooled" in written
