"""
Overturning by a pulse
======================

A half-sine pulse just strong enough to overturn a block. A thousandth less, and the block stops near its critical
angle and comes back.
"""

import numpy as np
from matplotlib import pyplot
from scipy.optimize import brentq

import colonnade

block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
ratio = 2.0  # Ω: frequency of the pulse over p

# %%
# The limit of the linear model has a closed form. The block lifts at the phase ψ of the pulse, and falls if it reaches
# the end of the pulse with enough speed: Ω sin ψ − cos ψ = exp(−(π − ψ)/Ω), and a = g α / sin ψ.

phase = brentq(lambda psi: ratio * np.sin(psi) - np.cos(psi) - np.exp(-(np.pi - psi) / ratio), 1e-3, 1.57)
limit = block.gravity * block.critical_angle / np.sin(phase)
print(f"limit: {limit:.4f} m/s², {np.tan(block.critical_angle) * block.gravity:.4f} m/s² lifts the block")

# %%
# Four pulses about that limit. A positive acceleration of the table turns the block to the negative side.

step = np.pi / (ratio * block.p) / 1000
angle = ratio * block.p * step * np.arange(7001)
shape = np.where(angle < np.pi, np.sin(angle), 0.0)
_, axes = pyplot.subplots(layout="constrained")
outcomes = {}
for share in (0.95, 0.999, 1.001, 1.05):
    history = colonnade.rock(block, colonnade.Motion(share * limit * shape, step), restitution=0.9)
    outcomes[share] = history.outcome
    axes.plot(history.time, history.angle / block.critical_angle, label=f"{share:g} of the limit: {history.outcome}")
axes.axhline(-1.0, color="grey", linewidth=0.8)
axes.set(xlabel="time (s)", ylabel="θ / α", ylim=(-1.6, 1.0))
_ = axes.legend()
