"""
Vertical motion
===============

The ground also moves up and down. That changes the weight of the block from moment to moment, and with it what brings
it back. A peak may grow or shrink.
"""

import numpy as np
from matplotlib import pyplot

import colonnade

block = colonnade.Block.prism(width=0.35, depth=0.35, height=1.8, mass=500.0)
step = 0.005  # s
time = np.arange(0.0, 7.0, step)
envelope = np.sin(np.pi * time / 7.0) ** 2
along = 2.4 * envelope * np.sin(2 * np.pi * 1.4 * time)  # m/s²
upwards = 3.0 * envelope * np.sin(2 * np.pi * 3.7 * time)

with_it = colonnade.rock(block, colonnade.Motion(along, step, vertical=upwards), restitution=0.9, model="nonlinear")
without = colonnade.rock(block, colonnade.Motion(along, step), restitution=0.9, model="nonlinear")
print(f"max |θ|/α: {without.peak_ratio:.3f} without vertical motion, {with_it.peak_ratio:.3f} with it")

# %%
# The two histories part after a few impacts.

figure, axes = pyplot.subplots(layout="constrained")
axes.plot(time, without.angle / block.critical_angle, color="black", label="without vertical motion")
axes.plot(time, with_it.angle / block.critical_angle, "--", label="with vertical motion")
axes.set(xlabel="time (s)", ylabel="θ / α")
axes.legend()

# %%
# A constant vertical acceleration is the same as another gravity. That is a check of the equation of motion.

heavier = colonnade.Block.prism(width=0.35, depth=0.35, height=1.8, mass=500.0, gravity=block.gravity + 2.0)
lifted = colonnade.rock(block, colonnade.Motion(along, step, vertical=np.full(time.size, 2.0)), restitution=0.9)
in_gravity = colonnade.rock(heavier, colonnade.Motion(along, step), restitution=0.9)
difference = np.abs(lifted.angle - in_gravity.angle).max() / block.critical_angle
print(f"largest difference of θ/α: {difference:.1e}")
