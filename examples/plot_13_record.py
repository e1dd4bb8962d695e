"""
A record: read, scaled, measured
================================

``read_motion`` reads a ground motion from a file of any format that the commands read. What the file does not say,
it asks for. Measures of intensity say how strong the motion is, also for a block.
"""

import tempfile
from pathlib import Path

import numpy as np
from matplotlib import pyplot

import colonnade

# %%
# A file such as a colleague sends: text, a head, times and accelerations, and no word of the unit.

step, rng = 0.01, np.random.default_rng(3)
time = np.arange(0.0, 20.0, step)
shaking = np.convolve(rng.normal(size=time.size), np.hanning(31), "same") * time * np.exp(-time / 3.0)
shaking -= np.interp(time, [0.0, 20.0], [shaking[0], shaking[-1]])
file = Path(tempfile.mkdtemp()) / "station-7.csv"
rows = "\n".join(f"{t:.2f}, {a:.5f}" for t, a in zip(time, 0.02 * shaking, strict=True))
file.write_text(f"Time, Acc\n{rows}\n", encoding="utf-8")

try:
    colonnade.read_motion(file)
except colonnade.ColonnadeError as error:
    print(error)

# %%
# With the unit it is a motion in m/s². Another strength is another motion.

motion = colonnade.read_motion(file, unit="g")
stronger = colonnade.Motion(1.5 * motion.acceleration, motion.dt)

block = colonnade.Block.prism(width=0.35, depth=0.35, height=1.8, mass=500.0)
measured = colonnade.intensity_measures(motion, block, baseline="highpass(0.1 Hz)")
measured

# %%
# A record whose velocity does not come back to zero has no PGV, unless a correction of the baseline is asked for.

print(colonnade.intensity_measures(motion).reasons.get("pgv", "no reason: it does not drift"))

_, axes = pyplot.subplots(layout="constrained")
for each, name in ((motion, "as recorded"), (stronger, "1.5 times as strong")):
    history = colonnade.rock(block, each, restitution=0.9)
    axes.plot(
        history.time, history.angle / block.critical_angle, label=f"{name}, PGA {each.peak:.2f} m/s²: {history.outcome}"
    )
axes.set(xlabel="time (s)", ylabel="θ / α", ylim=(-1.5, 1.5))
_ = axes.legend()
