"""Commands, and a small campaign to run them on."""

import os
import subprocess
import sys
from typing import NamedTuple

import pytest

from colonnade.cli import invoke
from colonnade.cli.common import console


class Told(NamedTuple):
    """What a command left behind."""

    returncode: int
    stdout: str
    stderr: str


@pytest.fixture
def colonnade(tmp_path, monkeypatch, capsys):
    """Run a command in this process, in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")
    monkeypatch.setattr(console, "EVERY", float("inf"))  # a slow machine prints lines of progress

    def run(*arguments):
        capsys.readouterr()
        return Told(invoke(arguments), *capsys.readouterr())

    return run


@pytest.fixture
def process(tmp_path):
    """Run a command in a process of its own, as a person or a script meets it."""

    def run(*arguments, **environment):
        told = subprocess.run(
            [sys.executable, "-m", "colonnade", *arguments],
            cwd=tmp_path,
            env={**os.environ, "COLUMNS": "100", **environment},
            capture_output=True,
            encoding="utf-8",
            timeout=300,
        )
        return Told(told.returncode, told.stdout, told.stderr)

    return run


@pytest.fixture
def campaign(tmp_path):
    """A campaign of two free vibrations, computed with e = 0.95, one file with commas and one with semicolons."""
    import numpy as np

    from colonnade import rock
    from colonnade.dynamics.kinematics import point_displacement
    from prism import PRISM, TOP, campaign_of, entry
    from short_campaign import write_columns

    history = rock(PRISM, theta0=0.4 * PRISM.critical_angle, restitution=0.95, model="nonlinear", duration=12.0)
    time = np.arange(0.0, 12.0, 0.005)
    angle = np.interp(time, history.time, history.angle)
    top = 1000 * point_displacement(angle, (0.043, 0.0, 0.440), PRISM)[0, :, 0]
    random = np.random.default_rng(1)
    (tmp_path / "raw").mkdir()
    for name, delimiter in (("free-01", ","), ("free-02", ";")):
        columns = {"Time [s]": time, "top [mm]": top + random.normal(0.0, 0.01, time.size)}
        write_columns(tmp_path / "raw" / f"{name}.csv", columns, delimiter)
    tests = entry("free-01", "free-vibration") + entry("free-02", "free-vibration")
    (tmp_path / "campaign.toml").write_text(campaign_of(TOP, tests=tests))
    return tmp_path


@pytest.fixture
def changed(campaign):
    """Put a text in place of another, wherever it is in a file of the campaign."""

    def change(name, before, after):
        text = (campaign / name).read_text(encoding="utf-8")
        assert before in text
        (campaign / name).write_text(text.replace(before, after), encoding="utf-8")

    return change


@pytest.fixture
def with_gain(changed):
    """Give the only transducer a gain."""
    return lambda gain: changed("campaign.toml", 'unit = "mm"', f'unit = "mm", gain = "{gain}"')
