"""
Free rocking
============

Tilt a block, let it go, and it rocks from edge to edge. Each impact takes energy: the peaks fall, and the impacts come
faster and faster.
"""

import numpy as np

import colonnade

block = colonnade.Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)  # m, kg
restitution, released = 0.93, 0.5
history = colonnade.rock(block, theta0=released * block.critical_angle, restitution=restitution, duration=3.5)
history

# %%
# The first impact ends a quarter of a period. Housner (1963) gives its time in closed form for the linear model: it
# depends on the amplitude, so a rocking block has no natural period.

quarter = np.arccosh(1 / (1 - released)) / block.p
print(f"first impact: {history.impact_times[0]:.6f} s, closed form: {quarter:.6f} s")

# %%
# Each impact multiplies the energy of the peaks by e². The circles are Housner's peaks; the line is the computed
# angle θ over the critical angle α, at which the block would just overturn.

impacts = history.impact_times[:13]
number = np.arange(1, impacts.size)
energy = (1 - (1 - released) ** 2) * restitution ** (2 * number)
peaks = (-1.0) ** number * (1 - np.sqrt(1 - energy))

axes = colonnade.plot(history)
axes.plot((impacts[:-1] + impacts[1:]) / 2, peaks, "o", color="black", fillstyle="none", label="Housner 1963")
_ = axes.legend()

# %%
# See it move. ``pyplot.show()`` plays the animation in a script, ``HTML(animation.to_jshtml())`` of ``IPython.display``
# in a notebook, and ``animation.save("rocking.gif", writer="pillow")`` writes it.

animation = colonnade.animate(history)
