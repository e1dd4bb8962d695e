"""What is in a folder of raw files: which files are recordings, and why others are not."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from colonnade.campaign.draft.survey import survey

TIME = 0.01 * np.arange(300)


def test_files_are_in_the_order_of_their_numbers_in_all_folders(folder):
    for name in ("free-10.csv", "free-2.csv", "b/free-1.csv"):
        folder.write(name, {"LVDT 1 [mm]": np.sin(TIME)})
    assert [file.relative for file in survey(folder.path).files] == ["b/free-1.csv", "free-2.csv", "free-10.csv"]


def test_a_file_has_its_columns_rate_and_duration(folder):
    folder.write("a.csv", {"LVDT 1 [mm]": np.sin(TIME)}, delimiter=";")
    (file,) = survey(folder.path).files
    assert [(each.name, each.unit, each.is_clock) for each in file.columns] == [
        ("Time", "s", True),
        ("LVDT 1", "mm", False),
    ]
    assert (file.rate, file.duration) == (pytest.approx(100.0), pytest.approx(2.99))
    assert file.writing.startswith('delimiter ";"')


def test_files_without_headings_of_another_rate_are_of_another_layout(folder):
    folder.path.joinpath("a.csv").write_text("\n".join(f"{0.01 * n:.3f},{n % 7}.5" for n in range(200)))
    folder.path.joinpath("b.csv").write_text("\n".join(f"{0.02 * n:.3f},{n % 7}.5" for n in range(200)))
    first, second = survey(folder.path).files
    assert first.layout != second.layout


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("log.csv", "id,kind,specimen\nfree-01,sine,prism\n", "it looks like a test log; use it with tests ="),
        ("notes.dat", "nothing to see\n", ""),
    ],
)
def test_a_file_that_is_no_recording_is_refused_with_the_reason(folder, name, content, reason):
    folder.path.joinpath(name).write_text(content)
    found = survey(folder.path)
    assert found.files == ()
    assert [each for each, _ in found.refused] == [name]
    assert found.refused[0][1].startswith(reason)
    assert found.refused[0][1]


def test_documents_hidden_files_and_own_results_are_passed_over(folder):
    for name in ("readme.md", ".hidden.csv", "processed/a.csv", "report/b.csv"):
        folder.write(name, {"LVDT 1 [mm]": np.sin(TIME)})
    assert (survey(folder.path).files, survey(folder.path).refused) == ((), ())


@pytest.mark.skipif(sys.platform == "win32", reason="links need a privilege there")
def test_a_link_out_of_the_folder_is_not_followed(folder, tmp_path_factory):
    elsewhere = tmp_path_factory.mktemp("elsewhere") / "a.csv"
    elsewhere.write_text("1,2\n")
    folder.path.joinpath("a.csv").symlink_to(elsewhere)
    assert "outside the campaign's folder" in survey(folder.path).refused[0][1]


def test_progress_counts_every_file(folder):
    for name in ("a.csv", "b.csv"):
        folder.write(name, {"LVDT 1 [mm]": np.sin(TIME)})
    seen = []
    survey(folder.path, lambda done, total: seen.append((done, total)))
    assert seen == [(1, 2), (2, 2)]
