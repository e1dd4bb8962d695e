"""What a campaign file says that no stage uses yet, and what in it looks odd: told once a key, never refused."""

from __future__ import annotations

from collections.abc import Iterator

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.channel import Channel

_ALONG_X = 1e-6


def notices(campaign: CampaignFile) -> tuple[str, ...]:
    """
    List the warnings of a valid campaign.

    Parameters
    ----------
    campaign : CampaignFile

    Returns
    -------
    warnings : tuple of str
    """
    unused: dict[str, list[str]] = {}
    for what, where in _unused(campaign):
        unused.setdefault(what, []).append(where)
    return (*(_not_yet(what, places) for what, places in unused.items()), *_odd(campaign))


def _not_yet(what: str, places: list[str]) -> str:
    more = f" and {len(places) - 1} more" if len(places) > 1 else ""
    return f"{what} is understood but not yet used ({places[0]}{more})."


def _unused(campaign: CampaignFile) -> Iterator[tuple[str, str]]:
    for name, specimen in campaign.specimens.items():
        if specimen.scale is not None:
            yield "scale", f"specimens.{name}"
    for name, setup in campaign.setups.items():
        if setup.table_tilt is not None:
            yield "table_tilt", f"setups.{name}"
        for channel_name, channel in setup.channels.items():
            for what in _unused_of_channel(channel):
                yield what, f"setups.{name}.channels.{channel_name}"
    for test in campaign.tests:
        if test.time_scale is not None:
            yield "time_scale", f"tests[{test.id}]"


def _unused_of_channel(channel: Channel) -> Iterator[str]:
    if channel.sensing != "point":
        yield f'sensing = "{channel.sensing}"'
    if channel.normal is not None:
        yield "normal"
    if channel.anchor is not None:
        yield "anchor"
    used = {"displacement"} if channel.on == "specimen" else {"displacement", "acceleration"}
    if channel.quantity == "other":
        return
    if channel.quantity not in used or channel.on == "ground":
        yield f'quantity = "{channel.quantity}" on the {channel.on or "setup"}'
    elif channel.direction is not None:
        across, along = abs(channel.direction[1]), abs(channel.direction[0])
        if channel.on == "specimen" and across > _ALONG_X:
            yield "a displacement out of the plane of rocking"
        if channel.on == "table" and along < _ALONG_X:
            yield "a motion of the table that is not along x"


def _odd(campaign: CampaignFile) -> Iterator[str]:
    for name, specimen in campaign.specimens.items():
        for deviation in specimen.deviations(campaign.gravity):
            yield f"specimens.{name}.{deviation}"
    for test in campaign.tests:
        if test.kind == "sine" and test.frequency is None:
            yield f"tests[{test.id}] is a sine test without frequency, so it gets no frequency ratio."
        setup = campaign.setups[test.setup]
        for recorder in setup.recorders:
            if recorder not in test.files:
                yield f'tests[{test.id}] has no file of recorder "{recorder}"; its channels are absent in this test.'
    if not campaign.tests:
        yield "There is no test yet."
