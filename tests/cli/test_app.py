"""The group of all commands, and those that answer in few lines."""


def test_a_folder_with_other_files_is_left_alone(colonnade, campaign):
    (campaign / "campaign.toml").unlink()
    told = colonnade("demo", ".")
    assert (told.returncode, "contains other files" in told.stderr) == (2, True)
    assert sorted(path.name for path in campaign.rglob("*")) == ["free-01.csv", "free-02.csv", "raw"]


def test_a_record_that_cannot_be_read_is_told_without_a_traceback(colonnade, tmp_path):
    (tmp_path / "record.txt").write_text("no number here\n", encoding="utf-8")
    told = colonnade("demo", "--motion", "record.txt")
    assert told.returncode == 2
    assert "record.txt" in told.stderr
    assert "Traceback" not in told.stderr
