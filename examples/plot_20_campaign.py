"""
A whole campaign
================

The commands work on a folder: raw files, and a ``campaign.toml`` that says what was measured. From Python it is one
call. Results are NetCDF files that any tool opens.
"""

import json
import tempfile
from pathlib import Path

import numpy as np
import xarray
from matplotlib import pyplot

import colonnade

# %%
# A folder with one free vibration, as a recorder writes it: two transducers, in volts.

folder = Path(tempfile.mkdtemp())
block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
at_rest = colonnade.Motion(np.zeros(2000), dt=0.005)
free = colonnade.rock(block, at_rest, restitution=0.95, theta0=0.6 * block.critical_angle, model="nonlinear")
angle = np.concatenate([np.full(200, free.angle[0]), free.angle, np.zeros(200)])
edge = np.where(angle > 0, 0.043, -0.043)
volts = [((0.043 - edge) * (np.cos(angle) - 1) + z * np.sin(angle)) / 0.015 for z in (0.44, 0.04)]
volts += np.random.default_rng(1).normal(0.0, 2e-3, (2, angle.size))
table = np.column_stack([0.005 * np.arange(angle.size), *volts])
np.savetxt(folder / "free-01.csv", table, "%.5f", ",", header="Time [s],LVDT 1 [V],LVDT 2 [V]", comments="")

# %%
# What was measured, and where.

(folder / "campaign.toml").write_text(
    """
schema = 1
campaign = "gallery"
title = "One free vibration"

[specimens]
column = {shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}

[setups.frame.channels.top]
column = "LVDT 1"
quantity = "displacement"
unit = "V"
gain = "15 mm/V"
on = "specimen"
at = ["43 mm", "0 mm", "440 mm"]
direction = [1, 0, 0]
relative_to = "table"

[setups.frame.channels.foot]
column = "LVDT 2"
quantity = "displacement"
unit = "V"
gain = "15 mm/V"
on = "specimen"
at = ["43 mm", "0 mm", "40 mm"]
direction = [1, 0, 0]
relative_to = "table"

[[tests]]
id = "free-01"
kind = "free-vibration"
specimen = "column"
setup = "frame"
file = "free-01.csv"
""",
    encoding="utf-8",
)

# %%
# Run it. Without ``until`` the predictions and the report follow.

result = colonnade.run(folder, until="restitution", workers=1)
print([f"{each.stage}: {each.action}" for each in result.stages])

summary = json.loads((folder / "processed" / "summary.json").read_text(encoding="utf-8"))
e = summary["specimens"]["column"]["restitution"]
print(f"e = {e['value']:.5f}, 95 % interval {e['low']:.5f} to {e['high']:.5f}")

# %%
# Each stage is a file.

with xarray.open_dataset(folder / "processed" / "tests" / "free-01" / "rocking.nc") as rocking:
    _, axes = pyplot.subplots(layout="constrained")
    axes.plot(rocking["elapsed"], 1e3 * rocking["rocking_angle"], linewidth=0.8)
_ = axes.set(xlabel="time (s)", ylabel="θ (mrad)")
