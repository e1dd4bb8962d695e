"""Entries of a valid campaign file that are not used yet, look odd, or cannot be right: reported, never refused."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import hypot, sqrt

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.channel import ALONG, Channel
from colonnade.campaign.specimen import Specimen
from colonnade.dynamics import size
from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.findings import Finding, Severity, note, serious, warning
from colonnade.units.text import format_percent, listed, number, quantity

OFF_SIDE = 0.02
"""Fraction of its radius by which the point of a line of sight may lie off the side of a round specimen."""

BRACKET = 0.25
"""Of the specimen's largest size, by which a point may lie off it: transducers are fixed on brackets."""

FAR_OFF = 1.0
"""Of that size; a point further away is not on a bracket."""

WIDEST_RANGE = 10.0
"""Times the travel of a point until the specimen lies on its side; few transducers are that much too large."""

NARROWEST_RANGE = 0.1
"""Of the travel of a point until the specimen overturns; a transducer that reads less does not see it rock."""

_USED = {
    "specimen": {"displacement", "angle", "angular_velocity"},
    "table": {"displacement", "acceleration"},
}


def notices(campaign: CampaignFile) -> tuple[Finding, ...]:
    """List the warnings of a valid campaign."""
    unused: dict[str, list[str]] = {}
    for what, where in _unused(campaign):
        unused.setdefault(what, []).append(where)
    found = [warning("not used", f"{what} is valid but not used yet ({listed(at, 1)}).") for what, at in unused.items()]
    for name, specimen in campaign.specimens.items():
        found += _density(name, specimen)
        found += [warning("specimen", f"specimens.{name}.{said}") for said in specimen.deviations(campaign.gravity)]
    for setup, name in dict.fromkeys((test.setup, test.specimen) for test in campaign.tests):
        for channel_name, channel in campaign.setups[setup].channels_of(name).items():
            if channel.is_on_body and channel.at is not None:
                told = _of_channel(f"setups.{setup}.channels.{channel_name}", channel, name, campaign.specimens[name])
                found += (replace(each, about=f"setups.{setup}") for each in told)
    return (*found, *_of_tests(campaign))


def _unused(campaign: CampaignFile) -> Iterator[tuple[str, str]]:
    """Give what no stage uses yet, and where it is."""
    for setup_name, setup in campaign.setups.items():
        for name, channel in setup.channels.items():
            place, on = f"setups.{setup_name}.channels.{name}", "specimen" if channel.is_on_body else channel.on
            if channel.quantity == "other":
                continue
            if channel.quantity not in _USED.get(on or "", ()):
                yield f'quantity = "{channel.quantity}" on the {on or "set-up"}', place
            elif on == "table" and channel.direction is not None and max(map(abs, channel.direction)) < ALONG:
                yield "a motion of the table that is not along x, y or z", place


def _of_tests(campaign: CampaignFile) -> Iterator[Finding]:
    for test in campaign.tests:
        if test.kind == "sine" and test.frequency is None:
            text = f"tests[{test.id}] is a sine test without `frequency`: the table's recorded motion will give it."
            yield note("no frequency", text)
        for recorder in campaign.setups[test.setup].recorders:
            if recorder in test.files:
                continue
            text = f'tests[{test.id}] has no file of recorder "{recorder}"; its channels are missing in this test.'
            yield note("no file of a recorder", text)
    if not (campaign.tests or campaign.assessments):
        yield warning("no test", "The campaign has no tests yet.")


def _density(name: str, specimen: Specimen) -> Iterator[Finding]:
    if specimen.volume is None:
        return
    found = specimen.mass / specimen.volume
    if size.is_likely(found):
        return
    unit, count = size.mistaken_lengths(found)
    lengths = {1: "one of the lengths", 2: "two of the lengths", 3: "the lengths"}
    cause = f"were {lengths[count]} in {unit} read as m?" if count else "check the units of its lengths and mass."
    sizes = ", ".join(f"{key} {quantity(value, 'm', 4)}" for key, value in specimen.sizes().items())
    yield Finding(
        f"specimens.{name}: {sizes} and {quantity(specimen.mass, 'kg', 4)} give {number(found, 2)} kg/m³; "
        f"{size.LIGHTEST:g} to {size.HEAVIEST:g} kg/m³ was expected: {cause}",
        "specimen",
        Severity.WARNING if size.FOAM <= found <= size.HEAVIEST else Severity.SERIOUS,
        about=f"specimens.{name}",
    )


def _size(specimen: Specimen) -> tuple[float, float]:
    """Half width and height of a specimen, m; of a measured one those of a prism of the same pole distance."""
    sizes = specimen.sizes()
    if "height" in sizes:
        return max(value for key, value in sizes.items() if key != "height") / 2, sizes["height"]
    side = specimen.block(STANDARD_GRAVITY).governing
    return side.pole_distance, 2 * side.pole_distance


def _of_channel(place: str, channel: Channel, name: str, specimen: Specimen) -> Iterator[Finding]:
    """Say of a transducer whose point is off the specimen, or whose range does not fit what the point travels."""
    half_width, height = _size(specimen)
    x, y, z = channel.at or (0.0, 0.0, 0.0)
    radius, largest = specimen.radius(z), max(height, 2 * half_width)
    off, aside = max(abs(x) - half_width, abs(y) - half_width, z - height, -z), hypot(x, y)
    if off > BRACKET * largest:
        severe = serious if off > FAR_OFF * largest else warning
        yield severe(
            "geometry",
            f"{place}.at is {quantity(off, 'mm', 4)} off {name}, which is {quantity(height, 'mm', 4)} high and "
            f"{quantity(2 * half_width, 'mm', 4)} wide. Give a point on it, measured from the centre of the base, and "
            "check the unit.",
        )
    is_line_of_sight = channel.sensing == "surface" and channel.normal is None
    if is_line_of_sight and radius is not None and abs(aside - radius) > OFF_SIDE * radius:
        yield warning(
            "geometry",
            f"{place}.at is {quantity(aside, 'mm', 4)} from the axis of {name}, but the side is "
            f"{quantity(radius, 'mm', 4)} from the axis at that height. Give the point where the line of sight meets "
            "the side.",
        )
    if channel.quantity != "displacement" or channel.full_scale is None:
        return
    arm, reach = hypot(half_width, z), channel.full_scale
    lying, rocking = sqrt(2) * arm, arm * specimen.block(STANDARD_GRAVITY).critical_angle
    if reach > WIDEST_RANGE * max(lying, 0.1 * height):
        than, travel, end = f"{number(reach / lying, 2)} times", lying, "lies on its side"
    elif reach < NARROWEST_RANGE * rocking:
        than, travel, end = f"{format_percent(reach / rocking, 1)} of", rocking, "overturns"
    else:
        return
    yield warning(
        "gain",
        f"{place}: with its gain and range it reads up to {quantity(reach, 'mm', 4)}, {than} the "
        f"{quantity(travel, 'mm')} that this point of {name} moves until it {end}. Check gain and unit.",
    )
