"""
Fragility of a column
=====================

How probably does a real column overturn, over the strength of the ground motion? Records are scaled to levels, each run
for several e within their limits. The intervals are over the records: these are the sample.
"""

import numpy as np

import colonnade
from colonnade.laboratory.site import synthetic_records

column = colonnade.Block.prism(width=0.9, depth=0.9, height=5.4, mass=11e3)
records = {record.name: record.motion for record in synthetic_records(12)}
found = colonnade.fragility(
    column,
    records,
    restitution=0.94,
    restitution_range=(0.92, 0.96),
    levels=np.geomspace(0.2, 1.6, 9),  # m/s, of PGV
    draws=2,
    baseline="linear",
    resamples=200,
)
found

# %%
# The lognormal curve, and one that only has to rise. The wider they lie apart, the less the lognormal one holds.

axes = colonnade.plot(found)

# %%
# From the curve that is taken: where 5 % and 50 % overturn. An interval over twelve records is wide.

print(f"taken: {found.taken}")
for share in (0.05, 0.5):
    at = found.reaches(share)
    print(f"{100 * share:2.0f} % at PGV = {at.value:.2f} m/s ({at.low:.2f} to {at.high:.2f})")
