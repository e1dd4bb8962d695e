"""
Forces on the base, and the friction they need
==============================================

A model of pure rocking holds only while the block does not slide or hop. From a history follow the forces of the base,
the friction that they need at each moment, and the time from which the assumption does not hold.
"""

import numpy as np
from matplotlib import pyplot

import colonnade

block = colonnade.Block.prism(width=0.4, depth=0.4, height=1.2, mass=450.0)
step = 0.002
time = np.arange(0.0, 5.0, step)
motion = colonnade.Motion(4.6 * np.sin(np.pi * time / 5.0) ** 2 * np.sin(2 * np.pi * 1.4 * time), step)
history = colonnade.rock(block, motion, restitution=0.85, model="nonlinear")
forces = colonnade.reactions(history, motion)
broken = time[forces.required_friction > 0.3]
print(f"largest friction between impacts: {forces.required_friction.max():.3f}")
print(f"with a coefficient of 0.3 it would slide or hop from {broken[0]:.3f} s on")

# %%
# While the block stands, the friction is that of the table's acceleration, :math:`|a|/g`. Once it rocks, the centre of
# mass swings as well. Impacts (dots) need a friction of their own, (1 − e) / ((1 + e) tan α): between jumps of the
# forces, and whatever the speed.

figure, (first, second, third) = pyplot.subplots(3, 1, layout="constrained", figsize=(6.4, 6.4), sharex=True)
first.plot(time, history.angle / block.critical_angle)
first.set(ylabel="θ / α")
second.plot(time, forces.vertical / (block.mass * block.gravity), label="vertical")
second.plot(time, forces.horizontal / (block.mass * block.gravity), "--", label="horizontal")
second.set(ylabel="force / weight")
second.legend(loc="upper left")
third.plot(time, forces.required_friction, label="between impacts")
third.plot(forces.impact_times, forces.impact_friction, "k.", label="at impacts")
third.axhline(0.3, color="grey", linewidth=0.8)
third.set(xlabel="time (s)", ylabel="friction needed", ylim=(0.0, 0.5))
_ = third.legend(loc="upper left")
