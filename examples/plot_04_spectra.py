"""
Spectra: of a pulse, of a record
================================

Which sine pulses overturn a block? From the lower limit on it falls after an impact. Then comes a band of stronger
pulses that it survives, up to the upper limit; beyond that it falls without an impact. A stronger pulse may be safer.
"""

import numpy as np

import colonnade
from colonnade.laboratory.site import synthetic_records

block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
spectrum = colonnade.overturning_spectrum(
    block, "sine", frequency_ratio=np.linspace(1.0, 6.0, 51), restitution=0.9, largest=8.0
)
spectrum

# %%
# Ω is the frequency of the pulse over p; A its largest acceleration over g tan α, so that A = 1 lifts the block.
# All shaded amplitudes overturn.

axes = colonnade.plot(spectrum)

# %%
# At one frequency, all intervals of A that overturn, to a millionth:

at_three = np.isclose(spectrum.interval_frequency_ratio, 3.0)
for start, end in zip(spectrum.interval_start[at_three], spectrum.interval_end[at_three], strict=True):
    print(f"Ω = 3: overturns from A = {start:.6f} to {end:.6f}")

# %%
# What does one ground motion do to columns of any size? The period 2π/p is their size: 4 s is a column of about 6 m.

record = synthetic_records(12)[11]  # a synthetic ground motion with a long pulse
motion = record.motion
print(f"{record.name}: a pulse of {record.pulse_period:.1f} s, PGA {motion.peak:.1f} m/s²")

# %%
# One curve is one slenderness. A cross is a size that overturns.

sizes = colonnade.rocking_spectrum(motion, critical_angle=[0.14, 0.2, 0.28], period=np.arange(1.0, 8.01, 0.25))
axes = colonnade.plot(sizes)

# %%
# Sizes are pole distances: R = (3/4) g / p² for a rectangular block.

slender = sizes.overturned[0]
distance = 0.75 * 9.81 * (sizes.period / (2 * np.pi)) ** 2
print(f"α = 0.14 rad: blocks overturn up to a height of {2 * np.cos(0.14) * distance[slender].max():.1f} m")
