"""Mistakes that show by what undoing them does: transducers exchanged, fixed elsewhere, or behind a high-pass."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.findings import Finding, serious
from colonnade.identification.plausibility.factors import as_expected
from colonnade.identification.plausibility.rotation import Rotation
from colonnade.signals.stretches import filled_in

BETTER = 4.0
"""Times less that has to be left unexplained without the mistake."""

LEAST = 0.01
"""Of what the least of them moves, that is left unexplained with it."""


def undone(interval: float, rotation: Rotation, acceleration: Array | None, block: Block) -> Finding | None:
    """Name the one mistake without which transducers agree on one rotation, and far better; see `suspicions`."""
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
                text = (
                    f"channel {name} does not hold a constant value (AC-coupled, or a high-pass of "
                    f"{corner / (2 * np.pi):.2g} Hz), which shows as a slide: with that undone"
                )
                yield serious("AC coupling", text), replace(rotation, readings=rotation.readings + corner * lost)
