"""The bundle of a report: whole, the same bytes wherever and whenever it is made, and nothing but the report."""

import os
import zipfile
from unittest.mock import Mock

import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.errors import StoreError
from colonnade.store.bundle import write_bundle


@given(st.dictionaries(st.sampled_from(["index.html", "tests/a.html", "data/a.js", "ü.csv"]), st.binary(max_size=3000)))
def test_it_holds_every_file_and_is_whole_when_unpacked_elsewhere(tmp_path_factory, content):
    folder = tmp_path_factory.mktemp("campaign") / "report"
    folder.mkdir()
    for name, data in content.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(data)
    target = folder.parent / "all.zip"
    write_bundle(folder, target, own=content)
    with zipfile.ZipFile(target) as archive:
        assert archive.namelist() == sorted(f"report/{name}" for name in content)
        assert {name.removeprefix("report/"): archive.read(name) for name in archive.namelist()} == content


OWN = ("tests/a.html", "index.html", "not-made-yet.html")


@pytest.fixture
def folder(tmp_path):
    folder = tmp_path / "report"
    (folder / "tests").mkdir(parents=True)
    (folder / "index.html").write_text("overview")
    (folder / "tests" / "a.html").write_text("a" * 5000)
    return folder


def test_the_same_report_gives_the_same_bytes_whatever_its_times(folder, tmp_path):
    write_bundle(folder, tmp_path / "one.zip", own=OWN)
    os.utime(folder / "index.html", (1, 1))
    (folder / "tests" / "a.html").chmod(0o600)
    write_bundle(folder, tmp_path / "two" / "other.zip", own=OWN)
    assert (tmp_path / "one.zip").read_bytes() == (tmp_path / "two" / "other.zip").read_bytes()


def test_what_is_not_of_the_report_or_leads_elsewhere_stays_out(folder, tmp_path):
    (tmp_path / "secret").write_text("secret")
    (folder / "link.html").symlink_to(tmp_path / "secret")
    (folder / ".index.html.12.partial").write_text("half")
    (folder / "salaries.xlsx").write_text("put here by somebody")
    write_bundle(folder, tmp_path / "all.zip", own=(*OWN, "link.html"))
    with zipfile.ZipFile(tmp_path / "all.zip") as archive:
        assert archive.namelist() == ["report/index.html", "report/tests/a.html"]


@pytest.mark.parametrize(
    ("name", "told"),
    [("report/all.zip", "in the report itself"), ("campaign.toml", "has to end in .zip"), ("there.zip", "is a folder")],
)
def test_a_target_that_would_do_harm_is_refused(folder, tmp_path, name, told):
    (tmp_path / "there.zip").mkdir()
    with pytest.raises(StoreError, match=told):
        write_bundle(folder, tmp_path / name, own=OWN)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["report", "there.zip"]


def test_a_bundle_that_cannot_be_finished_leaves_the_old_one(folder, tmp_path, monkeypatch):
    target = tmp_path / "all.zip"
    target.write_bytes(b"old")

    monkeypatch.setattr(zipfile.ZipFile, "open", Mock(side_effect=OSError(28, "No space left on device")))
    with pytest.raises(StoreError, match="disk is full"):
        write_bundle(folder, target, own=OWN)
    assert target.read_bytes() == b"old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["all.zip", "report"]
