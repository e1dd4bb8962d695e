"""The drill: what a laboratory's machines do to a run. Its scripts are started as processes of their own."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from colonnade.cli import invoke
from short_campaign import Small, write_campaign

HERE = Path(__file__).parent
TESTS = {"free-01": "free-vibration", "pulse-01": "pulse", "pulse-02": "pulse"}
ONE_MODEL = '[processing.predict]\nmodels = ["linear"]\n'
SIZE = "20m"
"""Of the file system that fills."""


@pytest.fixture(scope="session")
def undisturbed(tmp_path_factory):
    """A campaign of three tests as one run in one process leaves it; it is only looked at."""
    small = Small(write_campaign(tmp_path_factory.mktemp("undisturbed") / "small", TESTS))
    small.edit("[processing.predict.ensemble]", f"{ONE_MODEL}\n[processing.predict.ensemble]")
    small.complete()
    return small


@pytest.fixture
def copied(undisturbed):
    """Copy it to a folder, with its results or without."""

    def copy(folder, *, with_results=False):
        ignored = None if with_results else shutil.ignore_patterns("processed", "report")
        return Small(Path(shutil.copytree(undisturbed.folder, folder, ignore=ignored)))

    return copy


@pytest.fixture
def command(capfd):
    """Run a command in this process; its exit code and all it said. An exception passes: it would be a traceback."""

    def run(*arguments):
        capfd.readouterr()
        code = invoke([str(argument) for argument in arguments])
        told = capfd.readouterr()
        assert "Traceback" not in told.err
        return code, told.out + told.err

    return run


@pytest.fixture
def small_disk(tmp_path):
    """A file system of 20 MB."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mount("-t", "tmpfs", "-o", f"size={SIZE}", "tmpfs", folder)
    yield folder
    subprocess.run(["umount", folder], check=True, timeout=60)


def mount(*arguments):
    """Mount, or skip the test with the system's reason."""
    if shutil.which("mount") is None:
        pytest.skip("there is no command `mount` here")
    told = subprocess.run(
        ["mount", *map(str, arguments)], capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL
    )
    if told.returncode:
        pytest.skip(f"a file system may not be mounted here: {told.stderr.strip()}")


@pytest.fixture
def read_only(tmp_path, request):
    """Copy a folder to where nothing may be written; the root user needs a file system for that."""

    def lock(folder):
        if os.geteuid() == 0:
            disk = request.getfixturevalue("small_disk")
            inside = Path(shutil.copytree(folder, disk / folder.name))
            mount("-o", "remount,ro", disk)
            return inside
        inside = Path(shutil.copytree(folder, tmp_path / "locked"))
        places = [inside, *(path for path in inside.rglob("*") if path.is_dir())]
        for place in places:
            place.chmod(0o555)
        request.addfinalizer(lambda: [place.chmod(0o755) for place in places])
        return inside

    return lock
