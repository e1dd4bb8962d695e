"""A command gets each line as JSON on its stdin; whatever it does, the watch goes on."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from colonnade.errors import CampaignError
from colonnade.workflow.watching import notify as module
from colonnade.workflow.watching.notify import command_of, notify

LINE = {"test": "säule-01", "outcome": "rocking"}


def test_the_line_arrives_as_json(tmp_path: Path) -> None:
    script = "import sys, pathlib; pathlib.Path(sys.argv[1]).write_bytes(sys.stdin.buffer.read())"
    assert notify([sys.executable, "-c", script, str(tmp_path / "said")], LINE) == ""
    assert json.loads((tmp_path / "said").read_text(encoding="utf-8")) == LINE


def test_no_shell_reads_the_command(tmp_path: Path) -> None:
    script = "import sys, pathlib; pathlib.Path(sys.argv[1]).write_text(sys.argv[2])"
    notify([sys.executable, "-c", script, str(tmp_path / "said"), "$(touch x); *"], LINE)
    assert (tmp_path / "said").read_text() == "$(touch x); *"


def test_a_failure_is_a_sentence() -> None:
    script = "import sys; sys.exit('no connection')"
    assert notify([sys.executable, "-c", script], LINE) == f"{sys.executable} ended with 1: no connection."
    assert "could not be started" in notify(["/nowhere/at-all"], LINE)


def test_a_command_that_hangs_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "PATIENCE", 0.2)
    assert "longer than 0.2 s" in notify([sys.executable, "-c", "import time; time.sleep(60)"], LINE)


@pytest.mark.parametrize("text", ["", "  ", "say 'unfinished"])
def test_what_is_no_command_is_refused(text: str) -> None:
    with pytest.raises(CampaignError, match="--notify"):
        command_of(text)
