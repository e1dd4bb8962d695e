"""Departures of a free vibration from plane rocking of this block with one e: named, with their size."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from colonnade.arrays import Array
from colonnade.identification.restitution.arcs import FEWEST_SAMPLES, growth, noise_level
from colonnade.identification.restitution.estimator import Estimated
from colonnade.identification.restitution.peaks import lift
from colonnade.identification.restitution.record import FEWEST_ARCS, Record
from colonnade.identification.restitution.result import Departure
from colonnade.identification.restitution.scatter import SCATTERS
from colonnade.units.text import format_percent

NOISE_MARGIN = 5.0
"""Standard errors from which on a rotation or a slide is one."""

LARGEST_SHARE = 0.1
"""Of |θ|, up to which a rotation out of the plane is let pass."""

SURE = 4.5
"""Standard errors from which on the sides differ."""

FRICTION = 0.3
"""Coefficient assumed for the energy of a slide; ..."""

LEAST_WORK, LARGEST_WORK = 0.01, 0.1
"""... below the first share of the energy lost it is let pass, above the second there is no e of rocking."""

LEAST_TILT = 0.005
"""Share of α by which the critical angles of the sides differ, halved, at least."""

LEAST_CHANGE, FEWEST_IMPACTS = 0.005, 5
"""Change of e over the speeds of impact that is named if it is sure, and of how many impacts at least."""

LARGEST_SCATTER, SURELY = 0.01, 0.99
"""Standard deviation of e from impact to impact above which, as sure as this, not impacts alone change the energy."""

LEAST_FALL = 2.0
"""Times by which the residual of a history falls with the base turned round, from which it is recorded so."""

MOVING = "moving table"


def find_beside(time: Array, measured: dict[str, Array], record: Record) -> Iterator[Departure]:
    """Look for departures in what was measured beside the angle, on a table at rest."""
    if record.counted.start.size < FEWEST_ARCS:
        return
    if "out_of_plane" in measured:
        yield from find_rotation(time, measured["out_of_plane"], record)
    if "slide" in measured:
        yield from find_sliding(time, measured["angle"] - record.zero, measured["slide"], record)


def find_rotation(time: Array, out_of_plane: Array, record: Record) -> Iterator[Departure]:
    """Hold a measured rotation out of the plane (rad) against the rocking angle of each arc."""
    finite = np.isfinite(out_of_plane)
    if not finite.any():
        return
    time, values = time[finite], out_of_plane[finite] - np.median(out_of_plane[finite])
    noise, seen = noise_level(values), record.counted
    amplitude = np.array([np.abs(values[piece]).max(initial=0.0) for piece in seen.pieces(time, 0.0, 1.0)])
    share = amplitude / seen.height
    large = (share > LARGEST_SHARE) & (amplitude > NOISE_MARGIN * noise)
    if large.any():
        size, error = float(share[large].max()), float(noise / seen.height[np.argmax(np.where(large, share, 0))])
        yield Departure(
            "three-dimensional rocking", size, error, "1",
            f"The block turns out of its plane by up to {format_percent(size)} of the rocking angle (measured), and by "
            f"more than {format_percent(LARGEST_SHARE)} until {seen.end[large][-1]:.3f} s; e is of rocking in the "
            "plane. If it rocks on in its plane, give the test a `window` from then on.",
            refuses=True,
        )  # fmt: skip


def find_sliding(time: Array, angle: Array, slide: Array, record: Record) -> Iterator[Departure]:
    """
    Look for jumps of the pole (m) at impacts, by the work of friction over the energy lost in all impacts.

    Notes
    -----
    The slide of an arc is its mean, after what goes with θ on either side was taken off: a transducer that is not quite
    where it is said to be shows rocking as slide.
    """
    seen, block = record.counted, record.block
    places = [np.arange(piece.start, piece.stop) for piece in seen.pieces(time, 0.1, 0.9)]
    number, place = np.repeat(np.arange(len(places)), [each.size for each in places]), np.concatenate(places)
    number, place = (each[np.isfinite(slide[place] + angle[place])] for each in (number, place))
    count = np.bincount(number, minlength=len(places))
    side = (seen.peak_angle[number] > 0).astype(np.intp)

    def about_mean(values: Array) -> tuple[Array, Array]:
        mean = np.bincount(number, values, count.size) / np.maximum(count, 1)
        return mean, values - mean[number]

    _, turned = about_mean(angle[place])
    slope = np.bincount(side, turned * slide[place], 2) / np.maximum(np.bincount(side, turned**2, 2), 1e-300)
    level, residual = about_mean(slide[place] - slope[side] * angle[place])
    level[count < FEWEST_SAMPLES] = np.nan
    variance = growth(residual, number, int(count.max())) * float(residual @ residual) / max(place.size - count.size, 1)
    jumps, errors = np.diff(level), np.sqrt(variance * (1 / count[1:] + 1 / count[:-1]))
    large = np.abs(jumps) > NOISE_MARGIN * errors
    total, total_error = float(np.abs(jumps[large]).sum()), float(np.sqrt((errors[large] ** 2).sum()))
    ends = seen.peak_angle[[0, -1]]
    speed = block.p_at(ends) * np.sqrt(2 * lift(ends, block.critical_angle_at(ends)))
    lost = float(speed[0] ** 2 - speed[1] ** 2) * block.inertia / 2
    work = FRICTION * block.mass * block.gravity * total / max(lost, 1e-300)
    if not work > LEAST_WORK:
        return
    refuses = work > LARGEST_WORK
    end = "; too much for an e of rocking alone." if refuses else "; e includes this loss."
    yield Departure(
        "sliding", total, total_error, "m",
        f"The block slides at {int(large.sum())} of {jumps.size} impacts, by {1e3 * total:.3g} ± "
        f"{1e3 * total_error:.1g} mm in all: with a friction of {FRICTION:g} this is {format_percent(work)} of the "
        "energy lost" + end,
        refuses=refuses,
    )  # fmt: skip


def scatters(found: Estimated) -> bool:
    """Whether e of single impacts scatters more than impacts alone explain, beyond any change with their speed."""
    if found.path.count <= FEWEST_IMPACTS:
        return False
    large = found.restitution * SCATTERS > LARGEST_SCATTER
    return bool(found.answer.weights[large].sum() > SURELY)


def find_turned(turned: Estimated | None, *others: Estimated | None) -> Iterator[Departure]:
    """Name a base whose acceleration explains the angle with its sign turned only: as recorded it would bend e."""
    if turned is None:
        return
    residual, *rest = (float(each.path.power**0.5) for each in (turned, *others) if each is not None)
    best = min(rest, default=np.inf)
    if best < LEAST_FALL * residual:
        return
    yield Departure(
        MOVING, best, residual, "rad",
        f"With the sign of the table's acceleration turned, a history follows the angle to {1e3 * residual:.2g} mrad; "
        "as recorded, or with a table at rest, none does nearly as well. Correct the `direction` of the accelerometer "
        "or of the transducers, or the sign of a gain.",
        refuses=True,
    )  # fmt: skip


def find_within(found: Estimated, *, driven: bool) -> Iterator[Departure]:
    """
    Look for departures in what a history says.

    Named are critical angles of the sides that differ, on a table at rest; an e of single impacts that scatters more
    than impacts do, or that changes with their speed.
    """
    tilt, error = found.tilt
    if not driven and abs(tilt) >= max(SURE * error, LEAST_TILT):
        critical = float(np.prod([side.critical_angle for side in found.path.block.sides]) ** 0.5)
        yield Departure(
            "unequal sides", tilt * critical, error * critical, "rad",
            f"The critical angles of the two sides differ by 2 × ({1e3 * tilt * critical:+.2f} ± "
            f"{1e3 * error * critical:.2f}) mrad from those of the block: arcs on one side last longer than on the "
            "other at the same peak. The table is tilted by as much, or the block is not as symmetric as given "
            "(table_tilt, critical_angle). e allows for it.",
        )  # fmt: skip
    if scatters(found):
        e, scatter = found.path.restitution, found.restitution * found.answer.scatter
        yield Departure(
            MOVING, scatter, scatter / (2 * e.size) ** 0.5, "1",
            f"e of single impacts scatters by {scatter:.3g}, from {e.min():.3f} to {e.max():.3f}; up to "
            f"{LARGEST_SCATTER:g} was expected of impacts alone: the table moves, and not as recorded, or somebody "
            "touched the block, or a transducer slipped. No value is given; record the table's acceleration (on = "
            '"table", quantity = "acceleration") with the right gain, sign and clock, or repeat the test on a table at '
            "rest.",
            refuses=True,
        )  # fmt: skip
    elif found.has_trend and found.restitution * abs(found.trend[0]) > LEAST_CHANGE:
        change, error = (found.restitution * each for each in found.trend)
        yield Departure(
            "speed-dependent restitution", change, error, "1",
            f"e is not constant: it changes by {change:+.4f} ± {error:.4f} from the slowest to the fastest impact; the "
            "value given is the mean over the impacts seen.",
        )  # fmt: skip
