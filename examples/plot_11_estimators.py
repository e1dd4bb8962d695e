"""
e of a block that is not exactly known
======================================

The interval of e covers what is not known of the block: here the table is tilted by a tenth of a degree, which the
estimator allows for and names. A line through the peaks is the cross-check.
"""

import numpy as np
from matplotlib import pyplot

import colonnade

block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
at_rest = colonnade.Motion(np.zeros(2500), dt=0.004)
tilt = np.deg2rad(0.1)
tilted = block.override(critical_angle=(block.critical_angle - tilt, block.critical_angle + tilt))
truth = 0.976

results = {}
for name, body in (("level table", block), ("table tilted by 0.1°", tilted)):
    free = colonnade.rock(body, at_rest, restitution=truth, model="nonlinear", theta0=0.5 * block.critical_angle)
    measured = free.angle + np.random.default_rng(1).normal(0.0, 1e-3, free.time.size)
    results[name] = colonnade.identify_restitution(free.time, measured, block)

# %%
# A bold point is the value given. A record without one says why in ``result.reason``.

figure, panels = pyplot.subplots(1, 2, layout="constrained", figsize=(8.0, 3.2), sharey=True)
for axes, (name, result) in zip(panels, results.items(), strict=True):
    for row, each in enumerate(result.estimates):
        if each.value is not None:
            width = [[each.value - each.low], [each.high - each.value]]
            bold = each.name == result.recommended
            axes.errorbar(each.value, row, xerr=width, fmt="o", color="black", markersize=7 if bold else 3, capsize=3)
    axes.axvline(truth, color="grey", linewidth=0.8)
    axes.set(title=name, xlabel="e")
    axes.locator_params(axis="x", nbins=3)
    axes.set_yticks(range(len(result.estimates)), [each.name for each in result.estimates])

# %%
# What departs from plane rocking with one e is named, with its size. Here it is the tilt.

for name, result in results.items():
    print(f"{name}: {result}")
    for departure in result.departures:
        print(f"  {departure.name}: {departure.sentence}")
