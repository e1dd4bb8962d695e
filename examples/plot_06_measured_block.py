"""
A block that is not symmetric
=============================

A statue, or a column with a broken edge, is given by what was measured: the distance R of its centre of mass from each
edge, the critical angle α of each side, and its inertia. A pair is for θ < 0 and for θ > 0.
"""

import numpy as np
from matplotlib import pyplot

import colonnade

statue = colonnade.Block.measured(
    mass=80.0, pole_distance=(0.612, 0.605), critical_angle=(0.25, 0.19), inertia=(41.3, 40.6)
)
for side, name in zip(statue.sides, ("θ < 0", "θ > 0"), strict=True):
    print(f"{name}: α = {side.critical_angle:.2f} rad, p = {statue.side_p(side):.3f} rad/s")

# %%
# Free rocking leans further, and stays longer, on the slender side. Both edges lose the same share of energy.

history = colonnade.rock(statue, theta0=0.5 * 0.19, restitution=0.96, duration=7.0, model="nonlinear")
figure, (first, second) = pyplot.subplots(2, 1, layout="constrained", figsize=(6.4, 5.2), sharex=True)
first.plot(history.time, np.rad2deg(history.angle))
first.set(ylabel="θ (°)")
second.plot(history.time, history.energy)
second.set(xlabel="time (s)", ylabel="energy / barrier of the side")

# %%
# The energy that would overturn each side differs, so the same energy is another share of it: the steps up and down are
# changes of side, what is lost at them is lost for good. A pulse to the slender side needs less to overturn it.

step = 0.005
pulse = np.concatenate([np.sin(np.linspace(0.0, np.pi, 121)), np.zeros(600)])
for sign, side in ((1, "θ < 0"), (-1, "θ > 0")):
    levels = np.arange(1.0, 8.0, 0.02)
    fell = [
        colonnade.rock(statue, colonnade.Motion(sign * level * pulse, step), restitution=0.96).outcome == "overturned"
        for level in levels
    ]
    print(f"overturns to {side} from {levels[np.argmax(fell)]:.2f} m/s²")
