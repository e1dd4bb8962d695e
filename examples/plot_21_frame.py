"""
Columns under a beam
====================

Two columns of a gate, alone and under a lintel of four times their mass. The beam lies on the columns without any
bond, and yet they are harder to overturn with it: together they rock as one larger column.
"""

import numpy as np
from matplotlib import pyplot

import colonnade

column = colonnade.Block.prism(width=1.0, depth=1.0, height=6.0, mass=15_000.0)
gate = colonnade.Block.frame(column, beam_mass=120_000.0, columns=2)
for name, block in (("a column", column), ("the gate", gate)):
    print(f"{name}: α {block.critical_angle:.3f} rad, p {block.p:.3f} rad/s, rigid-body e {block.restitution:.3f}")

# %%
# Uplift begins at the same acceleration. A sine pulse of 1.2 s overturns the column alone; the gate comes back.

step = 0.005  # s
pulse = 1.6 * column.uplift_acceleration * np.sin(2 * np.pi * np.arange(0.0, 1.2 + step, step) / 1.2)
motion = colonnade.Motion(np.concatenate([pulse, np.zeros(1200)]), step)
alone = colonnade.rock(column, motion, model="nonlinear")
together = colonnade.rock(gate, motion, model="nonlinear")
print(f"a column: {alone.outcome}; the gate: {together.outcome}, max |θ|/α = {together.peak_ratio:.2f}")

# %%
# The amplitude from which a sine pulse overturns, over its frequency: that of the gate is higher throughout.

frequency = np.linspace(0.3, 1.0, 15)  # Hz
figure, (first, second) = pyplot.subplots(2, 1, layout="constrained", figsize=(6.4, 5.6))
for block, history, style, name in ((column, alone, "-", "a column"), (gate, together, "--", "the gate")):
    first.plot(history.time, history.angle / block.critical_angle, style, label=name)
    limits = colonnade.overturning_spectrum(
        block, "sine", frequency_ratio=2 * np.pi * frequency / block.p, model="nonlinear", largest=12.0, width=0.05
    )
    second.plot(frequency, limits.lower, style, label=name)
first.set(xlabel="time (s)", ylabel="θ / α", ylim=(-1.5, 1.5))
second.set(xlabel="frequency of the pulse (Hz)", ylabel="a / (g tan α) that overturns")
for axes in (first, second):
    axes.legend()
