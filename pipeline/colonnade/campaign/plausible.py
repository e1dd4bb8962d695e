"""What in a campaign's specimens and channels cannot be right: densities, places off the specimen, ranges."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import hypot, pi, sin

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.channel import Channel
from colonnade.campaign.specimen import AnySpecimen, Cone, Cylinder, Prism
from colonnade.dynamics import density
from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.findings import Finding, serious, warning

BRACKET = 0.25
"""Of the specimen's largest size, by which a point may lie off it: transducers are fixed on brackets."""

FAR_OFF = 1.0
"""Of that size; a point further away is not on a bracket."""

WIDEST_RANGE = 10.0
"""Times the travel of a point until the specimen lies on its side; few transducers are that much too large."""

NARROWEST_RANGE = 0.1
"""Of the travel of a point until the specimen overturns; a transducer that reads less does not see it rock."""


def implausible(campaign: CampaignFile) -> Iterator[Finding]:
    """Say of specimens, and of channels on the specimens that a set-up is used with, what cannot be right."""
    for name, specimen in campaign.specimens.items():
        yield from (replace(found, about=f"specimens.{name}") for found in _density(name, specimen))
    pairs = dict.fromkeys((test.setup, test.specimen) for test in campaign.tests)
    for setup, specimen_name in pairs:
        specimen = campaign.specimens[specimen_name]
        for name, channel in campaign.setups[setup].channels.items():
            if channel.on == "specimen" and channel.at is not None:
                about = (f"setups.{setup}.channels.{name}", channel, specimen_name, specimen)
                yield from (replace(found, about=f"setups.{setup}") for found in (*_place(*about), *_range(*about)))


def _density(name: str, specimen: AnySpecimen) -> Iterator[Finding]:
    match specimen:
        case Prism():
            volume = density.prism_volume(specimen.width, specimen.depth, specimen.height)
        case Cylinder():
            volume = density.cone_volume(specimen.diameter, specimen.diameter, specimen.height)
        case Cone():
            volume = density.cone_volume(specimen.base_diameter, specimen.top_diameter, specimen.height)
        case _:
            return
    found = specimen.mass / volume
    if density.is_likely(found):
        return
    unit, count = density.mistaken_lengths(found)
    lengths = {1: "one of the lengths", 2: "two of the lengths", 3: "the lengths"}
    cause = f"were {lengths[count]} in {unit} read as m?" if count else "check the units of its lengths and mass."
    sizes = ", ".join(f"{key} {value:.4g} m" for key, value in specimen.sizes().items())
    weight = warning if density.FOAM <= found <= density.HEAVIEST else serious
    yield weight(
        "specimen",
        f"specimens.{name}: {sizes} and {specimen.mass:.4g} kg give {found:.2g} kg/m³; {density.LIGHTEST:g} to "
        f"{density.HEAVIEST:g} kg/m³ was expected: {cause}",
    )


def _size(specimen: AnySpecimen) -> tuple[float, float]:
    """Half width and height of a specimen, m; of a measured one those of a prism of the same pole distance."""
    sizes = specimen.sizes()
    if "height" in sizes:
        return max(value for key, value in sizes.items() if key != "height") / 2, sizes["height"]
    side = specimen.block(STANDARD_GRAVITY).governing
    return side.pole_distance, 2 * side.pole_distance


def _place(place: str, channel: Channel, name: str, specimen: AnySpecimen) -> Iterator[Finding]:
    """Tell of a transducer whose point is further off the specimen than a bracket reaches."""
    half_width, height = _size(specimen)
    x, y, z = channel.at or (0.0, 0.0, 0.0)
    off = max(abs(x) - half_width, abs(y) - half_width, z - height, -z)
    largest = max(height, 2 * half_width)
    if off <= BRACKET * largest:
        return
    weight = serious if off > FAR_OFF * largest else warning
    yield weight(
        "geometry",
        f"{place}.at is {1e3 * off:.4g} mm off {name}, which is {1e3 * height:.4g} mm high and {2e3 * half_width:.4g} "
        "mm wide; a point on it was expected, measured from the centre of the base. Check the unit.",
    )


def _range(place: str, channel: Channel, name: str, specimen: AnySpecimen) -> Iterator[Finding]:
    """Tell of a displacement transducer whose range in metres is not of the size of the specimen's travel."""
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
            f"{place}: with its gain and range it reads up to {1e3 * reach:.4g} mm, {reach / lying:.2g} times the "
            f"{1e3 * lying:.3g} mm that this point of {name} moves until it lies on its side. Check gain and unit.",
        )
    elif reach < NARROWEST_RANGE * rocking:
        yield warning(
            "gain",
            f"{place}: with its gain and range it reads up to {1e3 * reach:.3g} mm, {reach / rocking:.1%} of the "
            f"{1e3 * rocking:.3g} mm that this point of {name} moves until it overturns. Check gain and unit.",
        )
