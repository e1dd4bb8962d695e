"""The page of one specimen: its properties as given and as derived, at both scales, and its restitution."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import isfinite, tan
from typing import NamedTuple

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from colonnade.campaign import Campaign, Test
from colonnade.campaign.specimen import Specimen
from colonnade.dynamics.block import Block, pair
from colonnade.dynamics.similitude import at_prototype
from colonnade.figures import EstimateGroup, EstimateRow, ImpactSeries, PeakSeries
from colonnade.report import restitution, restitution_charts, wording
from colonnade.report.restitution import EstimateText
from colonnade.report.results import Message, Results

Array = NDArray[np.float64]

SOURCES = {
    "given": "given in the campaign file",
    "identified": "identified from free vibrations",
    "rigid-body": "the rigid-body value, as none is given or identified",
}

_CONTACT_SOURCES = {
    "identified": "e identified from its free vibration",
    "velocity-ratio": "e of its free vibration, the mean velocity ratio, as none could be identified",
}

_DIMENSIONS = ("width", "depth", "height", "diameter", "base_diameter", "top_diameter")

_DERIVED: tuple[tuple[str, str, str, Callable[[Block], float]], ...] = (
    ("tan α", "", "angle", lambda block: tan(block.critical_angle)),
    ("frequency parameter p", "rad/s", "frequency", lambda block: block.p),
    ("uplift acceleration g tan α", "m/s²", "acceleration", lambda block: block.uplift_acceleration),
    ("rigid-body e", "", "angle", lambda block: block.restitution),
)


class Property(NamedTuple):
    """A property: as given, as it follows from the dimensions, as used, and at prototype scale; text for the page."""

    name: str
    given: str
    derived: str
    used: str
    prototype: str


class FreeVibration(NamedTuple):
    """One free vibration: e with its interval, every estimator's, why it was refused, departures, and what is drawn."""

    test: str
    e: str
    estimates: tuple[EstimateText, ...]
    departures: tuple[str, ...]
    reason: str
    rows: Sequence[EstimateRow]
    peaks: PeakSeries | None
    impacts: ImpactSeries | None


@dataclass(frozen=True)
class SpecimenPage:
    """
    Everything that the page of a specimen shows.

    `e` is the value that predictions take, with its interval; `contact` the law of the contact model, name and value.
    """

    id: str
    shape: str
    scale: str
    properties: tuple[Property, ...]
    deviations: tuple[str, ...]
    e: str
    source: str
    rigid: str
    ratio: str
    method: str
    reason: str
    contact: tuple[tuple[str, str], ...]
    warnings: tuple[Message, ...]
    failures: tuple[Message, ...]
    between: str
    free_vibrations: tuple[FreeVibration, ...]
    estimators: Markup | None
    chart: Markup | None
    impacts: Markup | None


def free_vibration(test: Test, results: Results, block: Block) -> FreeVibration:
    """Gather of one free vibration what the page of its specimen shows."""
    return FreeVibration(
        test.id,
        restitution.value_of(results, restitution.STAGE),
        restitution.estimates_of(results),
        restitution.departures_of(results),
        results.text(restitution.STAGE, "reason"),
        restitution.estimate_rows(results),
        restitution_charts.peak_series(test, results, block),
        restitution_charts.impact_series(test, results),
    )


def of_specimen(
    campaign: Campaign,
    name: str,
    pooled: Results,
    free_vibrations: Sequence[FreeVibration],
) -> SpecimenPage:
    """Put a specimen into words; `free_vibrations` are those of its tests."""
    specimen, block = campaign.specimens[name], campaign.block(name)
    value = pooled.value("specimen", "restitution")
    known = value is not None and isfinite(value)
    return SpecimenPage(
        id=name,
        shape=specimen.shape,
        scale="" if specimen.scale is None else f"1:{specimen.scale:g}",
        properties=_properties(specimen, block, campaign.gravity),
        deviations=tuple(specimen.deviations(campaign.gravity)),
        e=restitution.value_of(pooled, "specimen"),
        source=SOURCES.get(
            pooled.text("specimen", "restitution_source"), "failed" if pooled.failures else "not yet known"
        ),
        rigid=wording.number(block.restitution, 4),
        ratio=wording.number(value / block.restitution, 4) if known and value is not None else wording.NOTHING,
        method=pooled.text("specimen", "method"),
        reason=pooled.text("specimen", "reason"),
        contact=_contact(pooled),
        warnings=pooled.warnings,
        failures=pooled.failures,
        free_vibrations=tuple(free_vibrations),
        between=_between(pooled),
        **_drawn(name, pooled, free_vibrations, block),
    )


def _between(pooled: Results) -> str:
    """Write the scatter of e between tests, beside the error within one."""
    between = pooled.value("specimen", "between_test_scatter")
    if between is None or not isfinite(between):
        return ""
    within = pooled.middle("specimen", "test_restitution_standard_error")
    return f"{between:.2g} (standard deviation of e); standard error within a test {wording.number(within, 2)}"


