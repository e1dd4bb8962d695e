"""
A cylinder that rolls on its rim
================================

A round column need not rock in a plane: pushed sideways while it is tilted, it rolls around on its rim, as a coin does.
The contact model moves a block in space and shows it. It has no coefficient of restitution; contact, damping and
friction are its own.
"""

from matplotlib import pyplot

import colonnade

block = colonnade.Block.cylinder(diameter=0.097, height=0.455, mass=26.30)
alpha = block.critical_angle
rolling = colonnade.rock(block, out_of_plane=0.4 * alpha, omega0=0.3 * alpha * block.p, model="contact", duration=2.0)
rocking = colonnade.rock(block, out_of_plane=0.4 * alpha, model="contact", duration=2.0)

# %%
# Left: the lean of the axis in x and in y. Without a push it passes through the upright position: that is plane
# rocking, and each impact takes energy. Pushed, it goes around without an impact, and hardly loses any.

figure, (first, second) = pyplot.subplots(1, 2, layout="constrained", figsize=(8.0, 4.0))
kept = {}
for history, style, name in ((rocking, "k-", "let go"), (rolling, "-", "pushed sideways")):
    first.plot(history.angle / alpha, history.out_of_plane_angle / alpha, style, linewidth=1.0, label=name)
    energies = history.energies
    held = energies.stored - rocking.energies.stored.min()
    kept[name] = held[-1] / held[0]
    second.plot(history.time, held / held[0], style, label=name)
    print(f"{name}: {100 * kept[name]:.1f} % of the energy is left; it is balanced to {energies.relative_residual:.0e}")
first.set(xlabel="lean towards x / α", ylabel="rotation about x / α", aspect="equal")
second.set(xlabel="time (s)", ylabel="energy over that at the start", ylim=(0.0, 1.05))
_ = second.legend(loc="lower left")
