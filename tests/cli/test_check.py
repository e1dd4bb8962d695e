"""`colonnade check` tells everything at once and writes nothing."""

from __future__ import annotations

import json


def snapshot(folder):
    return {path: path.stat().st_mtime_ns for path in folder.rglob("*")}


def test_a_good_campaign_passes_and_nothing_is_written(colonnade, campaign):
    before = snapshot(campaign)
    told = colonnade("check")
    assert (told.returncode, told.stderr) == (0, "")
    assert "free-01: good" in told.stdout
    assert told.stdout.endswith("All good; nothing was written.\n")
    assert snapshot(campaign) == before


def test_every_missing_file_and_column_is_told_with_the_nearest_name(colonnade, campaign):
    (campaign / "raw" / "free-01.csv").rename(campaign / "raw" / "free_01.csv")
    other = campaign / "raw" / "free-02.csv"
    other.write_text(other.read_text(encoding="utf-8").replace("top [mm]", "tops [mm]"), encoding="utf-8")
    told = colonnade("check")
    assert told.returncode == 1
    assert "free-01.csv: there is no such file" in told.stdout
    assert 'Did you mean "free_01.csv"?' in told.stdout
    assert 'channel top: free-02.csv: no column is called "top"' in told.stdout
    assert 'Did you mean "tops"?' in told.stdout
    assert "2 tests would fail." in told.stdout


def test_what_ingest_would_refuse_is_told_too(colonnade, campaign):
    file = campaign / "raw" / "free-02.csv"
    rows = [line.split(";")[1] for line in file.read_text(encoding="utf-8").splitlines()]
    file.write_text("\n".join(rows), encoding="utf-8")
    told = colonnade("check")
    assert told.returncode == 1
    assert "free-01: good" in told.stdout
    assert "sampling_rate" in told.stdout


def test_json_is_for_machines(colonnade, campaign):
    (campaign / "raw" / "free-02.csv").unlink()
    told = colonnade("check", "--json")
    found = json.loads(told.stdout)
    assert told.returncode == 1
    assert found["tests"]["free-01"]["problems"] == []
    assert len(found["tests"]["free-02"]["problems"]) == 1


def test_a_campaign_file_that_cannot_be_used_is_exit_code_2(colonnade, campaign):
    file = campaign / "campaign.toml"
    file.write_text(file.read_text(encoding="utf-8").replace('"86 mm", depth', '"86 mn", depth'), encoding="utf-8")
    told = colonnade("check")
    assert told.returncode == 2
    assert "specimens.prism.width" in told.stderr
    assert "Traceback" not in told.stderr
