"""
Two heights, the same slenderness
=================================

Two blocks of one shape: a model, and a column twenty times as large. One and the same pulse overturns the model and
hardly moves the column. Slenderness alone does not say what stands.
"""

import numpy as np
from matplotlib import pyplot

import colonnade

scale = 20.0
model = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
column = colonnade.Block.prism(width=1.72, depth=1.72, height=9.12, mass=26.10 * scale**3)
print(f"α: {model.critical_angle:.4f} and {column.critical_angle:.4f} rad; p: {model.p:.3f} and {column.p:.3f} rad/s")

# %%
# A sine pulse of 0.6 s and 3.5 m/s² on both.

step = 0.002  # s
pulse = 3.5 * np.sin(2 * np.pi * np.arange(0.0, 0.6 + step, step) / 0.6)
acceleration = np.concatenate([pulse, np.zeros(1200)])
motion = colonnade.Motion(acceleration, step)
small = colonnade.rock(model, motion, restitution=0.9, model="nonlinear")
large = colonnade.rock(column, motion, restitution=0.9, model="nonlinear")
print(f"model: {small.outcome} at {small.overturning_time:.2f} s; column: max |θ|/α = {large.peak_ratio:.3f}")

# %%
# Time scales with the root of the size. Stretched by √20 the pulse does to the column, step for step, what it did to
# the model.

stretched = colonnade.Motion(acceleration, step * np.sqrt(scale))
alike = colonnade.rock(column, stretched, restitution=0.9, model="nonlinear")

figure, (first, second) = pyplot.subplots(2, 1, layout="constrained", figsize=(6.4, 5.2))
for history, style, name in ((small, "-", "model"), (large, "--", "column, the same pulse")):
    first.plot(history.time, history.angle / model.critical_angle, style, label=name)
second.plot(small.time, small.angle / model.critical_angle, label="model")
second.plot(alike.time / np.sqrt(scale), alike.angle / column.critical_angle, "--", label="column, pulse √20 as long")
second.set(xlabel="time (s), of the column over √20")
for axes in (first, second):
    axes.set(ylabel="θ / α", ylim=(-1.5, 1.5))
    axes.legend()
