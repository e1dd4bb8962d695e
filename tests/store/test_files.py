"""Files are whole or not there, come back as they went, and say when they were damaged."""

import errno
import os
from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pytest
import xarray as xr

from colonnade.errors import StoreError
from colonnade.store import files
from colonnade.store.files import own_files


def record(values=(0.0, 1.0, np.nan)):
    return xr.Dataset(
        {"top": ("elapsed", np.array(values), {"channel": "top", "quantity": "displacement"})},
        coords={"elapsed": np.arange(3) * 0.005},
    )


def test_no_number_gets_a_fill_value_whatever_text_is_stored_before_it(tmp_path):
    dataset = xr.Dataset(
        {
            "predicted_response_order": ("model", np.array(["irregular"], dtype=object)),
            "nrmse": ("model", np.array([0.1])),
            "measured_peak_ratio": ((), np.nan),
        },
        coords={"model": np.array(["linear"], dtype=object)},
    )
    files.write(dataset, tmp_path / "compared.nc", attributes={})
    with xr.open_dataset(tmp_path / "compared.nc", mask_and_scale=False) as opened:
        assert [name for name in opened.variables if "_FillValue" in opened[name].attrs] == []
        assert opened["nrmse"].encoding["zlib"]


def test_a_failure_is_stored_with_its_reason_and_no_data(tmp_path):
    files.write_failed(tmp_path / "a.nc", "The clock runs backwards.", attributes={"stage": "ingest"})
    stored = files.read(tmp_path / "a.nc")
    assert (stored.attrs["status"], stored.attrs["reason"]) == ("failed", "The clock runs backwards.")
    assert not stored.variables


def test_a_file_that_was_cut_is_told(tmp_path):
    path = tmp_path / "a.nc"
    files.write(record(), path, attributes={})
    path.write_bytes(path.read_bytes()[:2000])
    for read in (files.read, files.read_attributes):
        with pytest.raises(StoreError, match=r"changed or damaged after colonnade wrote it\. Run `colonnade run`"):
            read(path)


def test_a_result_that_is_not_there_is_told(tmp_path):
    with pytest.raises(StoreError, match="result not found"):
        files.read(tmp_path / "a.nc")


def test_a_write_that_breaks_off_leaves_the_old_file_and_nothing_beside_it(tmp_path, monkeypatch):
    path = tmp_path / "a.nc"
    files.write(record(), path, attributes={})
    before = path.read_bytes()

    monkeypatch.setattr(os, "fsync", Mock(side_effect=KeyboardInterrupt))
    with pytest.raises(KeyboardInterrupt):
        files.write(record([3.0, 4.0, 5.0]), path, attributes={})
    assert path.read_bytes() == before
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.nc"]


@pytest.mark.parametrize(
    ("number", "said"),
    [
        (errno.ENOSPC, r"the disk is full \(.* MB free\)"),
        (errno.EROFS, "it cannot be written"),
        (errno.EIO, "Check the disk"),
    ],
)
def test_a_disk_that_refuses_is_told_in_words(tmp_path, monkeypatch, number, said):
    monkeypatch.setattr(os, "fsync", Mock(side_effect=OSError(number, os.strerror(number))))
    with pytest.raises(StoreError, match=said):
        files.write_text(tmp_path / "summary.json", "{}")
    assert list(tmp_path.iterdir()) == []


def test_text_is_written_only_where_it_differs(tmp_path):
    path = tmp_path / "summary.json"
    assert files.write_text(path, "α")
    before = path.stat().st_mtime_ns
    assert not files.write_text(path, "α")
    assert path.stat().st_mtime_ns == before
    assert files.write_text(path, "β")
    assert path.read_text(encoding="utf-8") == "β"


def test_what_a_killed_run_left_is_told_from_results(tmp_path):
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests" / ".a.nc.123.partial").write_bytes(b"half")
    (tmp_path / "tests" / "a.nc").write_bytes(b"whole")
    assert files.half_written(tmp_path) == [tmp_path / "tests" / ".a.nc.123.partial"]


@pytest.fixture
def results(tmp_path):
    """A folder of results with a file at each of three depths, an empty folder and a link to nothing."""
    folder = tmp_path / "processed"
    for name in ("summary.json", "tests/free-01/ingest.nc", "specimens/prism.nc"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(name)
    (folder / "tests" / "free-02").mkdir()
    (folder / "link").symlink_to(tmp_path / "gone")
    return folder


def test_files_at_every_depth_are_listed_and_links_to_none_but_no_folders(results):
    found = [path.relative_to(results).as_posix() for path in own_files(results)]
    assert sorted(found) == ["link", "specimens/prism.nc", "summary.json", "tests/free-01/ingest.nc"]
    assert own_files(results / "missing" / "deeper") == own_files(results / "summary.json") == []


def test_a_link_to_a_pipe_is_refused_with_where_it_leads(results):
    os.mkfifo(results.parent / "gone")
    with pytest.raises(StoreError, match=r"(?s)link: this is a link, to .*gone.*--results"):
        own_files(results)


def test_a_folder_that_is_removed_meanwhile_is_skipped_and_one_that_cannot_be_read_is_named(results, monkeypatch):
    errors, scan = {results / "tests": FileNotFoundError(2, "No such file or directory")}, os.scandir

    def scandir(path):
        if Path(path) in errors:
            raise errors[Path(path)]
        return scan(path)

    monkeypatch.setattr("colonnade.store.files.os.scandir", scandir)
    assert {path.name for path in own_files(results)} == {"summary.json", "prism.nc", "link"}
    closed = results / "specimens"
    errors[closed] = PermissionError(13, "Permission denied", str(closed))
    with pytest.raises(StoreError) as refusal:
        own_files(results)
    assert str(refusal.value).startswith(f"{closed}: this folder of results cannot be read (Permission denied).")
