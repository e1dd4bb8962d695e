"""A small campaign, run once; every test works on a copy of it."""

import os
import shutil
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest

from short_campaign import Small, copied, write_campaign


@pytest.fixture(scope="session")
def undisturbed(made_once):
    """The campaign as one run in one process leaves it; it is only looked at."""
    return Small(made_once("undisturbed", lambda folder: Small(write_campaign(folder)).complete()))


@pytest.fixture
def small(undisturbed, tmp_path):
    """Copy of it."""
    return Small(copied(undisturbed.folder, tmp_path / "small"))


@pytest.fixture
def untouched(undisturbed, tmp_path):
    """Copy of it that was never run."""
    ignored = shutil.ignore_patterns("processed", "report")
    return Small(Path(shutil.copytree(undisturbed.folder, tmp_path / "small", ignore=ignored)))


@pytest.fixture
def start():
    """Start a script in a session of its own, as from a terminal, and wait for a line; what is left is killed."""
    processes = []

    def started(script, *arguments, said, **options):
        command = [sys.executable, "-c", script, *map(str, arguments)]
        options |= {"stdout": subprocess.PIPE, "text": True, "start_new_session": True}
        processes.append(subprocess.Popen(command, **options))
        assert f"{said}\n" in processes[-1].stdout
        return processes[-1]

    yield started
    for process in processes:
        with suppress(ProcessLookupError), process:
            os.killpg(process.pid, signal.SIGKILL)


@pytest.fixture
def resumes(untouched, undisturbed):
    """Hold that a run that was stopped left whole results only, and that the next one gives the undisturbed values."""

    def check():
        assert untouched.contents().items() <= undisturbed.contents().items()
        assert not untouched.run().failed
        assert untouched.contents() == undisturbed.contents()

    return check


@pytest.fixture
def in_space(small, undrawn):
    """Copy of it that is also predicted by the contact model, whose damping is given."""
    contact = 'contact = {step = "30 us", penetration = 1e-6, damping_fraction = 0.3}'
    models = f'models = ["nonlinear", "contact"]\n{contact}\n'
    small.edit("\n[setups.frame.channels]", f"\n[processing.predict]\n{models}\n[setups.frame.channels]")
    return small
