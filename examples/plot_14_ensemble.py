"""
Spread of a prediction, and its horizon
=======================================

Nothing is known exactly: e has an interval, the block is not quite what the drawing says, the accelerometer has a
calibration. Run a motion many times over these, and see how long the prediction is worth something.
"""

import numpy as np

import colonnade

block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
time = np.arange(0.0, 6.0, 0.005)
motion = colonnade.Motion(2.7 * np.sin(np.pi * time / 6.0) ** 2 * np.sin(2 * np.pi * 3.0 * time), 0.005)
uncertainty = colonnade.Uncertainty(restitution=0.005, critical_angle=0.01, p=0.005, gain=0.01, noise=0.02)
spread = colonnade.ensemble(block, motion, restitution=0.93, uncertainty=uncertainty, count=300)
spread

# %%
# The horizon is the time from which the band of 95 % is wider than half of the critical angle.

horizon = spread.horizon(0.5 * block.critical_angle)
axes = colonnade.plot(spread)
axes.axvline(horizon, color="grey", linewidth=0.8)
axes.set_ylim(-1.2 * block.critical_angle, 1.2 * block.critical_angle)
print(f"horizon: {horizon:.2f} s of {time[-1]:.2f} s")
print(f"{100 * spread.overturning_probability:.1f} % of the runs overturn")
