"""
Rocking spectrum of a record
============================

What does one ground motion do to columns of any size? The period 2π/p is their size: 4 s is a column of about 6 m. One
curve is one slenderness. It shows which columns the motion overturns, and which it does not.
"""

import numpy as np

import colonnade
from colonnade.laboratory.site import synthetic_records

record = synthetic_records(12)[11]  # a synthetic ground motion with a long pulse
motion = record.motion
print(f"{record.name}: a pulse of {record.pulse_period:.1f} s, PGA {motion.peak:.1f} m/s²")

# %%
# A cross is a size that overturns.

spectrum = colonnade.rocking_spectrum(motion, critical_angle=[0.14, 0.2, 0.28], period=np.arange(1.0, 8.01, 0.25))
axes = colonnade.plot(spectrum)

# %%
# Sizes are pole distances: R = (3/4) g / p² for a rectangular block.

slender = spectrum.overturned[0]
distance = 0.75 * 9.81 * (spectrum.period / (2 * np.pi)) ** 2
print(f"α = 0.14 rad: blocks overturn up to a height of {2 * np.cos(0.14) * distance[slender].max():.1f} m")