def _contact(pooled: Results) -> tuple[tuple[str, str], ...]:
    """Write the law of contact that gives the specimen's e, and what it acts on."""
    if "contact_stiffness" not in pooled.datasets.get("contact", ()):
        return ()

    def value(name: str) -> float | None:
        return pooled.value("contact", name)

    nodes = pooled.datasets["contact"]
    masses, weights, radii = (nodes[name].to_numpy() for name in ("node_mass", "node_weight", "ring_radius"))
    rings = f"{masses.size} rings of radius {_range(1e3 * radii, 'mm')}, " if radii.any() else f"{masses.size}, "
    return (
        ("body", pooled.text("contact", "body")),
        ("critical damping fraction ξ at a node", wording.number(value("damping_fraction"), 4)),
        ("damping fraction ξ_eff of the whole body", wording.number(value("effective_damping"), 4)),
        (
            "stiffness",
            f"{wording.number(1e-9 * (value('contact_stiffness') or 0.0))} N/mm³: N a mm² of base and mm of depth",
        ),
        ("friction µ", wording.number(value("friction"))),
        ("base nodes", f"{rings}{_range(masses, 'kg')} and {_range(weights, 'N')} each"),
        (
            _CONTACT_SOURCES[pooled.text("contact", "contact_restitution_source")],
            f"{wording.number(value('contact_restitution'), 4)}; {wording.number(value('restitution'), 4)} was wanted",
        ),
        ("mean velocity ratio of the same impacts", wording.number(value("contact_velocity_ratio"), 4)),
        ("step", wording.quantity(value("contact_step"), "µs")),
        ("energy that is missing after it", f"{100 * (value('energy_residual') or 0.0):.2g} % of the largest"),
    )


def _range(values: Array, unit: str) -> str:
    low, high = (wording.number(float(value)) for value in (values.min(), values.max()))
    return f"{low} {unit}" if low == high else f"{low} to {high} {unit}"


def _drawn(
    name: str, pooled: Results, free_vibrations: Sequence[FreeVibration], block: Block
) -> dict[str, Markup | None]:
    groups = [EstimateGroup(each.test, each.rows) for each in free_vibrations]
    together = restitution_charts.pooled_row(pooled)
    if together is not None:
        groups.append(EstimateGroup("all together", [together]))
    peaks = [each.peaks for each in free_vibrations if each.peaks is not None]
    impacts = [each.impacts for each in free_vibrations if each.impacts is not None]
    rigid = block.restitution
    return {
        "estimators": restitution_charts.estimators(f"estimators-{name}", groups, rigid),
        "chart": restitution_charts.peaks(f"peaks-{name}", peaks, block) if peaks else None,
        "impacts": restitution_charts.impacts(f"impacts-{name}", impacts, pooled, "specimen", rigid)
        if impacts
        else None,
    }


def _properties(specimen: Specimen, block: Block, gravity: float) -> tuple[Property, ...]:
    derived, side = specimen.dimensions(gravity), block.governing
    scale = specimen.scale
    rows = [_property("mass m", "kg", "mass", specimen.mass, None, specimen.mass, scale)]
    for name in _DIMENSIONS:
        length = getattr(specimen, name, None)
        if length is not None:
            rows.append(_property(name.replace("_", " "), "mm", "length", length, None, length, scale))
    for label, unit, quantity, name in (
        ("critical angle α", "rad", "angle", "critical_angle"),
        ("pole distance R", "mm", "length", "pole_distance"),
        ("inertia about the pole I₀", "kg m²", "inertia", "inertia"),
    ):
        given = getattr(specimen, name)
        from_dimensions = None if derived is None else float(getattr(derived, name))
        rows.append(_property(label, unit, quantity, given, from_dimensions, float(getattr(side, name)), scale))
    for label, unit, quantity, value in _DERIVED:
        other = None if derived is None else value(derived)
        rows.append(_property(label, unit, quantity, None, other, value(block), scale))
    return tuple(rows)


def _property(
    name: str,
    unit: str,
    quantity: str,
    given: float | tuple[float, float] | None,
    derived: float | None,
    used: float,
    scale: float | None,
) -> Property:
    sides = [] if given is None else list(dict.fromkeys(pair(given)))
    return Property(
        name,
        " and ".join(_written(side, unit) for side in sides) or wording.NOTHING,
        _written(derived, unit),
        _written(used, unit),
        wording.NOTHING if scale is None else _written(at_prototype(quantity, used, scale), unit),
    )


def _written(value: float | None, unit: str) -> str:
    if value is None:
        return wording.NOTHING
    if unit == "mm" and value >= 2.0:
        return wording.quantity(value, "m", 4)
    return wording.quantity(value, unit, 4) if unit not in ("", "kg", "kg m²") else _plain(value, unit)


def _plain(value: float, unit: str) -> str:
    return f"{wording.number(value, 4)} {unit}".rstrip()
