"""
Drums and frames
================

Ancient columns are drums on each other, and carry beams. The contact model moves all bodies: each rocks, slides and
turns on what it stands on.
"""

import numpy as np
from matplotlib import pyplot

import colonnade

drum = colonnade.Block.prism(width=0.40, depth=0.40, height=0.35, mass=140.0)
column = colonnade.Assembly.stack(low=drum, middle=drum, high=drum)
column

# %%
# A pulse of one sine rocks the column. Each curve is one joint: the angle of a drum relative to the one below it, over
# the critical angle of all that stands on the joint.

time = np.arange(0.0, 2.0, 0.005)
motion = colonnade.Motion(np.where(time < 0.4, 6.0 * np.sin(2 * np.pi * time / 0.4), 0.0), 0.005)
history = colonnade.rock(column, motion, model="contact")
axes = colonnade.plot(history)
for name, (x, y, yaw) in history.residuals.items():
    print(f"{name}: {1000 * x:.2f} mm along x, {1000 * y:.2f} mm along y, turned by {yaw:.4f} rad")
history

# %%
# The same pulse under two columns with a beam. `Assembly.frame` places them; here it is written out, body by body.

pillar = colonnade.Block.prism(width=0.40, depth=0.40, height=1.60, mass=640.0)
beam = colonnade.Block.prism(width=2.4, depth=0.40, height=0.30, mass=720.0)
portal = colonnade.Assembly(
    {
        "left": colonnade.Placed(pillar, position=(-1.0, 0.0)),
        "right": colonnade.Placed(pillar, position=(1.0, 0.0)),
        "beam": colonnade.Placed(beam, on=("left", "right")),
    }
)
moved = colonnade.rock(portal, motion, model="contact")
figure, axes = pyplot.subplots(layout="constrained")
_ = colonnade.plot(moved, axes)
moved

# %%
# The column of drums and the frame as they move.

drums, frame = colonnade.animate(history), colonnade.animate(moved)
