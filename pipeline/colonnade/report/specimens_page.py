"""The page of one specimen: drawings, properties as given and derived, at both scales, and its restitution."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import isfinite, nan, tan
from typing import Any, NamedTuple

from colonnade.arrays import Array
from colonnade.campaign import Campaign
from colonnade.campaign.assembly import APART, Whole
from colonnade.campaign.forms.summary import Warned
from colonnade.campaign.specimen import Specimen
from colonnade.dynamics.block import Block, pair
from colonnade.dynamics.size import at_prototype
from colonnade.figures.drawing import described
from colonnade.findings import in_order
from colonnade.report import addresses, overview
from colonnade.report.overview import TestRow
from colonnade.report.pictures import OfSpecimen
from colonnade.report.test_page.facts import known
from colonnade.store.records.stored import Stored
from colonnade.units.text import NOTHING, acceleration, interval, listed, number, percent, quantity

BOUNDS = ("restitution_low", "restitution_high", "level")

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

_OF_A_SIDE = (
    ("critical angle α", "rad", "angle", "critical_angle"),
    ("pole distance R", "mm", "length", "pole_distance"),
    ("inertia about the pole I₀", "kg m²", "inertia", "inertia"),
)

_DERIVED: tuple[tuple[str, str, str, Callable[[Block], float]], ...] = (
    ("tan α", "", "angle", lambda block: tan(block.critical_angle)),
    ("frequency parameter p", "rad/s", "frequency", lambda block: block.p),
    ("uplift acceleration g tan α", "m/s²", "acceleration", lambda block: block.uplift_acceleration),
    ("rigid-body e", "", "angle", lambda block: block.restitution),
)


Given = float | tuple[float, float] | None
"""A property as the campaign file gives it, for both sides or for each."""


def of_specimen(subject: OfSpecimen, tests: Sequence[TestRow]) -> dict[str, Any]:
    """Put a specimen into words, by the names that templates use; its pictures are of `subject`."""
    campaign, name, pooled = subject.campaign, subject.name, subject.pooled
    specimen, block = campaign.specimens[name], subject.block
    bodies: list[tuple[str, ...]] = []
    deviations = list(specimen.deviations(campaign.gravity))
    e, source, rigid, answer = NOTHING, f"as {APART}", "", ""
    if isinstance(specimen, Whole):
        answer, bodies = _bodies(specimen, campaign.gravity)
        parts = {specimen.placed[name].specimen: made for name, made in specimen.made.items()}
        deviations = [f"{part}: {said}" for part, made in parts.items() for said in made.deviations(campaign.gravity)]
    if not isinstance(specimen, Whole) or specimen.is_in_plane:
        e, rigid = _interval(pooled), number(block.restitution, 4)
        unknown = "failed" if pooled.failures else "not yet known"
        source = SOURCES.get(pooled.text("specimen", "restitution_source"), unknown)
        answer = f"e {e}, {source}"
    over_rigid = pooled.value("specimen", "restitution") / block.restitution if block.restitution else nan
    return {
        "id": name,
        "subject": subject,
        "tests": tests,
        "ladder": overview.ladder(tests),
        "boundaries": overview.boundaries_of(subject.points),
        "shape": specimen.shape,
        "scale": f"1:{specimen.scale:g}" if specimen.scale else "",
        "answer": answer,
        "bodies": bodies,
        "properties": _properties(specimen, block, campaign.gravity),
        "drawings": [drawing_of(campaign, *pair) for pair in campaign.combinations if pair[0] == name],
        "deviations": deviations,
        "e": e,
        "source": source,
        "rigid": rigid,
        "restitution": known(
            [
                ("e", answer.removeprefix("e ")),
                ("rigid-body e, without bounce", rigid),
                ("e over rigid-body e", number(over_rigid, 4)),
                ("scatter between tests", _between(pooled)),
                ("method", pooled.text("specimen", "method")),
                ("remark", pooled.text("specimen", "reason")),
            ]
        ),
        "contact": law_facts(pooled),
        "warnings": [Warned.of(found, explained=explained) for found, explained in in_order(pooled.findings)],
        "failures": pooled.failures,
        "free_vibrations": subject.decays,
    }


def _interval(pooled: Stored) -> str:
    return interval(*(pooled.value("specimen", each) for each in ("restitution", *BOUNDS)))


def _bodies(whole: Whole, gravity: float) -> tuple[str, list[tuple[str, ...]]]:
    """Say which joint opens first, and list the bodies; one on several others opens no joint by itself."""
    assembly, rows = whole.assembly(gravity), list[tuple[str, ...]]()
    opens = {name: gravity * tan(each) for name, each in assembly.critical_angles.items()}
    opens = {name: each for name, each in opens.items() if len(assembly.bodies[name].on) < 2}
    for name, body in assembly.bodies.items():
        specimen, made = whole.placed[name].specimen, whole.made[name]
        sizes = " × ".join(number(1e3 * size, 4) for size in made.sizes().values())
        said = f"{specimen}, {made.shape} {sizes} mm"
        level, least = quantity(assembly.levels[name], "mm"), opens.get(name)
        above = NOTHING if least is None else acceleration(least)
        rows.append((name, said, quantity(made.mass, "kg", 4), listed(body.on) or "table", level, above))
    least = min(opens.values())
    first = [name for name, each in opens.items() if each <= 1.001 * least]
    joint = "joint" if len(first) == 1 else "joints"
    return f"First to open: the {joint} below {listed(first)}, from {acceleration(least)}", rows


def _between(pooled: Stored) -> str:
    """Write the scatter of e between tests, with the error within one."""
    between = pooled.value("specimen", "between_test_scatter")
    within = number(pooled.median("specimen", "test_restitution_standard_error"), 2)
    if not isfinite(between):
        return ""
    return f"{number(between, 2)} (standard deviation of e); standard error within a test {within}"


def law_facts(pooled: Stored) -> list[tuple[str, str]]:
    """Write the law of contact that gives the specimen's e, and what it acts on."""
    if not pooled.has("contact", "contact_stiffness"):
        return []

    def value(name: str) -> float:
        return pooled.value("contact", name)

    masses, weights, radii = (pooled.array("contact", name) for name in ("node_mass", "node_weight", "ring_radius"))
    rings = f"{masses.size} rings of radius {_range(1e3 * radii, 'mm')}, " if radii.any() else f"{masses.size}, "
    return [
        ("body", pooled.text("contact", "body")),
        ("critical damping fraction ξ at a node", number(value("damping_fraction"), 4)),
        ("damping fraction ξ_eff of the whole body", number(value("effective_damping"), 4)),
        ("stiffness", f"{number(1e-9 * value('contact_stiffness'))} N/mm³: N per mm² of base and mm of depth"),
        ("friction µ", number(value("friction"))),
        ("base nodes", f"{rings}{_range(masses, 'kg')} and {_range(weights, 'N')} each"),
        (
            _CONTACT_SOURCES[pooled.text("contact", "contact_restitution_source")],
            f"{number(value('contact_restitution'), 4)}; target {number(value('restitution'), 4)}",
        ),
        ("mean velocity ratio of the same impacts", number(value("contact_velocity_ratio"), 4)),
        ("step", quantity(value("contact_step"), "µs")),
        ("largest gap in the energy balance", f"{percent(value('energy_residual'))} of the largest energy"),
    ]


