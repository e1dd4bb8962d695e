"""What looks odd in a valid campaign: reported, never refused."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.specimen import Specimen
from colonnade.dynamics import size
from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.findings import Finding, Severity, warning
from colonnade.units.text import listed, number, quantity

_USED = {"specimen": ("displacement", "angle", "angular_velocity"), "table": ("displacement", "acceleration")}

FAR_OFF = 4.0
"""Of the specimen's pole distance, about half its diagonal: a point further from its base is not on a bracket."""


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
        yield from _far_off(campaign, setup, name)
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


def _far_off(campaign: CampaignFile, setup: str, name: str) -> Iterator[Finding]:
    """Say which transducers of a set-up have a point that cannot be on a specimen."""
    reach = FAR_OFF * campaign.specimens[name].block(STANDARD_GRAVITY).pole_distance
    for channel_name, channel in campaign.setups[setup].channels_of(name).items():
        if channel.is_on_body and channel.at is not None and hypot(*channel.at) > reach:
            yield Finding(
                f"setups.{setup}.channels.{channel_name}.at is {quantity(hypot(*channel.at), 'm', 4)} from the centre "
                f"of the base of {name}, which is far off it. Give a point on it, and check the unit.",
                "geometry",
                Severity.SERIOUS,
                about=f"setups.{setup}",
            )
