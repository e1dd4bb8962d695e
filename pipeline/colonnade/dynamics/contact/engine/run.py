"""A whole run: step after step over the samples of the table's motion."""

from __future__ import annotations

from math import sqrt

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.contact.engine.flight import drift, fill_rotation
from colonnade.dynamics.contact.engine.kick import kick
from colonnade.dynamics.contact.engine.points import fastest, place_nodes
from colonnade.dynamics.contact.engine.rings import place_rings
from colonnade.dynamics.contact.engine.sample import fill_sample
from colonnade.dynamics.contact.engine.state import IMPACT, Body, Near, State
from colonnade.dynamics.contact.engine.watch import about_pole, watch_impacts
from colonnade.dynamics.kernel import kernel


@kernel
def run(
    body: Body, state: State, near: Near, motion: Array, interval: float, parts: int, samples: Array
) -> tuple[int, Array]:
    """
    Fill the samples (shape (n, COLUMNS)) along a motion (shape (n, 3)); return how many, and the impacts.

    `parts` steps an interval. The run ends where the body lies, at a tilt of π/2.
    """
    step, pull, reach, bend = interval / parts, np.zeros(3), 0.0, 0.0
    for node in range(body.nodes.shape[0]):
        reach = max(reach, sqrt((body.nodes[node] ** 2).sum()))
        bend = max(bend, sqrt((body.modes[node] ** 2).sum()))
    found = np.zeros((64, IMPACT))
    samples[:, :] = 0.0
    fill_rotation(state)
    fill_sample(body, state, near, samples[0])
    for sample in range(1, motion.shape[0]):
        for part in range(parts):
            # The first half of the drift, with the table's acceleration at its middle.
            for axis in range(3):
                pull[axis] = -_table(motion, sample, (part + 0.25) / parts, axis)
            drift(body, state, pull, 0.5 * step)
            # What may touch within the step, and its impulse.
            count = place_nodes(body, state, near, step * fastest(body, state, reach, bend))
            count = place_rings(body, state, near, count, step)
            before = about_pole(body, state, state.watch[0])
            state.watch[2] = max(state.watch[2], abs(before[0]))
            kick(body, state, near, count, step)
            time = (sample - 1) * interval + (part + 0.5) * step
            base = _table(motion, sample, (part + 0.5) / parts, 0)
            found = watch_impacts(body, state, near, count, before, base, time, found)
            # The second half of the drift.
            for axis in range(3):
                samples[sample, 14 + axis] += state.total[axis] / parts
                pull[axis] = -_table(motion, sample, (part + 0.75) / parts, axis)
            drift(body, state, pull, 0.5 * step)
        fill_sample(body, state, near, samples[sample])
        samples[sample, 21:25] = state.ledger
        samples[sample, 25] = step * state.watch[3]
        if state.matrix[2, 2] <= 0.0:
            return sample + 1, found[: int(state.watch[1])]
    return motion.shape[0], found[: int(state.watch[1])]


@kernel
def _table(motion: Array, sample: int, share: float, axis: int) -> float:
    """Give the table's acceleration at a share of the interval that ends at `sample`."""
    before = motion[sample - 1, axis]
    return float(before + (motion[sample, axis] - before) * share)
