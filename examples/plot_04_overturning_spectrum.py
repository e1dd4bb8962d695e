"""
Overturning spectrum of a pulse
===============================

Which sine pulses overturn a block? From the lower limit on it falls after an impact. Then comes a band of stronger
pulses that it survives, up to the upper limit; beyond that it falls without an impact. A stronger pulse may be safer.
"""

import numpy as np

import colonnade

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
