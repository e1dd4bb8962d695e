"""The group of all commands, and those that answer in few lines."""

from colonnade.cli.app import COMMANDS, app


def test_commands_are_listed_in_the_order_in_which_they_are_met(colonnade):
    told = colonnade("--help").stdout
    places = [told.index(f"│ {command.name} ") for command in COMMANDS]
    assert places == sorted(places)
    assert list(app.commands) == [command.name for command in COMMANDS]
    assert all(command.get_short_help_str(200).rstrip(".") for command in COMMANDS)


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
