"""Members whose truth is the contact model in space: friction, a turned prism, motion across, an uneven base."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from colonnade.arrays import Array, Mask
from colonnade.dynamics.contact.body import ContactBody
from colonnade.dynamics.contact.calibration import Calibration, calibrate
from colonnade.dynamics.contact.history import ContactHistory
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.nodes import rigid_body
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.motion import Motion
from span_two_and_a_half.criterion import Response
from span_two_and_a_half.design import OTHERS, SEED, SPACE, STRANGE, TAIL, Cell, nominal, record, table_motion
from span_two_and_a_half.members import VARIANTS, judge_other, judge_strange
from span_two_and_a_half.trial import generator, predict, response, table

PENETRATION = 1e-5
"""Of the standing prism into its contact, in heights of its centre of mass: ten times the default, for speed."""

STEP = 4e-5
"""s."""

GRID = (3, 3)
"""Nodes of the base."""

FRICTION = 0.6


@dataclass(frozen=True)
class Setting:
    """How the contact is resolved; the default is what the study uses."""

    penetration: float = PENETRATION
    step: float = STEP


@dataclass(frozen=True)
class InSpace:
    """
    One member in space.

    Attributes
    ----------
    intensity : float
        m/s² for each unit of Span.
    grown : ndarray of bool, shape (variants, 2, models)
        The pattern at Span 2.5, and its reverse.
    agree : ndarray of bool, shape (variants, models)
        Whether Spans 2.0 and 3.0 agree; false if Span 2.5 shows neither pattern nor reverse, and they were not run.
    place : ndarray, shape (2, models)
        s.
    slide, out_of_plane, yaw : float
        Largest at Span 2.5: m; in α; change in rad.
    """

    intensity: float
    grown: Mask
    agree: Mask
    place: Array
    slide: float
    out_of_plane: float
    yaw: float


@cache
def calibrated(setting: Setting) -> Calibration:
    """Find the law of contact with which the rigid prism rocks freely with the paper's e."""
    block, e = nominal()
    body = rigid_body(block, grid=GRID)
    law = ContactLaw.stiff(body, block.gravity, friction=FRICTION, penetration=setting.penetration)
    return calibrate(body, law, e, gravity=block.gravity, step=setting.step)


def run_in_space(cell: Cell, intensity: float, number: int, setting: Setting, seed: int = SEED) -> InSpace:
    """Run one member: its truth in space at all three Spans, and the plane predictions."""
    random = generator(cell, number, seed)
    size = cell.size
    if cell.cause not in ("contact", "friction"):
        size *= SPACE[cell.cause].spread ** random.uniform(-1.0, 1.0)
    shape = table_motion()
    agree = np.ones((len(VARIANTS), 2), dtype=bool)
    for span in (STRANGE, *OTHERS):
        motion = table(shape, intensity, span)
        history = simulate_wrong(cell.cause, size, motion, setting, sign=1.0 if random.random() < 0.5 else -1.0)
        measured = Response(history.angle, motion.dt, history.overturning_time, nominal()[0])
        predictions = {model: response(each, motion.dt) for model, each in predict(motion).items()}
        if span == STRANGE:
            grown, place = judge_strange(measured, predictions)
            strange = history
            if not grown.any():
                agree[:] = False
                break
        else:
            agree &= judge_other(measured, predictions)
    alpha = nominal()[0].critical_angle
    return InSpace(
        intensity,
        grown,
        agree,
        place,
        float(np.abs(strange.slide).max()),
        float(np.abs(strange.out_of_plane).max() / alpha),
        float(np.abs(strange.yaw - strange.yaw[0]).max()),
    )


def simulate_wrong(cause: str, size: float, motion: Motion, setting: Setting, *, sign: float = 1.0) -> ContactHistory:
    """Run the prism in space with something wrong."""
    found = calibrated(setting)
    body, law = found.body, found.law
    if cause == "friction":
        law = replace(law, friction=size)
    if cause == "uneven":
        body = raised(body, size)
    if cause == "transverse":
        motion = Motion(motion.acceleration, motion.dt, transverse=sign * size * motion.peak * across(motion))
    return simulate(
        body,
        motion,
        law=law,
        gravity=nominal()[0].gravity,
        step=setting.step,
        yaw=sign * size if cause == "yaw" else 0.0,
    )


def raised(body: ContactBody, size: float) -> ContactBody:
    """Raise one corner of the base by `size` (m), its quarter of the base with it."""
    nodes = body.nodes.copy()
    share = np.clip(nodes[:, :2] / np.abs(nodes[:, :2]).max(axis=0), 0.0, 1.0).prod(axis=1)
    nodes[:, 2] += size * share
    return replace(body, nodes=nodes)


@cache
def _east_west() -> Motion:
    return record("peer", "ELC270-hor2")


def across(motion: Motion) -> Array:
    """Give the EW record on the samples of the table's motion, its largest value 1, and rest behind it."""
    other = _east_west()
    samples = motion.acceleration.size - round(TAIL / motion.dt)
    ratio = round(record().dt / other.dt)
    values = other.acceleration[::ratio][:samples] / other.peak
    return np.concatenate((values, np.zeros(motion.acceleration.size - values.size)))
