"""How the command ends: its exit code, quietly where its reader goes away, and tidily where it is interrupted."""

import os
import signal
import subprocess
import sys
import time
from unittest.mock import Mock

import pytest

from colonnade.cli import invoke
from colonnade.cli.app import COMMANDS, app
from every import every
from processes import started, wait_until

pytestmark = pytest.mark.whole

posix = pytest.mark.skipif(os.name == "nt", reason="signals of this kind are POSIX's")


@pytest.mark.smoke
def test_a_process_ends_with_the_code_of_its_command_and_help_is_a_success(process):
    told = process("--help")
    assert (told.returncode, told.stderr) == (0, "")
    assert [process(*arguments).returncode for arguments in ((), ("rnu",))] == [2, 2]


@pytest.mark.parametrize("command", [command.name for command in COMMANDS])
def test_every_command_has_help_with_an_example(colonnade, command):
    told = colonnade(command, "--help")
    assert told.returncode == 0
    if command == "show":
        told = colonnade(command, "tests", "--help")
    assert f"Example: colonnade {command}" in told.stdout


@pytest.mark.smoke
@every(
    ("arguments", "code", "said"),
    [
        (("rnu",), 2, 'Did you mean "run"?'),
        (("show", "demo"), 2, 'Choose one of: "tests", "specimens", "settings", "formats".'),
        (("run", "--form", "predict"), 2, "--form"),
        (("run", "--from", "prediction"), 2, "prediction"),
        (("run", "--workers", "0"), 2, "x>=1"),
        (("run", "nowhere"), 2, "campaign.toml"),
        (("init",), 2, "it exists already and was not changed"),
        (("init", "nowhere"), 2, "nowhere"),
        (("report", "--no-appendix"), 2, "add --pdf"),
        (("demo", "--motion", "record.txt"), 2, "record.txt"),
        (("init", "empty"), 2, "empty"),
        (("demo", "."), 2, "was not written by the virtual laboratory"),
        (("next",), 1, "Run `colonnade run` first"),
        (("schema", "report"), 2, "report"),
        (("show", "tests", "fre-01"), 2, 'Did you mean "free-01"?'),
        (("show", "tests", ".", "free-01", "free-02"), 2, "Usage"),
        (("map", "--specimen", "prysm"), 2, 'Did you mean "prism"?'),
        (("map", "--scheduler", "nowhere"), 1, "nowhere: no Dask scheduler answers there"),
        (("map", "--model", "liner"), 2, "'liner' is not one of 'linear', 'nonlinear', 'contact'"),
    ],
)
def test_what_cannot_be_done_is_said_and_leaves_campaign_files(colonnade, campaign, arguments, code, said):
    (campaign / "empty").mkdir(exist_ok=True)
    (campaign / "record.txt").write_text("no number here\n", encoding="utf-8")
    before = {path: path.read_bytes() for path in campaign.rglob("*.toml")}
    told = colonnade(*arguments)
    assert told.returncode == code
    assert said in " ".join(told.stderr.split())
    assert "Traceback" not in told.stderr
    assert {path: path.read_bytes() for path in campaign.rglob("*.toml")} == before


@posix
@pytest.mark.parametrize(
    ("rest", "said"),
    [("| head -n 1; echo ${PIPESTATUS[0]}", "{\n0\n"), (">&-", ""), (">&- 2>&-", "")],
    ids=["a reader that goes away", "closed output", "closed output and error"],
)
def test_a_stream_that_nobody_reads_is_no_error(tmp_path, rest, said):
    command = f"{sys.executable} -m colonnade schema campaign {rest}"
    told = subprocess.run(["bash", "-c", command], cwd=tmp_path, capture_output=True, encoding="utf-8")
    assert (told.returncode, told.stdout, told.stderr) == (0, said, "")


def test_too_little_memory_is_a_sentence_and_a_bug_a_traceback(monkeypatch, capsys):
    monkeypatch.setattr(app, "main", Mock(side_effect=MemoryError()))
    assert invoke(()) == 1
    assert capsys.readouterr().err.startswith("The machine ran out of memory.")
    monkeypatch.setattr(app, "main", Mock(side_effect=ImportError("x")))
    with pytest.raises(ImportError, match="x"):
        invoke(())


def test_a_console_without_greek_letters_gets_question_marks(process, campaign):
    told = process("show", "specimens", PYTHONIOENCODING="ascii:strict", PYTHONUTF8="0")
    assert told.returncode == 0
    assert "? rad" in told.stdout


