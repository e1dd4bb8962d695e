"""What a campaign file says that no stage uses yet, and what in it looks odd: reported once per key, never refused."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.channel import ALONG, Channel
from colonnade.campaign.plausible import implausible
from colonnade.campaign.setup import Setup
from colonnade.campaign.specimen import AnySpecimen, Cone, Cylinder
from colonnade.findings import Finding, note, warning

OFF_SIDE = 0.02
"""Fraction of its radius by which the point of a line of sight may lie off the side of a round specimen."""

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
        *(_not_yet(what, places) for what, places in unused.items()),
        *dict.fromkeys(implausible(campaign)),
        *dict.fromkeys(_odd(campaign)),
    )


def _not_yet(what: str, places: list[str]) -> Finding:
    more = f" and {len(places) - 1} more" if len(places) > 1 else ""
    return warning("not used", f"{what} is valid but not used yet ({places[0]}{more}).")


def _unused(campaign: CampaignFile) -> Iterator[tuple[str, str]]:
    for name, setup in campaign.setups.items():
        for channel_name, channel in setup.channels.items():
            for what in _unused_of_channel(channel):
                yield what, f"setups.{name}.channels.{channel_name}"


def _unused_of_channel(channel: Channel) -> Iterator[str]:
    if channel.quantity == "other":
        return
    if channel.quantity not in _USED.get(channel.on or "", ()):
        yield f'quantity = "{channel.quantity}" on the {channel.on or "setup"}'
    elif channel.on == "specimen" and channel.quantity == "acceleration" and channel.at is None:
        yield "an accelerometer on the specimen without `at`"
    elif channel.on == "table" and channel.direction is not None and max(map(abs, channel.direction)) < ALONG:
        yield "a motion of the table that is along none of x, y and z"


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
    if not campaign.tests:
        yield warning("no test", "The campaign has no tests yet.")


def _off_side(setup_name: str, setup: Setup, specimen_name: str, specimen: AnySpecimen) -> Iterator[Finding]:
    """Tell of lines of sight at the side of a round specimen whose point is not on it."""
    for name, channel in setup.channels.items():
        if channel.sensing != "surface" or channel.normal is not None or channel.at is None:
            continue
        x, y, z = channel.at
        match specimen:
            case Cylinder():
                radius = specimen.diameter / 2
            case Cone():
                taper = (specimen.top_diameter - specimen.base_diameter) / specimen.height
                radius = (specimen.base_diameter + taper * z) / 2
            case _:
                continue
        if abs(hypot(x, y) - radius) > OFF_SIDE * radius:
            yield warning(
                "geometry",
                f"setups.{setup_name}.channels.{name}.at is {1e3 * hypot(x, y):.4g} mm from the axis of "
                f"{specimen_name}, whose side is {1e3 * radius:.4g} mm from it there; the point where the line of "
                "sight meets it was expected.",
            )
