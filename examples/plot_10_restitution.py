"""
Coefficient of restitution from a free vibration
================================================

Plain arrays in, e with its interval out. The record is simulated here, so that the truth is known; time and angle may
as well be your own.
"""

import numpy as np
from matplotlib import pyplot

import colonnade

block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
at_rest = colonnade.Motion(np.zeros(2500), dt=0.004)
truth = 0.976
free = colonnade.rock(block, at_rest, restitution=truth, model="nonlinear", theta0=0.5 * block.critical_angle)
noise = np.random.default_rng(1).normal(0.0, 1e-3, free.time.size)  # rad
measured = free.angle + noise + 3e-4  # with a zero that is a little off

result = colonnade.identify_restitution(free.time, measured, block)
result

# %%
# Nothing holds the value to that of a rigid body without bounce, which is usually lower.

print(f"e = {result.value:.5f}, 95 % interval {result.low:.5f} to {result.high:.5f}; truth {truth}")
print(f"rigid body: {block.restitution:.4f}; zero offset {1e3 * result.zero_offset:.2f} mrad")

# %%
# e of each impact over the speed with which the block meets the table, and the value of the whole record.

axes = colonnade.plot(result)

# %%
# The fitted history, and what it leaves: noise, and nothing else.

fitted = result.history
figure, (first, second) = pyplot.subplots(2, 1, layout="constrained", figsize=(6.4, 4.8), sharex=True)
first.plot(free.time, measured / block.critical_angle, color="black", linewidth=0.8, label="measured")
first.plot(fitted.time, fitted.angle / block.critical_angle, "--", linewidth=0.8, label="fitted")
first.set(ylabel="θ / α")
first.legend(loc="upper right")
second.plot(fitted.time, 1e3 * fitted.residual, color="black", linewidth=0.5)
_ = second.set(xlabel="time (s)", ylabel="residual (mrad)")
