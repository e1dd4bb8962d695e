"""
Animation
=========

See a history move. ``pyplot.show()`` plays it in a script, ``HTML(animation.to_jshtml())`` of ``IPython.display`` in a
notebook, and ``animation.save("rocking.gif", writer="pillow")`` writes it.
"""

import numpy as np

import colonnade

block = colonnade.Block.cone(base_diameter=0.485, top_diameter=0.3775, height=2.40, mass=2742.0)
time = np.arange(0.0, 5.0, 0.01)
motion = colonnade.Motion(4.4 * np.sin(np.pi * time / 5.0) ** 2 * np.sin(2 * np.pi * 1.2 * time), 0.01)
history = colonnade.rock(block, motion, restitution=0.93, model="nonlinear")
history

# %%
# A truncated cone, drawn as a prism of its base and of twice the height of its centre of mass.

animation = colonnade.animate(history)
