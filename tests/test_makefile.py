"""Its targets are those that texts name; which interpreter `make` takes, by stand-ins on a PATH with nothing else."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

PROJECT = Path(__file__).parents[1]
MAKEFILE = (PROJECT / "Makefile").read_text(encoding="utf-8")
TARGETS = re.search(r"^\.PHONY: (.*)$", MAKEFILE, re.MULTILINE)[1].split()
TEXTS = [
    *PROJECT.glob("*.md"),
    *(path for room in ("docs", "reports", "tests", "tools") for path in (PROJECT / room).rglob("*.[mp][dy]")),
    *(PROJECT / name for name in ("pyproject.toml", ".ci/run")),
]

pytestmark = pytest.mark.skipif(shutil.which("make") is None, reason="there is no make here")

ABSENT_BUT_SHIMMED = "exit 127\n"
TOO_OLD_OR_WITHOUT_VENV = '[ "$1" = "--version" ] && echo "Python 3.9.6" && exit 0\nexit 1\n'
FITTING = """
case "$1" in
  --version) echo "Python 3.12.9" ;;
  -c) exit 0 ;;
  -m) echo "$*" >> calls
      if [ "$2" = venv ]; then mkdir -p .venv/bin; cp "$0" .venv/bin/python; fi ;;
esac
"""


def test_there_are_few_targets_and_each_is_described():
    assert len(TARGETS) <= 12
    assert re.findall(r"^# make ([\w-]+)", MAKEFILE, re.MULTILINE) == TARGETS


def test_every_target_that_a_text_names_is_there():
    named = {
        (word, str(path.relative_to(PROJECT)))
        for path in TEXTS
        if "build" not in path.parts
        for word in re.findall(r"`make ([a-z][\w-]*)", path.read_text(encoding="utf-8"))
    }
    assert {word for word, _ in named} >= {"demo", "test", "test-all", "slow", "study", "reports"}
    assert sorted(each for each in named if each[0] not in TARGETS) == []


@pytest.fixture
def clone(tmp_path):
    """Folder with Makefile and pyproject.toml, and beside it a PATH of the few tools that they use."""
    folder, tools = tmp_path / "clone", tmp_path / "tools"
    folder.mkdir()
    tools.mkdir()
    for name in ("Makefile", "pyproject.toml"):
        shutil.copy(PROJECT / name, folder)
    for tool in ("make", "sh", "touch", "mkdir", "cp"):
        (tools / tool).symlink_to(shutil.which(tool))
    return folder


def add_interpreter(clone, name, script):
    path = clone.parent / "tools" / name
    path.write_text(f"#!/bin/sh\n{script}", encoding="utf-8")
    path.chmod(0o755)


def make(clone, *targets, **more):
    environment = {"PATH": str(clone.parent / "tools"), "HOME": str(clone), **more}
    return subprocess.run(["make", *targets], cwd=clone, env=environment, capture_output=True, text=True)


def test_an_interpreter_that_does_not_run_is_passed_over(clone):
    add_interpreter(clone, "python3.14", ABSENT_BUT_SHIMMED)
    add_interpreter(clone, "python3.13", TOO_OLD_OR_WITHOUT_VENV)
    add_interpreter(clone, "python3", FITTING)
    told = make(clone, ".venv/installed")
    assert told.returncode == 0, told.stderr
    assert "Making .venv with python3 (Python 3.12.9)" in told.stdout
    assert (clone / "calls").read_text().splitlines() == [
        "-m venv --clear .venv",
        "-m pip install --quiet --disable-pip-version-check --no-compile --editable .[demo,test]",
    ]


def test_without_a_fitting_interpreter_one_line_to_type_is_printed(clone):
    add_interpreter(clone, "python3", TOO_OLD_OR_WITHOUT_VENV)
    add_interpreter(clone, "dnf", "")
    told = make(clone, "demo")
    assert told.returncode != 0
    assert [line for line in told.stdout.splitlines() if line.startswith("  ")] == ["  sudo dnf install python3.13"]
    assert not (clone / ".venv").exists()


def test_all_tests_are_those_of_every_day_and_the_whole_ones(clone):
    add_interpreter(clone, "python3.12", FITTING)
    [daily], [whole] = (
        [line for line in make(clone, "-n", target).stdout.splitlines() if "-m pytest" in line]
        for target in ("test", "test-all")
    )
    assert whole == f'{daily} -m "not slow and not drill"'
    for target in ("test", "test-all"):
        assert {".venv/bin/ruff check", ".venv/bin/mypy", ".venv/bin/lint-imports"} <= set(
            make(clone, "-n", target).stdout.splitlines()
        )
