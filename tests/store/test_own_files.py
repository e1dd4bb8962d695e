"""Only what is in a folder of results is listed; nothing is followed out of it."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from colonnade.errors import StoreError
from colonnade.store import own_files as module
from colonnade.store.own_files import own_files


@pytest.fixture
def results(tmp_path: Path) -> Path:
    """A folder of results with a file at each of three depths, and an empty folder."""
    folder = tmp_path / "processed"
    for name in ("summary.json", "tests/free-01/ingest.nc", "specimens/prism.nc"):
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(name)
    (folder / "tests" / "free-02").mkdir()
    return folder


@pytest.fixture
def elsewhere(tmp_path: Path) -> Path:
    """A folder that does not belong to the results."""
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    (folder / "thesis.txt").write_text("not to be touched")
    return folder


def names(folder: Path) -> set[str]:
    found = own_files(folder)
    assert len(found) == len(set(found))
    return {path.relative_to(folder).as_posix() for path in found}


def test_files_at_every_depth_are_listed_and_folders_are_not(results):
    assert names(results) == {"summary.json", "tests/free-01/ingest.nc", "specimens/prism.nc"}


@pytest.mark.parametrize("name", ["missing", "missing/deeper", "processed/summary.json"])
def test_what_is_not_a_folder_holds_no_files(results, name):
    assert own_files(results.parent / name) == []


def test_a_link_to_a_file_is_listed_itself(results, elsewhere):
    (results / "note.txt").symlink_to(elsewhere / "thesis.txt")
    assert results / "note.txt" in own_files(results)
    assert elsewhere / "thesis.txt" not in own_files(results)


def test_a_link_to_nothing_is_listed(results, elsewhere):
    (results / "tests" / "old.nc").symlink_to(elsewhere / "gone")
    assert "tests/old.nc" in names(results)


@pytest.mark.parametrize("place", ["link", "tests/free-02/link"])
def test_a_link_to_a_folder_is_refused_with_where_it_leads(results, elsewhere, place):
    (results / place).symlink_to(elsewhere)
    with pytest.raises(StoreError) as refusal:
        own_files(results)
    assert str(refusal.value).startswith(f"{results / place}: this is a link, to {elsewhere}.")
    assert "--results" in str(refusal.value)


def test_the_folder_itself_may_not_be_a_link(results):
    link = results.with_name("linked")
    link.symlink_to(results)
    with pytest.raises(StoreError, match="this is a link, to"):
        own_files(link)


def test_a_link_to_itself_is_refused(results):
    (results / "loop").symlink_to(results / "loop")
    with pytest.raises(StoreError, match="loop: this is a link, to"):
        own_files(results)


def test_a_pipe_is_refused_and_not_waited_for(results):
    os.mkfifo(results / "tests" / "pipe")
    with pytest.raises(StoreError, match="pipe: this is neither a file nor a folder"):
        own_files(results)


def test_a_link_to_a_pipe_is_refused(results, elsewhere):
    os.mkfifo(elsewhere / "pipe")
    (results / "pipe").symlink_to(elsewhere / "pipe")
    with pytest.raises(StoreError, match="pipe: this is a link, to"):
        own_files(results)


def failing_in(monkeypatch: pytest.MonkeyPatch, folder: Path, error: OSError) -> None:
    scan = os.scandir

    def scandir(path):
        if Path(path) == folder:
            raise error
        return scan(path)

    monkeypatch.setattr(module.os, "scandir", scandir)


def test_a_folder_that_is_removed_meanwhile_is_skipped(results, monkeypatch):
    failing_in(monkeypatch, results / "tests", FileNotFoundError(2, "No such file or directory"))
    assert names(results) == {"summary.json", "specimens/prism.nc"}


def test_a_folder_that_cannot_be_read_is_named_with_the_reason(results, monkeypatch):
    closed = results / "specimens"
    failing_in(monkeypatch, closed, PermissionError(13, "Permission denied", str(closed)))
    with pytest.raises(StoreError) as refusal:
        own_files(results)
    assert str(refusal.value).startswith(f"{closed}: this folder of results cannot be read (Permission denied).")
