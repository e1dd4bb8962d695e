"""Departures of a free vibration from plane rocking with one e: named, quantified, and left out of the fit."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from colonnade.arrays import Array, Mask
from colonnade.dynamics.block import Block
from colonnade.identification.restitution.arcs.series import ArcSeries, arc_series
from colonnade.identification.restitution.departures.contacts import find_bouncing, find_sliding
from colonnade.identification.restitution.departures.first_cycles import out_of_plane_share, signature
from colonnade.identification.restitution.departures.two_sides import FEWEST_ARCS as FEWEST_COMPARED
from colonnade.identification.restitution.departures.two_sides import LEAST_TILT, OFFSET, compare_sides, sides_problem
from colonnade.identification.restitution.result import Departure

__all__ = ["Departure", "find_departures"]

FEWEST_ARCS = 3

MOST_CORRECTIONS = 4
SMALLEST_CORRECTION = 0.3
"""Standard errors of the zero offset: it is corrected until less is left, at most `MOST_CORRECTIONS` times."""


def find_departures(
    time: Array,
    angle: Array,
    block: Block,
    *,
    impact_time: Array,
    impact_standard_error: Array,
    peak_angle: Array,
    peak_standard_error: Array,
    used: Mask,
    out_of_plane: ArrayLike | None = None,
    slide: ArrayLike | None = None,
    uplift: ArrayLike | None = None,
    least_tilt: float = LEAST_TILT,
) -> tuple[Departure, ...]:
    """
    Find how a free vibration departs from plane rocking of a rigid block with one e.

    Parameters
    ----------
    time, angle : ndarray, shape (m,)
        s, increasing; rad, about the rest position. Missing samples are NaN.
    block : Block
    impact_time, impact_standard_error : ndarray, shape (n + 1,)
        Times at which the angle passes its zero, before and after each of n arcs, and their standard errors, s.
    peak_angle, peak_standard_error : ndarray, shape (n,)
        θ of each arc's peak, signed, from the same zero, and its standard error, rad.
    used : ndarray of bool, shape (n,)
        Arcs to look at; the others are counted, and left alone.
    out_of_plane : array_like, shape (m,), optional
        Rotation about x, rad.
    slide, uplift : array_like, shape (m,), optional
        Displacement of the pole relative to the table, and height of the base's lowest point, m.
    least_tilt : float, optional
        Share of α by which the sides have to differ.

    Returns
    -------
    departures : tuple of Departure
        Three-dimensional rocking, sliding, bouncing, unequal restitution, unequal sides, zero drift, as far as found,
        in this order; each threshold stands with the function that finds it.

    Notes
    -----
    Three-dimensional rocking spoils the first, large cycles: with a measured rotation out of the plane it is that, else
    its signature. The two sides are compared by the arcs that are left.
    """
    across, slid, lifted = (
        None if given is None else np.asarray(given, dtype=np.float64) for given in (out_of_plane, slide, uplift)
    )

    def series(first: int, offset: float) -> ArcSeries:
        later = used & (np.arange(used.size) >= first)
        peaks = peak_angle - offset
        return arc_series(
            block, impact_time, impact_standard_error, peaks, peak_standard_error, later, zero_offset=offset
        )

    whole, offset = _about_zero(series, 0, 0.0)
    if whole.number.size < FEWEST_ARCS:
        return ()
    spatial = signature(whole) if across is None else out_of_plane_share(time, across, whole)
    found = [
        spatial,
        None if slid is None else find_sliding(time, angle, slid, block, whole),
        find_bouncing(time, angle, lifted, block, whole),
        *compare_sides(whole if spatial is None else _about_zero(series, spatial.left_out, offset)[0], least_tilt),
    ]
    return tuple(departure for departure in found if departure is not None)


def _about_zero(series: Callable[[int, float], ArcSeries], first: int, offset: float) -> tuple[ArcSeries, float]:
    """
    Give the arcs from a first one on about their own zero, and that zero (rad).

    A zero found from the peaks of sides that are not equal is wrong, by much of a small peak.
    """
    arcs = series(first, offset)
    for _ in range(MOST_CORRECTIONS):
        if arcs.number.size < FEWEST_COMPARED:
            break
        fit = sides_problem(arcs).fit()
        correction = float(fit.coefficients[OFFSET])
        if abs(correction) < SMALLEST_CORRECTION * fit.error(OFFSET):
            break
        # Not beyond the smallest peak in one step: its energy is not linear in the offset.
        reach = 0.5 * float(arcs.peak.min())
        offset += min(max(correction, -reach), reach)
        arcs = series(first, offset)
    return arcs, offset