@posix
@pytest.mark.parametrize(
    ("send", "sent"),
    [
        pytest.param("killpg", signal.SIGINT, id="Ctrl-C reaches the workers too"),
        pytest.param("kill", signal.SIGTERM, id="a polite kill reaches the parent alone"),
    ],
)
@pytest.mark.usefixtures("interruptible")
def test_an_interrupted_run_is_130_and_the_next_one_ends_it(colonnade, campaign, send, sent):
    running = started("run", "--workers", "2", cwd=campaign, start_new_session=True)
    wait_until((campaign / "processed").exists)
    time.sleep(0.5)
    getattr(os, send)(running.pid, sent)
    _, complaints = running.communicate(timeout=60)
    assert running.returncode == 130
    assert "Interrupted" in complaints
    assert "Traceback" not in complaints
    assert colonnade("run", "--workers", "1").returncode == 0


@posix
@pytest.mark.usefixtures("interruptible")
def test_ending_a_watch_is_no_error(campaign):
    watching = started("watch", "--workers", "1", cwd=campaign)
    wait_until((campaign / "report" / "state.js").exists)
    watching.send_signal(signal.SIGHUP)
    _, complaints = watching.communicate(timeout=60)
    assert (watching.returncode, complaints) == (0, "The watch has ended. All results are kept.\n")


def test_a_watch_that_is_interrupted_before_its_one_round_is_130(colonnade, campaign, monkeypatch):
    from colonnade.workflow.watching import watch

    monkeypatch.setattr(watch, "watch", Mock(side_effect=KeyboardInterrupt))
    assert [colonnade("watch", *once).returncode for once in ((), ("--once",))] == [0, 130]


HEAD = "import os, signal, time\nfrom colonnade import cli, interruption\n"
KILLED = "os.kill(os.getpid(), signal.SIGTERM); time.sleep(9)"
FINALISER = f"""
class Handle:
    def __del__(self):
        {KILLED}
"""
COMPILED = f"""
def compiled(*_, **__):
    try:
        {KILLED}
    except KeyboardInterrupt as error:
        raise ImportError("initialization failed") from error
"""
CALLBACK = f"""
import ctypes

@ctypes.CFUNCTYPE(None)
def back():
    {KILLED}
"""


def ended(tmp_path, *script):
    """Run a script that is interrupted from within; return how it ended."""
    path = tmp_path / "interrupted.py"
    path.write_text("\n".join((HEAD, *script)))
    return subprocess.run([sys.executable, path], cwd=tmp_path, capture_output=True, encoding="utf-8", timeout=60)


DROPPED_WITHIN_THE_WATCH = f"""{FINALISER}
def until_dropped(*_, **__):
    Handle()
    interruption.expect_none()

complain, watching.watch = run.complain, until_dropped
run.complain = lambda sentence: (time.sleep(0.5), complain(sentence))
"""


@posix
@pytest.mark.parametrize(
    "watched", [DROPPED_WITHIN_THE_WATCH, f"{COMPILED}\nwatching.watch = compiled"], ids=["dropped", "import"]
)
def test_a_signal_ends_a_watch_once_wherever_it_falls(tmp_path, watched):
    imports = "from colonnade.cli import run\nfrom colonnade.workflow.watching import watch as watching"
    told = ended(tmp_path, imports, watched, 'cli.main(["watch"])')
    assert (told.returncode, told.stderr) == (0, "The watch has ended. All results are kept.\n")


@posix
@pytest.mark.parametrize(
    ("defined", "done"),
    [
        pytest.param(FINALISER, "Handle()", id="within a finaliser, where Python drops the exception"),
        pytest.param(CALLBACK, "back()", id="within a callback of a compiled library, where Python drops it too"),
        pytest.param("", f'exec("{KILLED}")', id="within exec of a text, where Python would end by SIGINT"),
        pytest.param(COMPILED, "compiled()", id="within a compiled module, which makes an ImportError of it"),
    ],
)
def test_an_interrupt_wherever_it_falls_is_130(tmp_path, defined, done):
    invoke = f"def invoke(arguments):\n    {done}\n    time.sleep(30)\n"
    told = ended(tmp_path, defined, invoke, "cli.invoke = invoke", "cli.main()")
    assert told.returncode == 130
    assert "Traceback" not in told.stderr
    assert "ignored" not in told.stderr
