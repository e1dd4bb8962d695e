"""
Stability map
=============

Which sines overturn a block from rest? Below A = α / tan α it does not lift; to the left of the lower limit it
overturns. High frequencies need much more.
"""

import numpy as np

import colonnade

block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
chart = colonnade.stability_map(
    block,
    restitution=0.93,
    frequency_ratio=np.linspace(1.0, 7.0, 61),
    amplitude_ratio=np.linspace(0.8, 7.0, 94),
    cycles=8,
)
chart

# %%
# The shade is the share of each cell that overturns. Between the two limits lie amplitudes at which the block survives
# by luck: there its outcome hangs on the phase, the number of cycles and e.

axes = colonnade.plot(chart)

# %%
# What the limits depend on is part of the result.

print({name: chart.options[name] for name in ("model", "cycles", "phase", "ramp", "width", "scan_step")})
alpha = block.critical_angle
print(f"lifts from A = {chart.no_rocking[0]:.4f}; α / tan α = {alpha / np.tan(alpha):.4f}")
