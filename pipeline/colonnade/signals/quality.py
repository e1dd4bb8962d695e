"""Quality of a record: small checks that return the flagged samples and the reason; values are never changed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from colonnade.arrays import Array, Codes, Mask
from colonnade.errors import count
from colonnade.findings import Finding, note, serious, warning
from colonnade.signals.samples import blocks, filled_in, stretches

ENOUGH = 100_000
"""Number of samples that is enough for a median."""

NEIGHBOURHOOD = 201
"""Samples whose roughness a spike is compared with."""

FEWEST = 15
"""Samples of a record, in less spikes are not looked for."""

FEW_SPIKES = 0.001
"""Share of the samples up to which spikes are only noted."""


BEYOND = 1.1
"""Times the range; no recorder gives values so much larger."""

FEW_BEYOND = 0.01
"""Share of the samples that may be beyond it: spikes and overflows do not mean a wrong unit."""

FIRST = 10
"""Samples with which a channel begins, and ends: where it rests."""

BAND = 8.0
"""Standard deviations of the noise, below the extreme value, within which samples are at it."""

STEEP = 6.0
"""Bands by which a flank of half as many samples has to leave it: a parabola leaves it by three."""

LEVEL = 1.5
"""Standard deviations of the noise, that samples at it deviate by at most."""

FEWEST_AT_RAIL = 6
"""Samples at one value."""

AWAY = 0.3
"""Of all that the channel moves: an extreme value nearer to one at which it begins or ends is where it rests."""


FAST, AT_REST, MOVED = 5.0, 0.05, 0.5
"""Times all other steps, that a jump is; of the jump, by which the channel moves at most then, and did before."""


class Flag(IntEnum):
    """Quality of a sample: good and suspect samples are used, failed and missing ones are bridged."""

    GOOD = 1
    NOT_EVALUATED = 2
    SUSPECT = 3
    FAIL = 4
    MISSING = 9


class Verdict(NamedTuple):
    """
    The result of a check of a record.

    Attributes
    ----------
    flag : Flag
    where : ndarray of bool, shape (n,)
        The samples it applies to; none if all is good.
    finding : Finding
        That it makes.
    """

    flag: Flag
    where: Mask
    finding: Finding

    @property
    def reason(self) -> str:
        """The text of its finding; empty if all is good."""
        return self.finding.text if self.where.any() else ""

    @classmethod
    def good(cls, size: int) -> Verdict:
        """Verdict that flags nothing."""
        return cls(Flag.GOOD, np.zeros(size, dtype=bool), Finding(""))


def combine(verdicts: Iterable[Verdict], size: int) -> tuple[Codes, list[Finding]]:
    """
    Merge verdicts into one flag a sample, the worst one, and the list of what was found.

    Returns
    -------
    flags : ndarray of int8, shape (size,)
    found : list of Finding
    """
    flags = np.full(size, Flag.GOOD, dtype=np.int8)
    found = []
    for verdict in verdicts:
        if verdict.reason:
            flags[verdict.where] = np.maximum(flags[verdict.where], np.int8(verdict.flag))
            found.append(verdict.finding)
    return flags, found


def check_missing(time: Array, values: Array) -> Verdict:
    """Flag samples without a value or a time."""
    where = ~(np.isfinite(values) & np.isfinite(time))
    reason = f"{counted(where)} without a value{first_at(time, where)}"
    return Verdict(Flag.MISSING, where, warning("missing samples", reason))


def check_clipping(time: Array, values: Array, *, full_scale: float) -> Verdict:
    """
    Flag samples at the end of the range.

    Parameters
    ----------
    time, values : ndarray, shape (n,)
        s; in the unit of `full_scale`.
    full_scale : float
        Largest magnitude that the recorder or transducer can give. The top code of 12 bits, 2047/2048 of it, counts as
        reached.
    """
    least = full_scale * (1 - 5e-4)
    where = (values >= least) | (values <= -least)
    size = np.abs(values[where])
    if np.count_nonzero(size > BEYOND * full_scale) > FEW_BEYOND * values.size:
        reason = (
            f"{counted(where)} beyond the range of ±{full_scale:g}, up to {float(size.max()):.4g}: the "
            "values are in another unit, of another column, or the range is wrong"
        )
        return Verdict(Flag.SUSPECT, where, serious("unit", reason))
    reason = f"{counted(where)} at the end of the range (±{full_scale:g}){first_at(time, where)}: the value was larger"
    return Verdict(Flag.SUSPECT, where, warning("end of the range", reason))


def check_flat(time: Array, values: Array, *, duration: float) -> Verdict:
    """Flag stretches on which the value stays exactly the same for longer than `duration` (s)."""
    where = np.zeros(values.size, dtype=bool)
    # Runs of steps without a change, each from the sample before its first step to that after its last.
    starts, stops = stretches(values[1:] == values[:-1])
    for run in np.flatnonzero(time[stops] - time[starts] > duration):
        where[starts[run] : stops[run] + 1] = True
    if where.size and where.all():
        reason = f"the channel is dead: every sample is {values[0]:g}"
        return Verdict(Flag.SUSPECT, where, serious("dead channel", reason))
    reason = f"{counted(where)} flat for more than {duration:g} s{first_at(time, where)}"
    return Verdict(Flag.SUSPECT, where, warning("flat stretch", reason))


def check_spikes(time: Array, values: Array, *, threshold: float) -> Verdict:
    """
    Flag spikes of one sample.

    Parameters
    ----------
    time, values : ndarray, shape (n,)
        s; any unit.
    threshold : float
        In robust standard deviations of the second difference, of the whole record and of the neighbourhood, whichever
        is larger.

    Notes
    -----
    A spike stands out, to one side, from the line through the two samples before it and from the line through the two
    after it. At an impact, where a record may have a cusp, a sample lies on one of the lines; a step lies on one as
    well, and passes.
    """
    where, filled = np.zeros(values.size, dtype=bool), filled_in(values, FEWEST)
    if not filled.size:
        return Verdict.good(values.size)
    # A coarse converter gives mostly zeros: its step is then the least that can be told.
    typical = _or_smallest_step(_typical_bend(filled), filled)
    for part in blocks(values.size):
        begin = max(part.start - NEIGHBOURHOOD, 0)
        places = begin + _standing_out(filled[begin : part.stop + NEIGHBOURHOOD], threshold, typical)
        where[places[(places >= part.start) & (places < part.stop)]] = True
    if filled is not values:
        where &= np.isfinite(values)
    # They are bridged: a few do not touch the result.
    told = note if np.count_nonzero(where) <= FEW_SPIKES * where.size else warning
    return Verdict(Flag.FAIL, where, told("spikes", f"spikes on {counted(where)}{first_at(time, where)}"))


def _standing_out(values: Array, threshold: float, typical: float) -> NDArray[np.intp]:
    """Find the samples that stand out from the lines on both sides by more than what is rough around them."""
    bends = np.abs(np.diff(values, 2))
    places = np.flatnonzero(bends > threshold * typical) + 1
    places = places[(places >= 3) & (places < values.size - 3)]
    if not places.size:
        return places
    earlier, before, sample, behind, later = (values[places + shift] for shift in range(-2, 3))
    lines = sample - 2 * before + earlier, sample - 2 * behind + later
    height = np.where(lines[0] * lines[1] > 0, np.minimum(*np.abs(lines)), 0.0)
    stands = np.abs(behind - before) < 0.5 * np.abs(sample - 0.5 * (before + behind))
    stands &= height > threshold * typical
    places, height = places[stands], height[stands]
    # The upper tenth, not the median: a motion recorded at few samples a period is rough now and then all along.
    around = sliding_window_view(np.pad(bends, NEIGHBOURHOOD // 2, mode="edge"), NEIGHBOURHOOD)[places - 1]
    roughness: Array = np.quantile(around, 0.9, axis=1, method="lower") / 1.645
    return np.asarray(places[height > threshold * roughness])


def _typical_bend(values: Array) -> float:
    """Robust standard deviation of the second difference."""
    every = max(1, (values.size - 2) // ENOUGH)
    return 1.4826 * float(np.median(np.abs(values[:-2:every] - 2 * values[1:-1:every] + values[2::every])))


def _or_smallest_step(known: float, values: Array) -> float:
    """Return the smallest change between neighbours, if it is larger than what is known."""
    smallest = np.inf
    for part in blocks(values.size - 1):
        steps = np.abs(np.diff(values[part.start : part.stop + 1]))
        smallest = min(smallest, float(steps[steps > 0].min(initial=np.inf)))
        if smallest <= known:
            return known
    return smallest if np.isfinite(smallest) else known


def check_dead(values: Array, reference: Array, *, share: float) -> Verdict:
    """
    Flag a whole channel that hardly moves while a comparable one does.

    Parameters
    ----------
    values, reference : ndarray, shapes (n,) and (m,)
        Same quantity, unit and axis, as the acceleration of the specimen and of its table.
    share : float
        Smallest standard deviation over that of the reference.
    """
    deviation, expected = float(np.nanstd(values)), float(np.nanstd(reference))
    where = np.full(values.size, deviation < share * expected)
    reason = (
        f"the channel is practically dead: its standard deviation is {deviation:.3g}, that of the table's "
        f"{expected:.3g} in the same unit; check its cable, sensor and range"
    )
    return Verdict(Flag.SUSPECT, where, serious("dead channel", reason))


def check_rails(time: Array, values: Array, *, longest: float = np.inf) -> Verdict:
    """
    Flag samples at a value that the channel does not exceed although it moves fast before and after.

    The top of a parabola fills the band of 8 σ and leaves it slowly. Saturation is flat but for the noise σ, and its
    flanks are steep. What stays for longer than `longest` (s) is held there.
    """
    where, filled = np.zeros(values.size, dtype=bool), filled_in(values, 4 * FIRST)
    if not filled.size:
        return Verdict.good(values.size)
    noise = 0.3 * _or_smallest_step(_typical_bend(filled) / (0.3 * np.sqrt(6.0)), filled)
    resting, low, high = np.array([filled[:FIRST].mean(), filled[-FIRST:].mean()]), filled.min(), filled.max()
    for sign, top, rest in ((1.0, high, resting.max()), (-1.0, -low, -resting.min())):
        if not top - rest > AWAY * (high - low):
            continue
        edge = top - BAND * noise
        starts, stops = stretches(filled > edge if sign > 0.0 else filled < -edge)
        half = (stops - starts) // 2
        is_whole = (stops - starts >= FEWEST_AT_RAIL) & (starts >= half) & (stops + half <= filled.size)
        starts, stops, half = starts[is_whole], stops[is_whole], half[is_whole]
        is_steep = (
            top - np.maximum(sign * filled[starts - half], sign * filled[stops + half - 1]) > STEEP * BAND * noise
        )
        is_steep &= ~(time[stops - 1] - time[starts] > longest)
        for start, stop in zip(starts[is_steep], stops[is_steep], strict=True):
            where[start:stop] |= filled[start + 1 : stop - 1].std() <= LEVEL * noise
    level = float(np.abs(values[where]).max(initial=0.0))
    reason = (
        f"{counted(where)} stay at {level:.4g} (as recorded){first_at(time, where)}, between steep flanks: the channel "
        "saturates, and the value was larger. Its peaks are lower bounds. Choose a larger range"
    )
    return Verdict(Flag.SUSPECT, where, warning("end of the range", reason))


def check_torn(time: Array, values: Array) -> Verdict:
    """Flag what follows a jump, far faster than all other motion, after which a channel that moved stands still."""
    where, filled = np.zeros(values.size, dtype=bool), filled_in(values, 4 * FIRST)
    if not filled.size:
        return Verdict.good(values.size)
    jump, size = max(_largest_steps(filled), key=lambda step: step[1])
    # Two samples on either side belong to it, as a spike comes back.
    before, after = filled[: max(jump - 1, 1)], filled[jump + 3 :]
    stands = after.size > 4 * FIRST and np.ptp(after) < AT_REST * size and np.ptp(before) > MOVED * size
    stands = stands and abs(after[0] - before[-1]) > MOVED * size
    is_gap = time[jump + 1] - time[jump] > FAST * (time[-1] - time[0]) / time.size
    if stands and not is_gap:
        others = (step for part in (before, after) for _, step in _largest_steps(part))
        where[jump + 1 :] = size > FAST * max(others, default=0.0)
    reason = (
        f"it jumps by {size:.4g} (as recorded) at {time[jump + 1]:.4g} s, and stands still from then on: its cable "
        "tore, or its core came off. The peak is a lower bound, and the specimen may have overturned"
    )
    return Verdict(Flag.SUSPECT, where, serious("dead channel", reason))


def _largest_steps(values: Array) -> Iterator[tuple[int, float]]:
    """Where the largest step of each block begins, and its size."""
    for part in blocks(values.size - 1):
        steps = np.abs(np.diff(values[part.start : part.stop + 1]))
        largest = int(steps.argmax())
        yield part.start + largest, float(steps[largest])


def counted(where: Mask) -> str:
    """Say how many samples."""
    return count(int(np.count_nonzero(where)), "sample")


def first_at(time: Array, where: Mask) -> str:
    """Say when the first of these samples was; empty if its time is not known."""
    times = time[where]
    known = times[np.isfinite(times)]
    return f", the first at {known[0]:.4g} s" if known.size else ""
