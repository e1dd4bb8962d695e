"""How the command ends: its exit code, quietly where its reader goes away, and tidily where it is interrupted."""

import os
import signal
import subprocess
import sys
import time

import pytest

from colonnade.cli import invoke
from colonnade.cli.app import COMMANDS, app


def test_help_is_a_success(process):
    told = process("--help")
    assert (told.returncode, told.stderr) == (0, "")


@pytest.mark.parametrize("command", [command.name for command in COMMANDS])
def test_every_command_has_help_with_an_example(colonnade, command):
    told = colonnade(command, "--help")
    assert told.returncode == 0
    if command == "show":
        told = colonnade(command, "tests", "--help")
    assert f"Example: colonnade {command}" in told.stdout


@pytest.mark.parametrize("arguments", [("rnu",), ("run", "--form", "predict"), ("run", "--from", "prediction"), ()])
def test_wrong_usage_is_exit_code_2(process, arguments):
    told = process(*arguments)
    assert told.returncode == 2
    assert "Traceback" not in told.stderr


def test_a_mistyped_command_is_answered_with_the_nearest(process):
    assert "Did you mean 'run'" in process("rnu").stderr


def test_a_missing_campaign_is_exit_code_2(process):
    told = process("run", "nowhere")
    assert told.returncode == 2
    assert "campaign.toml" in told.stderr


def test_a_reader_that_goes_away_is_no_error(tmp_path):
    command = f"{sys.executable} -m colonnade schema campaign | head -n 1; echo ${{PIPESTATUS[0]}}"
    told = subprocess.run(["bash", "-c", command], cwd=tmp_path, capture_output=True, encoding="utf-8")
    assert told.stdout == "{\n0\n"
    assert told.stderr == ""


@pytest.mark.skipif(os.name == "nt", reason="a shell that closes a stream")
@pytest.mark.parametrize("closed", [">&-", ">&- 2>&-"])
def test_nobody_reads_a_closed_stream_and_that_is_no_error(tmp_path, closed):
    command = f"{sys.executable} -m colonnade schema campaign {closed}"
    told = subprocess.run(["bash", "-c", command], cwd=tmp_path, capture_output=True, encoding="utf-8")
    assert (told.returncode, told.stdout, told.stderr) == (0, "", "")


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (MemoryError(), 1),
        (ImportError("libx.so: failed to map segment from shared object"), 1),
        (ImportError("x"), None),
    ],
)
def test_too_little_memory_is_a_sentence_and_a_bug_a_traceback(monkeypatch, capsys, error, code):
    def fail(*_, **__):
        raise error

    monkeypatch.setattr(app, "main", fail)
    if code is None:
        with pytest.raises(ImportError, match="x"):
            invoke(())
        return
    assert invoke(()) == code
    assert capsys.readouterr().err.startswith("The machine ran out of memory.")


def test_a_console_without_greek_letters_gets_question_marks(process, campaign):
    told = process("show", "specimens", PYTHONIOENCODING="ascii:strict", PYTHONUTF8="0")
    assert told.returncode == 0
    assert "? rad" in told.stdout


@pytest.mark.skipif(os.name == "nt", reason="signals of this kind are POSIX's")
@pytest.mark.parametrize(
    ("send", "sent"),
    [
        pytest.param("killpg", signal.SIGINT, id="Ctrl-C reaches the workers too", marks=pytest.mark.whole),
        pytest.param("kill", signal.SIGTERM, id="a polite kill reaches the parent alone", marks=pytest.mark.whole),
        pytest.param(
            "killpg",
            getattr(signal, "SIGHUP", 0),
            id="a terminal that closes reaches the workers too",
            marks=pytest.mark.whole,
        ),
    ],
)
@pytest.mark.usefixtures("interruptible")
def test_an_interrupted_run_is_130_and_the_next_one_ends_it(colonnade, campaign, send, sent):
    running = subprocess.Popen(
        [sys.executable, "-m", "colonnade", "run", "--workers", "2"],
        cwd=campaign,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        start_new_session=True,
    )
    deadline = time.monotonic() + 60.0
    while not (campaign / "processed").is_dir() and time.monotonic() < deadline:
        time.sleep(0.01)
    time.sleep(0.5)
    getattr(os, send)(running.pid, sent)
    _, complaints = running.communicate(timeout=60)
    assert running.returncode == 130
    assert "Interrupted" in complaints
    assert "Traceback" not in complaints
    assert colonnade("run", "--workers", "1").returncode == 0


@pytest.mark.skipif(os.name == "nt", reason="signals of this kind are POSIX's")
@pytest.mark.usefixtures("interruptible")
def test_ending_a_watch_is_no_error(campaign):
    watching = subprocess.Popen(
        [sys.executable, "-m", "colonnade", "watch", "--workers", "1"],
        cwd=campaign,
        stderr=subprocess.PIPE,
        encoding="utf-8",
    )
    deadline = time.monotonic() + 60.0
    while not (campaign / "processed" / ".watcher.json").exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    watching.send_signal(signal.SIGHUP)
    _, complaints = watching.communicate(timeout=60)
    assert (watching.returncode, complaints) == (0, "The watch has ended. All results are kept.\n")


def test_a_watch_that_is_interrupted_before_its_one_round_is_130(colonnade, campaign, monkeypatch):
    from colonnade.workflow.watching import watch

    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(watch, "watch", interrupted)
    assert [colonnade("watch", *once).returncode for once in ((), ("--once",))] == [0, 130]


INSIDE_EXEC = """
def invoke(arguments):
    exec("os.kill(os.getpid(), signal.SIGTERM); time.sleep(9)")
"""
INSIDE_COMPILED_MODULE = """
def invoke(arguments):
    try:
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(9)
    except KeyboardInterrupt as error:
        raise ImportError("initialization failed") from error
"""


INSIDE_FINALISER = """
class Handle:
    def __del__(self):
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(9)

def invoke(arguments):
    Handle()
    time.sleep(30)
    return 0
"""
INSIDE_CALLBACK = """
import ctypes

@ctypes.CFUNCTYPE(None)
def back():
    os.kill(os.getpid(), signal.SIGTERM)
    time.sleep(9)

def invoke(arguments):
    back()
    time.sleep(30)
    return 0
"""


@pytest.mark.skipif(os.name == "nt", reason="signals of this kind are POSIX's")
@pytest.mark.parametrize(
    "invoke",
    [
        pytest.param(INSIDE_FINALISER, id="within a finaliser, where Python drops the exception"),
        pytest.param(INSIDE_CALLBACK, id="within a callback of a compiled library, where Python drops it too"),
        pytest.param(INSIDE_EXEC, id="within exec of a text, where Python would end by SIGINT"),
        pytest.param(INSIDE_COMPILED_MODULE, id="within a compiled module, which makes an ImportError of it"),
    ],
)
def test_an_interrupt_wherever_it_falls_is_130(tmp_path, invoke):
    (tmp_path / "interrupted.py").write_text(
        f"import os, signal, time\nfrom colonnade import cli\n{invoke}\ncli.invoke = invoke\ncli.main()\n"
    )
    ended = subprocess.run(
        [sys.executable, "-m", "interrupted"], cwd=tmp_path, capture_output=True, encoding="utf-8", timeout=60
    )
    assert ended.returncode == 130
    assert "Traceback" not in ended.stderr
    assert "ignored" not in ended.stderr
