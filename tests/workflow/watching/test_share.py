"""A watched folder: what ends a wait, files copied from a share, and the command that is called for each."""

import json
import sys
import time

import pytest

from colonnade.errors import CampaignError
from colonnade.workflow.watching import measure as module
from colonnade.workflow.watching.arrivals import Arrivals, Share, listening
from colonnade.workflow.watching.measure import command_of, notify


@pytest.fixture
def share(tmp_path):
    (tmp_path / "share" / "day-1").mkdir(parents=True)
    return Share(tmp_path / "share", tmp_path / "raw", Arrivals(settle=1.0))


def twice(share, start):
    return {*share.copy_finished(start), *share.copy_finished(start + 1.5)}


def test_finished_files_are_copied_with_their_folders(share):
    (share.source / "a.csv").write_bytes(b"1;2\n")
    (share.source / "day-1" / "b.csv").write_bytes(b"3;4\n")
    assert not list(share.copy_finished(0.0))
    assert not share.target.exists()
    assert not list(share.copy_finished(1.5))
    assert (share.target / "a.csv").read_bytes() == b"1;2\n"
    assert (share.target / "day-1" / "b.csv").read_bytes() == b"3;4\n"
    assert not list(share.target.rglob("*.partial"))


def test_another_file_of_that_name_is_kept_and_said_and_the_same_is_no_problem(share):
    share.target.mkdir()
    (share.target / "a.csv").write_bytes(b"mine\n")
    (share.source / "a.csv").write_bytes(b"theirs\n")
    (said,) = twice(share, 0.0)
    assert "there already and differs" in said
    assert (share.target / "a.csv").read_bytes() == b"mine\n"
    (share.source / "a.csv").write_bytes(b"theirs again\n")
    assert twice(share, 10.0) == {said}
    (share.source / "a.csv").write_bytes(b"mine\n")
    assert not twice(share, 20.0)


def test_a_share_that_is_gone_is_said_and_may_come_back(share):
    away = share.source.rename(share.source.with_name("away"))
    assert len(twice(share, 0.0)) == 1
    away.rename(share.source)
    (share.source / "a.csv").write_bytes(b"1\n")
    assert not twice(share, 5.0)
    assert (share.target / "a.csv").exists()


def waited(wait, longest):
    began = time.monotonic()
    wait(longest)
    return time.monotonic() - began


def test_a_file_that_is_written_ends_a_wait_and_a_folder_that_gives_no_events_is_looked_at_when_it_is_due(tmp_path):
    with listening(tmp_path) as wait:
        (tmp_path / "a.csv").write_text("1\n")
        assert waited(wait, 60.0) < 30.0
    with listening(tmp_path / "none") as wait:
        assert 0.04 < waited(wait, 0.05) < 5.0


LINE = {"test": "säule-01", "outcome": "rocking"}


def test_the_line_arrives_as_json_and_no_shell_reads_the_command(tmp_path):
    script = (
        "import sys, pathlib; pathlib.Path(sys.argv[1]).write_bytes(sys.stdin.buffer.read() + sys.argv[2].encode())"
    )
    assert notify([sys.executable, "-c", script, str(tmp_path / "said"), "$(touch x)"], LINE) == ""
    text, shell = (tmp_path / "said").read_text(encoding="utf-8").split("$")
    assert (json.loads(text), shell) == (LINE, "(touch x)")


def test_a_failure_is_a_sentence_and_a_command_that_hangs_is_ended(monkeypatch):
    script = "import sys; sys.exit('no connection')"
    assert notify([sys.executable, "-c", script], LINE).endswith("non-zero exit status 1.")
    assert "No such file" in notify(["/nowhere/at-all"], LINE)
    monkeypatch.setattr(module, "PATIENCE", 0.2)
    assert "longer than 0.2 s" in notify([sys.executable, "-c", "import time; time.sleep(60)"], LINE)


@pytest.mark.parametrize("text", ["", "  ", "say 'unfinished"])
def test_what_is_no_command_is_refused(text):
    with pytest.raises(CampaignError, match="--notify"):
        command_of(text)
