"""Mistakes that show by what undoing them does: transducers exchanged, fixed elsewhere, or behind a high-pass."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

import numpy as np
import scipy

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.findings import Finding, serious
from colonnade.identification.plausibility.comparison import LEAST_LOST
from colonnade.identification.plausibility.factors import as_expected
from colonnade.identification.plausibility.rotation import Rotation
from colonnade.identification.plausibility.scale import CERTAIN, Scale
from colonnade.signals.stretches import filled_in

BETTER = 4.0
"""Times less that has to be left unexplained without the mistake."""

LEAST = 0.01
"""Of what the least of them moves, that is left unexplained with it."""


CORNERS = np.geomspace(0.02, 3.0, 8)
"""Hz, of a high-pass that a transducer alone is looked for behind."""

FOLLOWS = 0.01
"""Relative standard error of its scale, with which its record follows the equation of motion."""


def undone(interval: float, rotation: Rotation, acceleration: Array | None, block: Block) -> Finding | None:
    """Name the one mistake without which transducers agree on one rotation, and far better; see `suspicions`."""
    if len(rotation.names) == 1:
        return _coupled_alone(interval, rotation, acceleration, block)
    before, moved = rotation.residual(), float(np.nanstd(rotation.readings, axis=1).min())
    found: dict[float, Finding] = {}
    for named, changed in (*_exchanged(rotation), *_refixed(rotation), *_coupled(interval, rotation)):
        after = changed.residual()
        if before < LEAST * moved or not before > BETTER * after:
            continue
        scales = changed.scales(interval, acceleration, block)
        # What agrees by chance, or with a block that walks, does not obey the equation of motion as well.
        proved = named.kind == "geometry" or all(each.is_known for each in scales)
        if proved and all(as_expected(each.value) for each in scales if each.is_known):
            fall = f"their residual about one rotation falls from {1e3 * before:.2g} to {1e3 * after:.2g} mm"
            found[after] = replace(named, text=f"{named.text}, {fall}")
    return found[min(found)] if found else None


def _exchanged(rotation: Rotation) -> Iterator[tuple[Finding, Rotation]]:
    for first, second in combinations(range(len(rotation.names)), 2):
        for with_gains, what in ((False, "columns"), (True, "places")):
            names = f"{rotation.names[first]} and {rotation.names[second]}"
            text = f"channels {names} look swapped: with their {what} exchanged"
            yield serious("swapped channels", text), rotation.exchanged(first, second, with_gains=with_gains)


def _refixed(rotation: Rotation) -> Iterator[tuple[Finding, Rotation]]:
    """Some of the transducers on the ground and not on the table, or the reverse."""
    if rotation.refixed is None:
        return
    every = range(len(rotation.names))
    for chosen in (each for count in every for each in combinations(every, count + 1)):
        readings = rotation.readings.copy()
        readings[list(chosen)] -= rotation.refixed[list(chosen)]
        names = " and ".join(rotation.names[index] for index in chosen)
        text = (
            f"channel{'s' if len(chosen) > 1 else ''} {names}: `relative_to` is wrong, the table for the ground or the "
            "reverse: with the table's displacement taken off or added"
        )
        yield serious("geometry", text), replace(rotation, readings=readings)


def _coupled(interval: float, rotation: Rotation) -> Iterator[tuple[Finding, Rotation]]:
    """Each behind a high-pass of the first order, r' = r + ω∫r dt, with the ω that leaves least; from either end."""
    misfit = rotation.misfit()
    for index, name in enumerate(rotation.names):
        integral = np.cumsum(filled_in(rotation.readings[index])) * interval
        for start in (integral[0], integral[-1]):
            lost = np.zeros_like(rotation.readings)
            lost[index] = integral - start
            effect = replace(rotation, readings=rotation.readings + lost).misfit() - misfit
            corner = -float(np.nansum(effect * misfit) / max(float(np.nansum(effect**2)), 1e-300))
            if corner > 0:
                text = f"{_cut_off(name, corner)}, which shows as a slide: with that undone"
                yield serious("AC coupling", text), replace(rotation, readings=rotation.readings + corner * lost)


def _cut_off(name: str, corner: float) -> str:
    return (
        f"channel {name} does not hold a constant value (AC-coupled, or a high-pass of {corner / (2 * np.pi):.2g} Hz)"
    )


def _coupled_alone(interval: float, rotation: Rotation, acceleration: Array | None, block: Block) -> Finding | None:
    """The same of one transducer, whose record the equation of motion then explains far better."""
    integral = np.cumsum(filled_in(rotation.readings[0])) * interval

    def scale(hertz: float) -> Scale:
        """Of the two ends that the high-pass may be undone from, that which follows the equation better."""
        undone_from = (rotation.readings + 2 * np.pi * hertz * (integral - end) for end in (integral[0], integral[-1]))
        found = (replace(rotation, readings=each).scales(interval, acceleration, block)[0] for each in undone_from)
        return min(found, key=error)

    def error(found: Scale) -> float:
        return found.error / found.value if found.is_known else 1.0

    before = min(error(rotation.scales(interval, acceleration, block)[0]), CERTAIN)
    if before < FOLLOWS / BETTER:
        return None
    coarse = [error(scale(hertz)) for hertz in CORNERS]
    best, step = int(np.argmin(coarse)), float(np.log(CORNERS[1] / CORNERS[0]))
    if not coarse[best] < before:
        return None
    near = scipy.optimize.minimize_scalar(
        lambda change: error(scale(CORNERS[best] * np.exp(change))),
        bounds=(-step if best else 0.0, step),
        method="bounded",
        options={"xatol": 0.02},
    )
    hertz = float(CORNERS[best] * np.exp(near.x))
    found, added = scale(hertz), 2 * np.pi * hertz * float(np.ptp(integral))
    is_seen = added > LEAST_LOST * float(np.nanmax(np.abs(rotation.readings[0])))
    if not (is_seen and error(found) < min(FOLLOWS, before / BETTER) and as_expected(found.value)):
        return None
    return serious(
        "AC coupling",
        f"{_cut_off(rotation.names[0], 2 * np.pi * hertz)}: with that undone its record follows the equation of motion "
        f"{before / error(found):.2g} times as closely. What it gives as leaning, or as another zero, is that; peaks "
        "are wrong by up to as much. Record its direct (DC) output",
    )
