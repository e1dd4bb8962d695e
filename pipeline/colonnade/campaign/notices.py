"""Entries of a valid campaign file that are not used yet, look odd, or cannot be right: reported, never refused."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import hypot, pi, sin

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.channel import ALONG, Channel
from colonnade.campaign.setup import Setup
from colonnade.campaign.specimen import AnySpecimen
from colonnade.dynamics import density
from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.findings import Finding, note, serious, warning
from colonnade.units import format_percent
from colonnade.units.text import listed, number, quantity

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
    channels = [
        (f"setups.{name}.channels.{each}", channel)
        for name, setup in campaign.setups.items()
        for each, channel in setup.channels.items()
        if channel.quantity != "other"
    ]
    for place, channel in channels:
        on = "specimen" if channel.is_on_body else channel.on or "set-up"
        if channel.quantity not in _USED.get(on, ()):
            yield f'quantity = "{channel.quantity}" on the {on}', place
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


def _off_side(setup_name: str, setup: Setup, specimen_name: str, specimen: AnySpecimen) -> Iterator[Finding]:
    """Report lines of sight whose point is not on the side of a round specimen."""
    for name, channel in setup.channels.items():
        if channel.sensing != "surface" or channel.normal is not None or channel.at is None:
            continue
        x, y, z = channel.at
        radius = specimen.radius(z)
        if radius is not None and abs(hypot(x, y) - radius) > OFF_SIDE * radius:
            yield warning(
                "geometry",
                f"setups.{setup_name}.channels.{name}.at is {quantity(hypot(x, y), 'mm', 4)} from the axis of "
                f"{specimen_name}, but the side is {quantity(radius, 'mm', 4)} from the axis at that height. Give "
                "the point where the line of sight meets the side.",
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


def _density(name: str, specimen: AnySpecimen) -> Iterator[Finding]:
    if specimen.volume is None:
        return
    found = specimen.mass / specimen.volume
    if density.is_likely(found):
        return
    unit, count = density.mistaken_lengths(found)
    lengths = {1: "one of the lengths", 2: "two of the lengths", 3: "the lengths"}
    cause = f"were {lengths[count]} in {unit} read as m?" if count else "check the units of its lengths and mass."
    sizes = ", ".join(f"{key} {quantity(value, 'm', 4)}" for key, value in specimen.sizes().items())
    weight = warning if density.FOAM <= found <= density.HEAVIEST else serious
    yield weight(
        "specimen",
        f"specimens.{name}: {sizes} and {quantity(specimen.mass, 'kg', 4)} give {number(found, 2)} kg/m³; "
        f"{density.LIGHTEST:g} to {density.HEAVIEST:g} kg/m³ was expected: {cause}",
    )


def _size(specimen: AnySpecimen) -> tuple[float, float]:
    """Half width and height of a specimen, m; of a measured one those of a prism of the same pole distance."""
    sizes = specimen.sizes()
    if "height" in sizes:
        return max(value for key, value in sizes.items() if key != "height") / 2, sizes["height"]
    side = specimen.block(STANDARD_GRAVITY).governing
    return side.pole_distance, 2 * side.pole_distance


def _place(place: str, channel: Channel, name: str, specimen: AnySpecimen) -> Iterator[Finding]:
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


def _range(place: str, channel: Channel, name: str, specimen: AnySpecimen) -> Iterator[Finding]:
    """Report a displacement transducer whose range does not fit the specimen's travel."""
    if channel.quantity != "displacement" or channel.at is None or channel.full_scale is None:
        return
    half_width, height = _size(specimen)
    reach = abs(channel.full_scale)
    arm = hypot(half_width, channel.at[2])
    lying = 2 * arm * sin(pi / 4)
    rocking = arm * specimen.block(STANDARD_GRAVITY).critical_angle
    if reach > WIDEST_RANGE * max(lying, 0.1 * height):
        yield warning(
            "gain",
            f"{place}: with its gain and range it reads up to {quantity(reach, 'mm', 4)}, "
            f"{number(reach / lying, 2)} times the {quantity(lying, 'mm')} that this point of {name} moves until it "
            "lies on its side. Check gain and unit.",
        )
    elif reach < NARROWEST_RANGE * rocking:
        yield warning(
            "gain",
            f"{place}: with its gain and range it reads up to {quantity(reach, 'mm')}, "
            f"{format_percent(reach / rocking, 1)} of the {quantity(rocking, 'mm')} that this point of {name} moves "
            "until it overturns. Check gain and unit.",
        )
