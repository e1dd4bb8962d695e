"""Markers at rest: whether each is where its body and its place on that put it."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array, Vector
from colonnade.campaign.setup import Marker, Tracking
from colonnade.dynamics.assembly import Assembly
from colonnade.findings import Finding, serious
from colonnade.stages.parts.inputs import Inputs
from colonnade.store.description import variable_name
from colonnade.units.text import listed, with_minus

if TYPE_CHECKING:
    import xarray as xr

FEWEST = 4
"""Markers with which the places of all are compared."""

MISPLACED = 0.01
"""m, by which a marker may be off its place at rest, relative to the others."""


class MarkerInputs(Inputs):
    """
    A marker.

    Attributes
    ----------
    body : str
    at : (float, float, float)
        From the centre of the body's base, m.
    channels : dict of str to (float, float, float)
        Directions of its three channels by their variables.
    """

    body: str
    at: Vector
    channels: dict[str, Vector]


def markers_of(
    markers: Mapping[str, Marker], tracking: Tracking, recorders: Collection[str]
) -> dict[str, MarkerInputs]:
    """Gather the markers that have a place, of recorders that recorded."""
    return {
        name: MarkerInputs(
            body=each.on,
            at=each.at,
            channels={variable_name(f"{name}_{key}"): axis for key, axis in zip("xyz", tracking.axes, strict=True)},
        )
        for name, each in markers.items()
        if each.at is not None and each.recorder in recorders
    }


def misplaced(conditioned: xr.Dataset, markers: Mapping[str, MarkerInputs], assembly: Assembly) -> list[Finding]:
    """
    Find markers that are not, at rest, where their `on` and `at` put them relative to each other.

    Parameters
    ----------
    conditioned : xr.Dataset
        Result of `condition`: what was taken off each channel at rest is where the marker was.
    markers : mapping of str to MarkerInputs
    assembly : Assembly

    Notes
    -----
    Where the cameras have their origin is not known: the median over all markers is taken for it.
    """
    used = {
        name: each
        for name, each in markers.items()
        if each.body in assembly.bodies
        and all(channel in conditioned and "zero" in conditioned[channel].attrs for channel in each.channels)
    }
    if len(used) < FEWEST:
        return []
    declared = np.array([_declared(each, assembly) for each in used.values()])
    seen = np.array([_seen(each, conditioned) for each in used.values()])
    seen = seen - np.median(seen - declared, axis=0)
    off, names = seen - declared, list(used)
    wrong = np.flatnonzero(np.linalg.norm(off, axis=1) > MISPLACED).tolist()
    if 2 * len(wrong) > len(used):
        text = (
            f"At rest {len(wrong)} of {len(used)} markers are more than {1e3 * MISPLACED:g} mm from where `on` and "
            "`at` put them relative to each other. Check the axes of the tracking, and the unit."
        )
        return [serious("geometry", text)]
    bodies = dict.fromkeys(used[names[each]].body for each in wrong)
    found = []
    for body in bodies:
        own = [each for each, name in enumerate(names) if used[name].body == body]
        mine = [each for each in own if each in wrong]
        where = _along(off[mine].mean(axis=0))
        if mine == own and len(own) > 1 and np.ptp(off[mine], axis=0).max() < MISPLACED:
            text = f"At rest all markers of body {body} are off their places {where}: check the dimensions of the "
            text += "bodies below it, its position, and whether its markers are on it."
        else:
            text = f"At rest {listed([names[each] for each in mine])} on body {body} "
            text += f"{'is' if len(mine) == 1 else 'are'} off the place that `on` and `at` give, {where}."
        found.append(serious("geometry", " ".join((text, *_exchanged(mine, names, declared, seen)))))
    return found


def _declared(marker: MarkerInputs, assembly: Assembly) -> Array:
    """Where a marker is at rest, in the frame of the table, m."""
    return np.append(assembly.bodies[marker.body].position, assembly.levels[marker.body]) + marker.at


def _seen(marker: MarkerInputs, conditioned: xr.Dataset) -> Array:
    """Where the cameras see it at rest, along the axes of the table, m."""
    along = [float(conditioned[name].attrs["zero"]) * np.array(axis) for name, axis in marker.channels.items()]
    return np.asarray(np.sum(along, axis=0))


def _along(off: Array) -> str:
    x, y, z = (with_minus(str(round(each))) for each in (1e3 * off).tolist())
    return f"by {x}, {y} and {z} mm along x, y and z"


def _exchanged(wrong: list[int], names: list[str], declared: Array, seen: Array) -> list[str]:
    """Say of markers that are where another one should be."""
    said = []
    for each in wrong:
        apart = np.linalg.norm(declared - seen[each], axis=1)
        nearest = int(np.argmin(apart))
        if apart[nearest] < MISPLACED and nearest != each:
            said.append(
                f"{names[each]} is where {names[nearest]} should be: are their columns, or their bodies, exchanged?"
            )
    return said
