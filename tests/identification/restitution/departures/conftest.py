"""Arcs of free rocking as their closed forms give them, without a history in between."""

from types import SimpleNamespace

import numpy as np
import pytest

from colonnade.identification.restitution.arcs.rocking_arc import half_duration_of
from colonnade.identification.restitution.arcs.series import arc_series
from prism import PRISM

ERROR = 1e-6


def _rocked(
    restitution=0.95,
    *,
    count=20,
    released=0.7,
    block=PRISM,
    stretched=None,
    pauses=None,
    zero=None,
    first=0,
    seen_as=PRISM,
):
    """
    Return the arcs that follow a release to θ > 0, with errors of `ERROR`, as of the block `seen_as`.

    `restitution` is one e, a pair for the arcs' sides, one for each impact, or a function of ω; `stretched` gives
    factors of durations, `pauses` seconds that the block stands upright before an arc, both by the arc's index; `zero`
    is the angle at which the block is upright as seen (rad), one for each arc; `first` arcs are not used.
    """
    side = np.where(np.arange(count) % 2 == 0, 1.0, -1.0)
    critical, p = block.critical_angle_at(side), block.p_at(side)
    rise = np.empty(count)  # (ω/p)²/2
    rise[0] = np.cos(critical[0] * (1 - released)) - np.cos(critical[0])
    for n in range(1, count):
        speed = p[n - 1] * np.sqrt(2 * rise[n - 1])
        if callable(restitution):
            e = restitution(speed)
        else:
            given = np.atleast_1d(restitution)
            e = given[int(side[n - 1] > 0)] if given.size == 2 else given[min(n, given.size) - 1]
        rise[n] = (e * speed / p[n]) ** 2 / 2
    assert np.all(rise < 1 - np.cos(critical)), "this block overturns"
    peak = critical - np.arccos(rise + np.cos(critical))
    duration = 2 * half_duration_of(peak, critical, False) / p
    for index, factor in (stretched or {}).items():
        duration[index] *= factor
    for index, pause in (pauses or {}).items():
        duration[index] += pause
    impacts = 1.0 + np.concatenate(([0.0], np.cumsum(duration)))
    offset = np.zeros(count) if zero is None else np.asarray(zero)
    # ω has the sign of the arc that an impact starts, the other one where it ends an arc.
    slow = side / (p * np.sqrt(2 * rise))
    at_impacts = (np.append(slow, -slow[-1]) + np.append(slow[0], -slow)) / 2
    seen_impacts = impacts - np.append(offset[0], offset) * at_impacts
    series = arc_series(
        seen_as,
        seen_impacts,
        np.full(count + 1, ERROR),
        side * peak + offset,
        np.full(count, ERROR),
        np.arange(count) >= first,
    )
    return SimpleNamespace(series=series, impacts=impacts, peak=side * peak, pauses=pauses or {}, block=block)


def _sampled(arcs, step=0.001):
    """Times and angles of arcs of the linear equation with these peaks and impacts; upright in pauses."""
    time = np.arange(arcs.impacts[0], arcs.impacts[-1], step)
    angle = np.zeros(time.size)
    for n, peak in enumerate(arcs.peak):
        start, end = arcs.impacts[n] + arcs.pauses.get(n, 0.0), arcs.impacts[n + 1]
        inside = (time >= start) & (time < end)
        alpha = arcs.block.critical_angle
        reach = np.arccosh(alpha / (alpha - abs(peak)))
        x = reach * (2 * time[inside] - start - end) / (end - start)
        angle[inside] = np.sign(peak) * (alpha - (alpha - abs(peak)) * np.cosh(x))
    return time, angle


@pytest.fixture(scope="session")
def prism():
    """The block of these tests."""
    return PRISM


@pytest.fixture(scope="session")
def rocked():
    """The function that makes arcs; see `_rocked`."""
    return _rocked


@pytest.fixture(scope="session")
def sampled():
    """The function that makes a sampled angle of them; see `_sampled`."""
    return _sampled