def _range(values: Array, unit: str) -> str:
    low, high = (number(float(value)) for value in (values.min(), values.max()))
    return f"{low} {unit}" if low == high else f"{low} to {high} {unit}"


def _properties(specimen: Specimen, block: Block, gravity: float) -> list[tuple[str, ...]]:
    """Give each property: as given, as it follows from the dimensions, as used, and at prototype scale."""
    derived, side, rows = specimen.dimensions(gravity), block.governing, list[tuple[str, ...]]()

    def add(name: str, unit: str, dimension: str, used: float, given: Given = None, other: float | None = None) -> None:
        sides = [] if given is None else dict.fromkeys(pair(given))
        at_scale = at_prototype(dimension, used, specimen.scale) if specimen.scale else None
        said = " and ".join(_written(each, unit) for each in sides)
        rows.append((name, said, *(_written(value, unit) for value in (other, used, at_scale))))

    add("mass m", "kg", "mass", specimen.mass, specimen.mass)
    for name in _DIMENSIONS:
        length = getattr(specimen, name, None)
        if length is not None:
            add(name.replace("_", " "), "mm", "length", length, length)
    for label, unit, dimension, name in _OF_A_SIDE:
        other = None if derived is None else float(getattr(derived, name))
        add(label, unit, dimension, float(getattr(side, name)), getattr(specimen, name), other)
    for label, unit, dimension, value in _DERIVED:
        add(label, unit, dimension, value(block), other=None if derived is None else value(derived))
    return rows


def _written(value: float | None, unit: str) -> str:
    if value is None:
        return NOTHING
    if unit in ("", "kg", "kg m²"):
        return f"{number(value, 4)} {unit}".rstrip()
    return quantity(value, "m" if unit == "mm" and value >= 2.0 else unit, 4)


class Drawing(NamedTuple):
    """A drawing as a page shows it: specimen and setup, its address, and what is seen in it."""

    specimen: str
    setup: str
    tests: str
    address: str
    description: str


def drawing_of(campaign: Campaign, specimen: str, setup: str) -> Drawing:
    """Name the drawing of a specimen in a setup; it is not drawn for that."""
    tests = listed(campaign.combinations[specimen, setup])
    said = described.said_of(campaign, specimen, setup)
    return Drawing(specimen, setup, tests, addresses.of_setup(specimen, setup), said)
