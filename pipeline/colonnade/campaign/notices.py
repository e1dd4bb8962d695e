"""What looks odd in a valid campaign: reported, never refused."""

from __future__ import annotations

from collections.abc import Iterator

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.specimen import Specimen
from colonnade.dynamics import size
from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.findings import Finding, Severity, warning
from colonnade.units.text import listed, number, quantity

BRACKET = 0.25
"""Of the specimen's largest size, by which a point may lie off it: transducers are fixed on brackets."""

_USED = {"specimen": ("displacement", "angle", "angular_velocity"), "table": ("displacement", "acceleration")}

FAR_OFF = 1.0
"""Of that size; a point further away is not on a bracket."""


def notices(campaign: CampaignFile) -> Iterator[Finding]:
    """Give the warnings of a valid campaign."""
    unused: dict[str, list[str]] = {}
    for setup_name, set_up in campaign.setups.items():
        for channel_name, channel in set_up.channels.items():
            on = "specimen" if channel.is_on_body else channel.on or "set-up"
            if channel.quantity != "other" and channel.quantity not in _USED.get(on, ()):
                what = f'quantity = "{channel.quantity}" on the {on}'
                unused.setdefault(what, []).append(f"setups.{setup_name}.channels.{channel_name}")
    for what, places in unused.items():
        yield warning("not used", f"{what} is valid but not used yet ({listed(places, 1)}).")
    for name, specimen in campaign.specimens.items():
        yield from _density(name, specimen)
        for said in specimen.deviations(campaign.gravity):
            yield warning("specimen", f"specimens.{name}.{said}")
    for setup, name in dict.fromkeys((test.setup, test.specimen) for test in campaign.tests):
        yield from _places(campaign, setup, name)
    if not (campaign.tests or campaign.assessments):
        yield warning("no test", "The campaign has no tests yet.")


def _density(name: str, specimen: Specimen) -> Iterator[Finding]:
    if specimen.volume is None:
        return
    found = specimen.mass / specimen.volume
    if size.LIGHTEST <= found <= size.HEAVIEST:
        return
    sizes = ", ".join(f"{key} {quantity(value, 'm', 4)}" for key, value in specimen.sizes().items())
    yield Finding(
        f"specimens.{name}: {sizes} and {quantity(specimen.mass, 'kg', 4)} give {number(found, 2)} kg/m³; "
        f"{size.LIGHTEST:g} to {size.HEAVIEST:g} kg/m³ was expected: check the units of its lengths (mm read as m?) "
        "and of its mass.",
        "specimen",
        Severity.WARNING if size.FOAM <= found <= size.HEAVIEST else Severity.SERIOUS,
        about=f"specimens.{name}",
    )


def _places(campaign: CampaignFile, setup: str, name: str) -> Iterator[Finding]:
    """Say which transducers of a set-up have a point that is off a specimen."""
    specimen = campaign.specimens[name]
    sizes, side = specimen.sizes(), specimen.block(STANDARD_GRAVITY).governing
    # Of a measured specimen only the pole distance is known: it is as large as a prism that has it.
    half_width = max((each for key, each in sizes.items() if key != "height"), default=2 * side.pole_distance) / 2
    height = sizes.get("height", 2 * side.pole_distance)
    largest = max(height, 2 * half_width)
    for channel_name, channel in campaign.setups[setup].channels_of(name).items():
        if not channel.is_on_body or channel.at is None:
            continue
        x, y, z = channel.at
        off = max(abs(x) - half_width, abs(y) - half_width, z - height, -z)
        if off > BRACKET * largest:
            yield Finding(
                f"setups.{setup}.channels.{channel_name}.at is {quantity(off, 'mm', 4)} off {name}, which is "
                f"{quantity(height, 'mm', 4)} high and {quantity(2 * half_width, 'mm', 4)} wide. Give a point on it, "
                "measured from the centre of the base, and check the unit.",
                "geometry",
                Severity.SERIOUS if off > FAR_OFF * largest else Severity.WARNING,
                about=f"setups.{setup}",
            )
