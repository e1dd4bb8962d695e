"""Mistakes that people make: the first screen of `check`, and of `run`, gives the true cause before all else."""

import re
import shutil

import numpy as np
import pytest

from colonnade.campaign.channel import MAIN
from colonnade.cli import invoke
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.plan import Plan, Recorder, Trial
from colonnade.laboratory.runs import write
from colonnade.laboratory.table import recorded
from colonnade.signals.filters import lowpass
from faults.fault import TIME, TOP, both, in_campaign, in_file
from prism import PRISM
from prism import SPECIMEN as PRISM_LINE

pytestmark = pytest.mark.whole

SCREEN = 24
"""Lines."""

VOLTS = 'unit = "V", gain ='
ON_TABLE = 'range = "10 V", on = "table", direction = [1, 0, 0]'
AT = 'range = "10 V", on = "specimen", direction = [1, 0, 0], relative_to = "table", at ='
CAMPAIGN = f"""
schema = 1
campaign = "sound"
title = "Without a mistake"

[specimens]
{PRISM_LINE}

[motions]
"Valley NS" = "valley-ns.csv"

[setups.rig]

[setups.rig.channels]
top = {{column = "LVDT 1", quantity = "displacement", {VOLTS} "15 mm/V", {AT} ["43 mm", "0 mm", "440 mm"]}}
bottom = {{column = "LVDT 2", quantity = "displacement", {VOLTS} "5 mm/V", {AT} ["43 mm", "0 mm", "40 mm"]}}
table = {{column = "ACT", quantity = "displacement", {VOLTS} "5 mm/V", {ON_TABLE}}}
acceleration = {{column = "ACC", quantity = "acceleration", {VOLTS} "2 m/s^2/V", {ON_TABLE}}}
"""


def _component():
    """An earthquake of some seconds, at the model's time scale."""
    time = 0.005 * np.arange(1600)
    values = lowpass(np.random.default_rng(1).normal(size=time.size), 0.005, 12.0)
    values = (values - lowpass(values, 0.005, 1.0)) * np.exp(-(((time - 3.0) / 1.5) ** 2))
    return Motion(2.5 * PRISM.uplift_acceleration * values / np.abs(values).max(), 0.005)


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    """A free vibration and an earthquake, without a mistake."""
    folder = tmp_path_factory.mktemp("sound")
    shaken = recorded(_component(), start=1.5)
    plan = Plan(
        CAMPAIGN,
        {"prism": 0.976},
        {"rig": {MAIN: Recorder(250.0)}},
        (
            Trial("free", "free-vibration", "rig", 16.0, theta0=0.55 * PRISM.critical_angle, release=1.5),
            Trial("quake", "earthquake", "rig", shaken.stop + 2.0, table=shaken, entry={"motion": "Valley NS"}),
        ),
    )
    write(plan, folder, seed=3)
    rows = "".join(f"{0.005 * k:.3f},{value:.6f}\n" for k, value in enumerate(_component().acceleration))
    (folder / "valley-ns.csv").write_text("time (s),acceleration (m/s^2)\n" + rows, encoding="utf-8")
    return folder


def _wrap(folder):
    """The table's acceleration alone, eight numbers a row; the fourth column is taken for a channel of its own."""
    values = np.round(_component().acceleration, 5)
    rows = ["".join(f"{value:10.5f}" for value in values[first : first + 8]) for first in range(0, values.size, 8)]
    (folder / "raw" / "quake.csv").write_text("\n".join([*rows, ""]), encoding="utf-8")
    channel = 'column = 4, quantity = "acceleration", unit = "m/s^2", on = "table", direction = [1, 0, 0]'
    setup = f'[setups.logger]\nsampling_rate = "200 Hz"\n[setups.logger.channels]\nacceleration = {{{channel}}}\n\n'
    in_campaign(r"\[\[tests\]\]\nid = \"free\"", f'{setup}[[tests]]\nid = "free"')(folder)
    path = folder / "campaign.toml"
    before, quake = path.read_text(encoding="utf-8").split('id = "quake"')
    path.write_text(f'{before}id = "quake"{quake.replace("rig", "logger")}', encoding="utf-8")


