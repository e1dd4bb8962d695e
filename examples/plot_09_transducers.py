"""
From transducers to the rocking angle
=====================================

Two displacement transducers watch a block, one near its top, one near its foot. Each sees a point that moves on a
circle about an edge, and the edge changes at every impact. The fit uses the finite rotation, not a tangent.
"""

import numpy as np
from matplotlib import pyplot

import colonnade

block = colonnade.Block.prism(width=0.4, depth=0.4, height=1.2, mass=450.0)
history = colonnade.rock(block, theta0=0.9 * block.critical_angle, restitution=0.9, duration=6.0, model="nonlinear")
truth = history.angle

# %%
# What two transducers on the face at x = 0.2 m would measure: 0.1 mm of noise, and a cable that was loose for 0.2 s.

at = np.array([[0.2, 0.0, 1.1], [0.2, 0.0, 0.1]])  # m; origin at the centre of the base
direction = np.array([[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
edge = np.where(truth > 0, 0.2, -0.2)  # the block turns about the edge that it leans to
moved = [edge + (x - edge) * np.cos(truth) + z * np.sin(truth) - x for x, _, z in at]
readings = np.array(moved) + np.random.default_rng(1).normal(0.0, 1e-4, (2, truth.size))
readings[1, (history.time > 2.0) & (history.time < 2.2)] = np.nan

angle = colonnade.rocking_angle(readings, at, direction, block)
by_tangent = np.arctan((readings[0] - readings[1]) / 1.0)  # over the distance of the two, m
exact = colonnade.rocking_angle(moved, at, direction, block)
print(f"without noise the angle is recovered to {np.abs(exact - truth).max():.1e} rad")
print(f"with noise its error is {1e3 * np.nanstd(angle - truth):.2f} mrad")

# %%
# The tangent of the difference has an error of ten milliradians at large angles. Where one transducer is missing there
# is no angle: it takes two to tell a rotation from a slide.

figure, (first, second) = pyplot.subplots(2, 1, layout="constrained", figsize=(6.4, 5.2), sharex=True)
first.plot(history.time, 1e3 * readings.T, label=["top", "foot"])
first.set(ylabel="displacement (mm)")
first.legend()
second.plot(history.time, 1e3 * (by_tangent - truth), color="C3", linewidth=0.7, label="by the tangent")
second.plot(history.time, 1e3 * (angle - truth), color="black", linewidth=0.7, label="rocking_angle")
second.set(xlabel="time (s)", ylabel="error of θ (mrad)")
_ = second.legend()
