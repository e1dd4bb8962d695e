"""The virtual campaign of the reproduction: the demo's programme, the paper's three levels at 3 Hz, three models."""

from __future__ import annotations

from dataclasses import replace
from math import pi
from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import FILE_NAME, load
from colonnade.cli.common.console import complain, work_progress
from colonnade.cli.run import run_with_progress
from colonnade.dynamics.motion import Motion
from colonnade.laboratory import paper_programme, write_campaign
from colonnade.laboratory.plan import Plan
from colonnade.laboratory.programme import COLUMNS, LADDERS, LASTING, RAMP, sine
from colonnade.store.files import write_text
from colonnade.store.layout import Layout
from colonnade.workflow.executors import Where
from colonnade.workflow.maps import Wanted, make_maps
from reproduction.printed import FREQUENCIES, SHOWN, SHOWN_FREQUENCY, TABLE_1

SEED = 0
SPECIMEN = "prism"

ANALYTICAL, PLANE, NUMERICAL = "linear", "nonlinear", "contact"
"""Our models: that of the paper's own program, that of the virtual table's truth, and the one nearest to its finite
elements."""

STEP = "10 us"
"""Of the contact model, as in the paper. A rigid body's e changes by 1e-5 from it to half of it."""

SETTINGS = f"""
# Added for the reproduction: the contact model is the nearest to the paper's finite elements.
[processing.predict]
models = ["{ANALYTICAL}", "{PLANE}", "{NUMERICAL}"]

[processing.predict.contact]
step = "{STEP}"
"""

CYCLES, MAP_RAMP = 20, RAMP
"""Of the sine of all maps, as the tests' ramps; the paper does not give its own."""

MAP_LEVELS = (0.8, 5.0)
"""A of the maps of all three models."""

MAP_POINTS = 49
"""Levels of these maps at each of the tests' frequencies."""


def programme(name: str, record: Motion, *, seed: int = SEED) -> Plan:
    """Plan the demo's programme and, at its end, the histories that the paper shows and the demo leaves out."""
    plan = paper_programme(name, record, seed=seed)
    block, table = load(COLUMNS).block(SPECIMEN), f"{SPECIMEN}-table"
    missing = [level for level in SHOWN if level not in LADDERS["prism"][SHOWN_FREQUENCY]]
    added = (
        sine(block, f"sine-{SHOWN_FREQUENCY:g}Hz-{level:.2f}", SHOWN_FREQUENCY, level, cycles=LASTING, ramp=RAMP)
        for level in missing
    )
    return replace(plan, trials=(*plan.trials, *(replace(each, setup=table, specimen=SPECIMEN) for each in added)))


def frequency_ratios(count: int) -> Array:
    """Give so many Ω from the lowest to the highest frequency of the sine tests, shape (count,)."""
    first, last = (2 * pi * frequency / TABLE_1[SPECIMEN].block.p for frequency in (FREQUENCIES[0], FREQUENCIES[-1]))
    return np.linspace(first, last, count)


def perform(folder: Path, workers: int | None = None) -> Path:
    """Write the campaign, run it and make the maps of the prism; what is up to date stays. Return campaign.toml."""
    path = folder / FILE_NAME
    complain(f"Shaking the virtual table into {folder}")
    write_campaign(folder, seed=SEED, programme=programme, workers=workers)
    write_text(path, path.read_text(encoding="utf-8") + SETTINGS)
    result = run_with_progress(path, workers=workers)
    if result.failed:
        raise SystemExit(f"{path}: tests failed. Look at {folder / 'report' / 'index.html'}.")
    first, *_, last = frequency_ratios(len(FREQUENCIES)).tolist()
    points = (len(FREQUENCIES), MAP_POINTS)
    asked = {"omega": (first, last), "amplitude": MAP_LEVELS, "points": points, "cycles": CYCLES, "ramp": MAP_RAMP}
    wanted, campaign = Wanted(models=(ANALYTICAL, PLANE, NUMERICAL), **asked), load(path)
    with work_progress("Mapping by all models") as progress:
        make_maps(campaign, Layout(folder), wanted, (SPECIMEN,), Where(workers, progress=progress))
    return path
