"""Finished files of a share are copied, checked by their hash, and never over another file."""

from __future__ import annotations

from pathlib import Path

import pytest

from colonnade.workflow.watching.arrivals import Arrivals
from colonnade.workflow.watching.share import Share


@pytest.fixture
def share(tmp_path: Path) -> Share:
    (tmp_path / "share" / "day-1").mkdir(parents=True)
    return Share(tmp_path / "share", tmp_path / "raw", Arrivals(settle=1.0))


def twice(share: Share, start: float) -> list[str]:
    return [*share.copy_finished(start), *share.copy_finished(start + 1.5)]


def test_finished_files_are_copied_with_their_folders(share: Share) -> None:
    (share.source / "a.csv").write_bytes(b"1;2\n")
    (share.source / "day-1" / "b.csv").write_bytes(b"3;4\n")
    assert not list(share.copy_finished(0.0))
    assert not share.target.exists()
    assert not list(share.copy_finished(1.5))
    assert (share.target / "a.csv").read_bytes() == b"1;2\n"
    assert (share.target / "day-1" / "b.csv").read_bytes() == b"3;4\n"
    assert not list(share.target.rglob("*.partial"))


def test_another_file_of_that_name_is_kept_and_said_once(share: Share) -> None:
    share.target.mkdir()
    (share.target / "a.csv").write_bytes(b"mine\n")
    (share.source / "a.csv").write_bytes(b"theirs\n")
    (said,) = twice(share, 0.0)
    assert "there already and differs" in said
    assert (share.target / "a.csv").read_bytes() == b"mine\n"
    (share.source / "a.csv").write_bytes(b"theirs again\n")
    assert not twice(share, 10.0)


def test_the_same_file_is_no_problem(share: Share) -> None:
    share.target.mkdir()
    for folder in (share.source, share.target):
        (folder / "a.csv").write_bytes(b"same\n")
    assert not twice(share, 0.0)


def test_a_share_that_is_gone_is_said_once_and_may_come_back(share: Share) -> None:
    away = share.source.rename(share.source.with_name("away"))
    assert len(twice(share, 0.0)) == 1
    away.rename(share.source)
    (share.source / "a.csv").write_bytes(b"1\n")
    assert not twice(share, 5.0)
    assert (share.target / "a.csv").exists()
