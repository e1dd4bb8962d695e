"""What is in a folder of raw files: which are recordings, why others are not, and what their signals look like."""

import sys

import numpy as np
import pytest

from colonnade.campaign.draft.survey import look_at, steady_sine, survey
from colonnade.readers.recording import RecordedChannel

TIME = 0.01 * np.arange(300)
LONG = np.arange(0.0, 12.0, 0.005)
NOISE = np.random.default_rng(3).normal(size=LONG.size)


def looked_at(values, time):
    return look_at(1, RecordedChannel("top", "mm", values, time))


def test_files_are_in_the_order_of_their_numbers_in_all_folders(folder):
    for name in ("free-10.csv", "free-2.csv", "b/free-1.csv"):
        folder.write(name, {"LVDT 1 [mm]": np.sin(TIME)})
    assert [file.relative for file in survey(folder.path)[0]] == ["b/free-1.csv", "free-2.csv", "free-10.csv"]


def test_a_file_has_its_columns_rate_and_duration(folder):
    folder.write("a.csv", {"LVDT 1 [mm]": np.sin(TIME)}, delimiter=";")
    (file,) = survey(folder.path)[0]
    columns = [(each.name, each.unit, each.is_clock) for each in file.columns]
    assert columns == [("Time", "s", True), ("LVDT 1", "mm", False)]
    assert (file.rate, file.duration) == (pytest.approx(100.0), pytest.approx(2.99))


def test_files_without_headings_of_another_rate_are_of_another_layout(folder):
    folder.path.joinpath("a.csv").write_text("\n".join(f"{0.01 * n:.3f},{n % 7}.5" for n in range(200)))
    folder.path.joinpath("b.csv").write_text("\n".join(f"{0.02 * n:.3f},{n % 7}.5" for n in range(200)))
    first, second = survey(folder.path)[0]
    assert first.layout != second.layout


def test_documents_hidden_files_and_own_results_are_passed_over(folder):
    for name in ("readme.md", ".hidden.csv", "processed/a.csv", "report/b.csv"):
        folder.write(name, {"LVDT 1 [mm]": np.sin(TIME)})
    assert survey(folder.path) == ([], [])


@pytest.mark.skipif(sys.platform == "win32", reason="links need a privilege there")
def test_a_link_out_of_the_folder_is_not_followed(folder, tmp_path_factory):
    elsewhere = tmp_path_factory.mktemp("elsewhere") / "a.csv"
    elsewhere.write_text("1,2\n")
    folder.path.joinpath("a.csv").symlink_to(elsewhere)
    assert "outside the campaign's folder" in survey(folder.path)[1][0][1]


def test_progress_counts_every_file(folder):
    for name in ("a.csv", "b.csv"):
        folder.write(name, {"LVDT 1 [mm]": np.sin(TIME)})
    seen = []
    survey(folder.path, lambda done, total: seen.append((done, total)))
    assert seen == [(1, 2), (2, 2)]


@pytest.mark.parametrize("frequency", [0.7, 1.0, 3.3, 7.0])
@pytest.mark.parametrize("noise", [0.0, 0.2], ids=["clean", "noisy"])
def test_a_steady_sine_is_seen_with_its_frequency_also_between_rests(frequency, noise):
    signal = np.where((LONG > 2) & (LONG < 10), np.sin(2 * np.pi * frequency * LONG), 0.0) + noise * NOISE
    assert steady_sine(signal, 0.005) == pytest.approx(frequency, rel=0.02)


@pytest.mark.parametrize(
    "signal",
    [
        pytest.param(NOISE, id="noise"),
        pytest.param(np.sin(2 * np.pi * 3 * LONG) * (np.abs(LONG - 6) < 0.2), id="pulse"),
        pytest.param(np.sin(2 * np.pi * (0.5 + LONG) * LONG), id="sweep"),
        pytest.param(LONG, id="ramp"),
    ],
)
def test_what_is_no_steady_sine_is_not_taken_for_one(signal):
    assert steady_sine(signal, 0.005) is None


def test_a_free_vibration_dies_away_and_a_sine_does_not():
    decay = np.where(LONG < 8, np.exp(-0.6 * LONG) * np.cos(9 * LONG), 0.0)
    assert looked_at(decay, LONG).dies_away
    assert not looked_at(np.sin(9 * LONG), LONG).dies_away


@pytest.mark.parametrize(
    "values", [np.full(50, 3.0), np.full(50, np.nan), np.empty(0)], ids=["constant", "missing", "empty"]
)
def test_what_never_changes_is_dead(values):
    assert not looked_at(values, None).spread > 0.0


def test_a_running_number_counts_and_a_clock_does_not():
    assert looked_at(np.arange(50.0), None).counts
    assert not looked_at(np.arange(50.0) / 50, None).counts


def test_values_too_large_to_square_are_no_accident():
    assert looked_at(np.array([1e300, -1e300] * 40), np.arange(80.0)).sine is None
