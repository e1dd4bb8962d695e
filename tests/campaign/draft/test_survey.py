"""What is in a folder of raw files: which are recordings, and why others are not."""

import sys

import numpy as np
import pytest

from colonnade.campaign.draft.survey import look_at, survey
from colonnade.readers.recording import RecordedChannel

TIME = 0.01 * np.arange(300)


def looked_at(values, time):
    return look_at(1, RecordedChannel("top", "mm", values, time))


def test_files_are_in_the_order_of_their_numbers_in_all_folders(folder):
    for name in ("free-10.csv", "free-2.csv", "b/free-1.csv"):
        folder.write(name, {"LVDT 1 [mm]": np.sin(TIME)})
    assert [file.relative for file in survey(folder.path)[0]] == ["b/free-1.csv", "free-2.csv", "free-10.csv"]


def test_a_file_has_its_columns(folder):
    folder.write("a.csv", {"LVDT 1 [mm]": np.sin(TIME)}, delimiter=";")
    (file,) = survey(folder.path)[0]
    columns = [(each.name, each.unit, each.is_clock) for each in file.columns]
    assert columns == [("Time", "s", True), ("LVDT 1", "mm", False)]


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


@pytest.mark.parametrize(
    "values", [np.full(50, 3.0), np.full(50, np.nan), np.empty(0)], ids=["constant", "missing", "empty"]
)
def test_what_never_changes_is_dead(values):
    assert not looked_at(values, None).spread > 0.0
