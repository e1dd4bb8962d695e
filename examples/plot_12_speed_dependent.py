"""
An e that depends on speed, and one that is refused
===================================================

Fast impacts may lose more than slow ones. A law gives e over the speed of the impact; the identification sees that a
single value does not hold, and a record from which no value follows is refused with the reason.
"""

import numpy as np

import colonnade

block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
law = colonnade.RestitutionLaw([0.0, 0.2, 1.0], [0.98, 0.96, 0.90])  # rad/s, e
at_rest = colonnade.Motion(np.zeros(1500), dt=0.004)
free = colonnade.rock(block, at_rest, restitution=law, model="nonlinear", theta0=0.7 * block.critical_angle)
measured = free.angle + np.random.default_rng(1).normal(0.0, 2e-4, free.time.size)

result = colonnade.identify_restitution(free.time, measured, block)
result

# %%
# The points follow the law (grey), not a constant.

axes = colonnade.plot(result)
speed = np.linspace(0.0, result.impacts.velocity.max(), 100)
axes.plot(speed, law(speed), color="grey", label="the law")
axes.legend()
for departure in result.departures:
    print(departure.sentence)

# %%
# Cut off after the first arc, the record holds no two peaks, and so no e.

short = free.time < free.impact_times[0] + 0.05
refused = colonnade.identify_restitution(free.time[short], measured[short], block)
print(refused.value, "-", refused.reason)
