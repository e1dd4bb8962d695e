"""A small campaign, run once; every test works on a copy of it."""

from __future__ import annotations

import hashlib
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.workflow import RunResult, run

CAMPAIGN = """\
schema = 1
campaign = "small"
title = "A small campaign"

[specimens]
prism = {shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}

[setups.frame.channels]
top = {column = "top", quantity = "displacement", unit = "mm", on = "specimen", at = ["43 mm", "0 mm", "440 mm"], \
direction = [1, 0, 0], relative_to = "table"}
table = {column = "table", quantity = "acceleration", unit = "m/s^2", on = "table", direction = [1, 0, 0]}

"""
TESTS = {"free-01": "free-vibration", "free-02": "free-vibration", "pulse-01": "pulse", "pulse-02": "pulse"}
BLOCK = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
RATE = 200.0


def write_campaign(folder: Path, tests: dict[str, str] = TESTS) -> Path:
    """Write the campaign and its raw files; the folder is returned."""
    (folder / "raw").mkdir(parents=True)
    text = CAMPAIGN
    for number, (name, kind) in enumerate(tests.items()):
        text += f'[[tests]]\nid = "{name}"\nkind = "{kind}"\nspecimen = "prism"\nsetup = "frame"\nfile = "raw/{name}.csv"\n\n'
        _write_raw(folder / "raw" / f"{name}.csv", kind, number)
    (folder / "campaign.toml").write_text(text, encoding="utf-8")
    return folder


def _write_raw(path: Path, kind: str, number: int) -> None:
    noise = np.random.default_rng(number)
    time = np.arange(0.0, 8.0, 1 / RATE)
    base = np.zeros_like(time)
    if kind == "free-vibration":
        angle = rock(BLOCK, Motion(base, 1 / RATE), restitution=0.93, theta0=0.5 * BLOCK.critical_angle).angle
    else:
        base = np.where((time > 1.0) & (time < 1.3), (2.4 + 0.2 * number) * np.sin((time - 1.0) * 2 * np.pi / 0.3), 0.0)
        angle = rock(BLOCK, Motion(base, 1 / RATE), restitution=0.93).angle
    top = 440 * np.sin(angle) + 0.01 * noise.standard_normal(time.size)
    table = base + 0.002 * noise.standard_normal(time.size)
    rows = np.column_stack((time, top, table))
    np.savetxt(path, rows, delimiter=",", header="time,top,table", comments="", fmt="%.6f")


@pytest.fixture(scope="session")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the campaign as one run in one process leaves it."""
    folder = write_campaign(tmp_path_factory.mktemp("undisturbed") / "small")
    assert not run(folder, workers=1).failed
    return folder


@pytest.fixture
def folder(undisturbed: Path, tmp_path: Path) -> Path:
    """Copy of it, with the files' times."""
    return Path(shutil.copytree(undisturbed, tmp_path / "small"))


def files_of(folder: Path) -> dict[str, tuple[int, str]]:
    """Time and hash of every file but the lock."""
    return {
        path.relative_to(folder).as_posix(): (path.stat().st_mtime_ns, hashlib.sha256(path.read_bytes()).hexdigest())
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name != ".lock"
    }


def executed(result: RunResult) -> dict[tuple[str, str], str]:
    """Stages that were executed, with the reason."""
    return {(stage.subject, stage.stage): stage.because for stage in result.stages if stage.because}


def change_a_sample(path: Path, line: int = 300) -> None:
    """Add 0.1 mm to one sample of the transducer."""
    lines = path.read_text(encoding="utf-8").splitlines()
    time, top, table = lines[line].split(",")
    lines[line] = f"{time},{float(top) + 0.1:.6f},{table}"
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def edit(folder: Path, change: Callable[[str], str]) -> None:
    """Change campaign.toml."""
    path = folder / "campaign.toml"
    path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")
