"""One member: a virtual prism with what is wrong, and the predictions of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from math import tan
from zlib import crc32

import numpy as np

from colonnade.dynamics.block import Block
from colonnade.dynamics.ensembles.uncertainty import member_block
from colonnade.dynamics.history import History
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.restitution_law import RestitutionLaw
from colonnade.dynamics.rock import rock
from colonnade.signals.filters import lowpass
from span_two_and_a_half.criterion import Response
from span_two_and_a_half.design import CAUSES, MODELS, SEED, SPANS, TAIL, Cell, nominal

MIDDLE_SPEED = 0.4
"""Of p α: the speed at which an e that depends on it is right."""

PLATEAUS = 2048
"""Values of e up to three times p α, each drawn: no two impacts of a member are likely to share one."""

SIGNED = ("e", "critical angle", "p", "gain", "offset", "drift", "clock", "tilt", "speed")
"""Causes whose sign is drawn."""


@dataclass(frozen=True)
class Wrong:
    """
    What is wrong in one member; zero where nothing is.

    Attributes
    ----------
    e, critical_angle, p, gain, clock : float
        True less nominal e; relative, true over nominal: of α, p; recorded over true: of acceleration and interval.
    offset, drift : tuple of float
        Of the recorded acceleration at each Span, mg; the drift at the end of the motion.
    noise : float
        RMS, mg.
    filter : float
        Cut-off, Hz; 0 for none. One above half the sampling rate changes nothing.
    tilt : float
        rad.
    speed : float
        Change of e from speed zero to p α.
    scatter : float
        Standard deviation of e.
    tangent : bool
        The predictions use tan α for α.
    """

    e: float = 0.0
    critical_angle: float = 0.0
    p: float = 0.0
    gain: float = 0.0
    offset: tuple[float, ...] = (0.0, 0.0, 0.0)
    drift: tuple[float, ...] = (0.0, 0.0, 0.0)
    noise: float = 0.0
    filter: float = 0.0
    clock: float = 0.0
    tilt: float = 0.0
    speed: float = 0.0
    scatter: float = 0.0
    tangent: bool = False


def draw(cell: Cell, member: int, seed: int = SEED) -> Wrong:
    """Draw what is wrong in a member."""
    random = generator(cell, member, seed)
    if cell.cause == "none":
        return Wrong()
    if cell.cause == "tangent":
        return Wrong(tangent=True)
    found = Wrong()
    alone = cell.cause != "all"
    for name in (cell.cause,) if alone else [key for key, cause in CAUSES.items() if len(cause.sizes) > 1][:-1]:
        size = CAUSES[name].sizes[cell.grade]
        if alone or name == "filter":
            size *= CAUSES[name].spread ** random.uniform(-1.0, 1.0)
        else:
            size *= abs(random.standard_normal())
        found = replace(found, **{name.replace(" ", "_"): _with_sign(name, size, random)})
    return found


def generator(cell: Cell, member: int, seed: int = SEED, *further: int) -> np.random.Generator:
    """Give the stream of one member, or a further one of it."""
    return np.random.default_rng((seed, crc32(cell.cause.encode()), cell.grade, member, *further))


def _with_sign(name: str, size: float, random: np.random.Generator) -> float | tuple[float, ...]:
    if name in ("offset", "drift"):
        return tuple((size * random.choice([-1.0, 1.0], len(SPANS))).tolist())
    return float(size * random.choice([-1.0, 1.0])) if name in SIGNED else size


def table(shape: Motion, intensity: float, span: float) -> Motion:
    """Scale the table's motion, of 1 m/s² at its largest, to an intensity (m/s² for each unit of Span)."""
    return Motion(intensity * span * shape.acceleration, shape.dt)


def truth(wrong: Wrong, motion: Motion, random: np.random.Generator, model: str = "nonlinear") -> History:
    """Run the true block on the true motion."""
    block, _ = nominal()
    true = block
    if wrong.critical_angle or wrong.p:
        true = member_block(block, 1.0 + wrong.critical_angle, 1.0 + wrong.p)
    moved = motion
    if wrong.tilt:
        moved = Motion(motion.acceleration + block.gravity * tan(wrong.tilt), motion.dt)
    return rock(true, moved, restitution=restitution(wrong, random), model=model)


def restitution(wrong: Wrong, random: np.random.Generator) -> float | RestitutionLaw:
    """Give the true e, or its law: changing with the speed of the impact, or drawn anew for each speed."""
    block, e = nominal()
    mean = min(e + wrong.e, 1.0)
    if not (wrong.speed or wrong.scatter):
        return mean
    fastest = block.p * block.critical_angle
    edges = np.linspace(0.0, 3.0 * fastest, PLATEAUS + 1)
    speeds = np.column_stack((edges[:-1], edges[:-1] + 0.999 * np.diff(edges))).ravel()
    values = mean + wrong.speed * (np.minimum(speeds / fastest, 1.0) - MIDDLE_SPEED)
    values += wrong.scatter * np.repeat(random.standard_normal(PLATEAUS), 2)
    return RestitutionLaw.table(speeds, np.clip(values, 0.0, 1.0))


def recorded(wrong: Wrong, motion: Motion, which: int, random: np.random.Generator) -> Motion:
    """Give the motion as the laboratory has it; `which` is the number of the Span."""
    block, _ = nominal()
    values = (1.0 + wrong.gain) * motion.acceleration
    milli_g = 1e-3 * block.gravity
    if wrong.noise:
        values = values + milli_g * wrong.noise * random.standard_normal(values.size)
    if 0.0 < wrong.filter < 0.5 / motion.dt:
        values = lowpass(values, motion.dt, wrong.filter)
    if wrong.offset[which] or wrong.drift[which]:
        share = motion.time / (motion.duration - TAIL)
        values = values + milli_g * (wrong.offset[which] + wrong.drift[which] * share)
    return Motion(values, motion.dt * (1.0 + wrong.clock))


def is_recorded_truly(wrong: Wrong) -> bool:
    """Tell whether the recorded motion is the true one."""
    return not (wrong.gain or any(wrong.offset) or any(wrong.drift) or wrong.noise or wrong.filter or wrong.clock)


@cache
def predicted_block(tangent: bool) -> Block:
    """Give the block of the predictions, with its α or with tan α in its place."""
    block, _ = nominal()
    return member_block(block, tan(block.critical_angle) / block.critical_angle, 1.0) if tangent else block


def predict(motion: Motion, *, tangent: bool = False) -> dict[str, History]:
    """Run the plane models with nominal values on a motion as recorded."""
    _, e = nominal()
    return {model: rock(predicted_block(tangent), motion, restitution=e, model=model) for model in MODELS}


def response(history: History, dt: float) -> Response:
    """Put a history on the clock of the measured angle, of step `dt` (s)."""
    block, _ = nominal()
    angle = history.angle
    if history.time[1] != dt:
        angle = np.interp(np.arange(angle.size) * dt, history.time, angle)
    return Response(angle, dt, history.overturning_time, block)


def parted(measured: Response, predicted: Response, by: float = 0.05) -> float:
    """Give when measured and predicted |θ|/α first differ by so much, s; NaN if they never do."""
    apart = np.abs(measured.ratio - predicted.ratio) > by
    return float(np.argmax(apart) * measured.dt) if apart.any() else float("nan")
