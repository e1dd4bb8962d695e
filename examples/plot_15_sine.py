"""
Steady response to a sine
=========================

Shaken by a sine, a block settles into a response that repeats: with every period of the table, or with every third.
Here it is one and the same sine, only begun differently: a block may have several steady responses.
"""

import numpy as np
from matplotlib import pyplot

import colonnade
from colonnade.identification.response.order import response_order

block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
hertz, level = 6.7 * block.p / (2 * np.pi), 4.0  # Ω = ω/p = 6.7, A = a/(g tan α) = 4
cycles, step = 120, 1 / (200 * hertz)
phase = 2 * np.pi * hertz * step * np.arange(200 * cycles + 1)

# %%
# The amplitude rises over three periods in one run, over five in the other. Left the last periods; right the angle and
# its velocity, where a steady response is a closed curve and the vertical steps are impacts.

figure, panels = pyplot.subplots(2, 2, layout="constrained", figsize=(8.0, 5.6))
orders = []
for (first, second), ramp in zip(panels, (5, 3), strict=True):
    envelope = np.clip(phase / (2 * np.pi * ramp), 0.0, 1.0)
    motion = colonnade.Motion(level * block.uplift_acceleration * envelope * np.sin(phase), step)
    history = colonnade.rock(block, motion, restitution=0.9, model="nonlinear")
    steady = {"start": ramp / hertz, "stop": cycles / hertz}
    found = response_order(history.time, history.angle, hertz, **steady, threshold=1e-3 * block.critical_angle)
    orders.append(found.order)
    last = history.time > (cycles - 6) / hertz
    angle, velocity = history.angle / block.critical_angle, history.angular_velocity / (block.p * block.critical_angle)
    first.plot(history.time[last] * hertz, angle[last])
    first.set(title=f"begun over {ramp} periods: order {found.order}", xlabel="periods of the table", ylabel="θ / α")
    second.plot(angle[last], velocity[last], linewidth=0.8)
    second.set(xlabel="θ / α", ylabel="θ' / (p α)")

# %%
# Order n: the angle repeats after n periods of the table.

print(f"orders: {orders}")