def _saturated_at_the_top(samples):
    zero, noise = np.median(samples[:200, TOP]), np.random.default_rng(0).normal(0, 0.002, len(samples))
    limit = 0.8 * np.abs(samples[:, TOP] - zero).max()
    samples[:, TOP] = np.clip(samples[:, TOP], zero - limit, zero + limit) + noise
    return samples


def _in_quake(change):
    """Change the table's acceleration, V, at its times, in the earthquake's file."""

    def changed(samples):
        rest = samples[:100, -1].mean()
        samples[:, -1] = rest + change(samples[:, TIME], samples[:, -1] - rest)
        return samples

    return in_file("quake.csv", changed)


def _saturated(time, values):
    limit = 0.75 * np.abs(values).max()
    return np.clip(values, -limit, limit) + np.random.default_rng(0).normal(0, 2e-3, values.size)


MISTAKES = {
    "saturated under noise": (
        # At 80 % of the largest peak, under noise, and no range says so.
        both(
            in_campaign(r'unit = "V", gain = "15 mm/V", range = "10 V"', 'unit = "V", gain = "15 mm/V"'),
            in_file("quake.csv", _saturated_at_the_top),
        ),
        r"warning \(end of the range\): quake: channel top: .*: the channel saturates, .* Its peaks are lower bounds",
    ),
    "V for mm": (
        in_campaign(r'unit = "V", gain = "15 mm/V", range = "10 V"', 'unit = "mm"'),
        r'serious \(unit\): free: channel top: free.csv says "V" .* the campaign file says "mm"',
    ),
    "mm for m": (
        in_campaign(r'height = "456 mm"', 'height = "456 m"'),
        r"serious \(specimen\): campaign file: .* give 7.7 kg/m³; .* its lengths .mm read as m",
    ),
    "wrapped rows": (_wrap, r"quake[\s\S]*quake.csv: .*runs on from row to row"),
    "gain of the table": (
        _in_quake(lambda time, values: 0.84 * values),
        r"\(gain\): quake: .* ± .* times the se",
    ),
    "late": (
        _in_quake(lambda time, values: np.interp(time - 0.03, time, values)),
        r"\(late recorder\): quake: Channel acceleration is [\d.]+ ± \S+ ms late against what table shows",
    ),
    "saturated table": (
        _in_quake(_saturated),
        r"\(end of the range\): quake: channel acceleration: .* the channel saturates, .* Its peaks are lower bounds",
    ),
}

FREE = {"V for mm", "mm for m"}
"""What is planted in a free vibration, so that e is identified from it."""


@pytest.fixture
def first_screen(sound, tmp_path, capsys, monkeypatch):
    """Plant mistakes in a copy of the sound campaign, and give the first screen of a command."""
    monkeypatch.setenv("COLUMNS", "400")
    folder = tmp_path / "campaign"
    shutil.copytree(sound, folder)

    def of(command, *plants):
        for plant in plants:
            plant(folder)
        capsys.readouterr()
        invoke((command[0], str(folder), *command[1:]))
        return "\n".join(capsys.readouterr().out.splitlines()[:SCREEN])

    return of


@pytest.mark.parametrize("mistake", MISTAKES)
def test_the_first_screen_gives_the_true_cause(mistake, first_screen):
    plant, expected = MISTAKES[mistake]
    run = ("run", "--until", "restitution" if mistake in FREE else "condition", "--workers", "1")
    for screen in (first_screen(("check",), plant), first_screen(run)):
        assert re.search(expected, screen), screen
        found = re.search(r"^serious .*", screen, re.MULTILINE)
        assert found is None or re.search(expected, found[0]), found


def test_without_a_mistake_there_is_nothing_but_notes(sound, capsys):
    assert invoke(("check", str(sound), "--strict")) == 0
    assert "serious" not in capsys.readouterr().out
