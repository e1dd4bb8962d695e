"""Entries of a valid campaign file that are not used yet, look odd, or cannot be right: reported, never refused."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import hypot, pi, sin

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.channel import ALONG, Channel
from colonnade.campaign.setup import Setup
from colonnade.campaign.specimen import Specimen
from colonnade.dynamics import size
from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.findings import Finding, note, serious, warning
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
    "specimen": {"displacement", "angle", "angular_velocity", "acceleration"},
    "table": {"displacement", "acceleration"},
}


def notices(campaign: CampaignFile) -> tuple[Finding, ...]:
    """
    List the warnings of a valid campaign.

    Parameters
    ----------
    campaign : CampaignFile

    Returns
    -------
    warnings : tuple of Finding
    """
    unused: dict[str, list[str]] = {}
    for what, where in _unused(campaign):
        unused.setdefault(what, []).append(where)
    return (
        *(warning("not used", f"{what} is valid but not used yet ({listed(at, 1)}).") for what, at in unused.items()),
        *dict.fromkeys(_implausible(campaign)),
        *dict.fromkeys(_odd(campaign)),
    )


def _unused(campaign: CampaignFile) -> Iterator[tuple[str, str]]:
    """Give what no stage uses yet, and where it is."""
    for setup_name, setup in campaign.setups.items():
        for name, channel in setup.channels.items():
            place, on = f"setups.{setup_name}.channels.{name}", "specimen" if channel.is_on_body else channel.on
            if channel.quantity == "other":
                continue
            if channel.quantity not in _USED.get(on or "", ()):
                yield f'quantity = "{channel.quantity}" on the {on or "set-up"}', place
            elif channel.quantity == "acceleration" and on == "specimen" and channel.at is None:
                yield "an accelerometer on the specimen without `at`", place
            elif on == "table" and channel.direction is not None and max(map(abs, channel.direction)) < ALONG:
                yield "a motion of the table that is not along x, y or z", place


def _odd(campaign: CampaignFile) -> Iterator[Finding]:
    for name, specimen in campaign.specimens.items():
        for deviation in specimen.deviations(campaign.gravity):
            yield warning("specimen", f"specimens.{name}.{deviation}")
    for test in campaign.tests:
        if test.kind == "sine" and test.frequency is None:
            text = f"tests[{test.id}] is a sine test without `frequency`: the table's recorded motion will give it."
            yield note("no frequency", text)
        setup = campaign.setups[test.setup]
        yield from _off_side(test.setup, setup, test.specimen, campaign.specimens[test.specimen])
        for recorder in setup.recorders:
            if recorder not in test.files:
                text = f'tests[{test.id}] has no file of recorder "{recorder}"; its channels are missing in this test.'
                yield note("no file of a recorder", text)
    if not (campaign.tests or campaign.assessments):
        yield warning("no test", "The campaign has no tests yet.")


def _off_side(setup_name: str, setup: Setup, specimen_name: str, specimen: Specimen) -> Iterator[Finding]:
    """Report lines of sight whose point is not on the side of a round specimen."""
    for name, channel in setup.channels.items():
        if channel.sensing != "surface" or channel.normal is not None or channel.at is None:
            continue
        x, y, z = channel.at
        off, radius = hypot(x, y), specimen.radius(z)
        if radius is not None and abs(off - radius) > OFF_SIDE * radius:
            yield warning(
                "geometry",
                f"setups.{setup_name}.channels.{name}.at is {quantity(off, 'mm', 4)} from the axis of {specimen_name}, "
                f"but the side is {quantity(radius, 'mm', 4)} from the axis at that height. Give the point where the "
                "line of sight meets the side.",
            )


def _implausible(campaign: CampaignFile) -> Iterator[Finding]:
    """Report implausible specimens, and implausible channels on the specimens of a set-up."""
    for name, specimen in campaign.specimens.items():
        yield from (replace(found, about=f"specimens.{name}") for found in _density(name, specimen))
    pairs = dict.fromkeys((test.setup, test.specimen) for test in campaign.tests)
    for setup, specimen_name in pairs:
        specimen = campaign.specimens[specimen_name]
        for name, channel in campaign.setups[setup].channels_of(specimen_name).items():
            if channel.is_on_body and channel.at is not None:
                about = (f"setups.{setup}.channels.{name}", channel, specimen_name, specimen)
                yield from (replace(found, about=f"setups.{setup}") for found in (*_place(*about), *_range(*about)))


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
    weight = warning if size.FOAM <= found <= size.HEAVIEST else serious
    yield weight(
        "specimen",
        f"specimens.{name}: {sizes} and {quantity(specimen.mass, 'kg', 4)} give {number(found, 2)} kg/m³; "
        f"{size.LIGHTEST:g} to {size.HEAVIEST:g} kg/m³ was expected: {cause}",
    )


def _size(specimen: Specimen) -> tuple[float, float]:
    """Half width and height of a specimen, m; of a measured one those of a prism of the same pole distance."""
    sizes = specimen.sizes()
    if "height" in sizes:
        return max(value for key, value in sizes.items() if key != "height") / 2, sizes["height"]
    side = specimen.block(STANDARD_GRAVITY).governing
    return side.pole_distance, 2 * side.pole_distance


def _place(place: str, channel: Channel, name: str, specimen: Specimen) -> Iterator[Finding]:
    """Report a transducer whose point is further from the specimen than a bracket reaches."""
    half_width, height = _size(specimen)
    x, y, z = channel.at or (0.0, 0.0, 0.0)
    off = max(abs(x) - half_width, abs(y) - half_width, z - height, -z)
    largest = max(height, 2 * half_width)
    if off <= BRACKET * largest:
        return
    weight = serious if off > FAR_OFF * largest else warning
    yield weight(
        "geometry",
        f"{place}.at is {quantity(off, 'mm', 4)} off {name}, which is {quantity(height, 'mm', 4)} high and "
        f"{quantity(2 * half_width, 'mm', 4)} wide. Give a point on it, measured from the centre of the base, and "
        "check the unit.",
    )


def _range(place: str, channel: Channel, name: str, specimen: Specimen) -> Iterator[Finding]:
    """Report a displacement transducer whose range does not fit the specimen's travel."""
    if channel.quantity != "displacement" or channel.at is None or channel.full_scale is None:
        return
    half_width, height = _size(specimen)
    arm, reach = hypot(half_width, channel.at[2]), channel.full_scale
    lying, rocking = 2 * arm * sin(pi / 4), arm * specimen.block(STANDARD_GRAVITY).critical_angle
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
