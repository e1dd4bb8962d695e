"""Ids that every file system can hold and tell apart; paths that may not leave the campaign's folder."""

import contextlib

import pytest

from colonnade.campaign.syntax.names import clashes, identifier, inside
from every import every


@pytest.mark.parametrize("name", ["free-01", "span-2.0", "A", "0", "a_b", "console", "x" * 100])
def test_an_id_passes(name):
    assert identifier(name) == name


@every("name", ["", "a b", "-a", ".a", "ä", "a/b", "a\n", "con", "CON.csv", "Lpt1", "aux", "x" * 101, 3, None, ["a"]])
def test_what_a_file_system_does_not_hold_fails(name):
    with pytest.raises(ValueError, match=r"cannot be an id|cannot be a file name|An id in quotes"):
        identifier(name)


def test_ids_that_differ_by_case_or_a_last_dot_clash():
    assert clashes(["a", "b", "A", "b."]) == [(2, "A", "a"), (3, "b.", "b")]


def test_ids_that_become_the_same_variable_clash_only_there():
    assert clashes(["a-1", "a.1"]) == []
    assert clashes(["a-1", "a.1", "a_2"], as_variables=True) == [(1, "a.1", "a-1")]


@pytest.mark.parametrize("written", ["raw/a.csv", "a.csv", "raw/../a.csv", "./raw/ä b.csv"])
def test_a_path_inside_the_folder_passes(written, tmp_path):
    folder = tmp_path.resolve()
    assert inside(folder, written) == (folder / written).resolve()


@pytest.mark.parametrize(
    "written",
    ["../a.csv", "raw/../../a.csv", "/etc/passwd", "C:/a.csv", "C:a.csv", "raw\\a.csv", "", " ", ".", "a\0b", 3, None],
)
def test_a_path_out_of_the_folder_fails(written, tmp_path):
    with pytest.raises(ValueError, match="A path from the folder of the campaign file was expected"):
        inside(tmp_path.resolve(), written)


def test_a_link_out_of_the_folder_fails_and_one_inside_passes(tmp_path):
    folder = (tmp_path / "campaign").resolve()
    (folder / "raw").mkdir(parents=True)
    (tmp_path / "elsewhere").mkdir()
    (folder / "away").symlink_to(tmp_path / "elsewhere")
    (folder / "near").symlink_to(folder / "raw")
    assert inside(folder, "near/a.csv") == folder / "raw" / "a.csv"
    with pytest.raises(ValueError, match=r"is outside the campaign's folder: .*elsewhere"):
        inside(folder, "away/a.csv")


def test_links_in_a_circle_are_followed_to_no_end(tmp_path):
    folder = tmp_path.resolve()
    (folder / "one").symlink_to(folder / "other")
    (folder / "other").symlink_to(folder / "one")
    with contextlib.suppress(ValueError):  # Python before 3.13 refuses to resolve it, later ones do not follow it
        assert inside(folder, "one").is_relative_to(folder)
