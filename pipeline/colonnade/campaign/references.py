"""Names that must exist and ids that must differ, in a campaign whose values have all been read."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.channel import MAIN, SURROUNDINGS
from colonnade.campaign.setup import Align, Setup
from colonnade.campaign.syntax.document import Place, unknown
from colonnade.campaign.syntax.fields import shown
from colonnade.campaign.syntax.names import clashes
from colonnade.errors import nearest

Problem = tuple[Place, str]


def dangling(campaign: CampaignFile) -> Iterator[Problem]:
    """Find names that refer to nothing and ids that clash: the place of each, and what is wrong."""
    yield from _clashing(("specimens",), campaign.specimens)
    yield from _clashing(("setups",), campaign.setups)
    yield from _clashing(("assessments",), campaign.assessments)
    for name, setup in campaign.setups.items():
        yield from _setup(("setups", name), setup, ("specimen", *SURROUNDINGS, *campaign.specimens))
    for name in campaign.prototype:
        yield from unknown(("prototype", name), "specimen", name, campaign.specimens)
    for name, assessment in campaign.assessments.items():
        place = ("assessments", name, "specimen")
        yield from unknown(place, "specimen", assessment.specimen, campaign.specimens)
        if assessment.specimen in campaign.specimens and assessment.specimen not in campaign.prototype:
            yield (
                place,
                f"[prototype.{assessment.specimen}] is missing. It says what is assumed of the real column; its "
                '`restitution` at least was expected: a number, "rigid-body", or "identified" to take that of the '
                "model.",
            )
    for index, test_id, earlier in clashes(test.id for test in campaign.tests):
        only = f'It differs from "{earlier}" only in upper and lower case'
        same = "This id is used twice" if test_id == earlier else only
        yield ("tests", index, "id"), f"{shown(test_id)}: {same}. Give every test its own id."
    for index, test in enumerate(campaign.tests):
        yield from unknown(("tests", index, "specimen"), "specimen", test.specimen, campaign.specimens)
        yield from unknown(("tests", index, "setup"), "setup", test.setup, campaign.setups)
        if test.setup in campaign.setups:
            where, known = f' in set-up "{test.setup}"', campaign.setups[test.setup].recorders
            for recorder in test.files:
                yield from unknown(("tests", index, "file", recorder), "recorder", recorder, known, where)
    yield from _faces(campaign)


def _clashing(place: Place, names: Iterable[str], *, as_variables: bool = False) -> Iterator[Problem]:
    same = "case or in '.', '-' and '_'" if as_variables else "upper and lower case"
    for _, name, earlier in clashes(names, as_variables=as_variables):
        yield (*place, name), f'This id differs from "{earlier}" only in {same}. Choose another.'


def _setup(place: Place, setup: Setup, bodies: Collection[str]) -> Iterator[Problem]:
    yield from _clashing((*place, "channels"), setup.channels, as_variables=True)
    yield from _clashing((*place, "recorders"), setup.further_recorders)
    for name, channel in setup.channels.items():
        where = (*place, "channels", name)
        yield from unknown((*where, "recorder"), "recorder", channel.recorder, setup.recorders, " in this set-up")
        if channel.on is not None:
            yield from unknown((*where, "on"), "body", channel.on, bodies)
    for name, recorder in setup.further_recorders.items():
        if not isinstance(recorder.clock, Align):
            continue
        where = (*place, "recorders", name, "clock", "align")
        for linked, owner in ((recorder.clock.channel, MAIN), (recorder.clock.own_channel, name)):
            own = [each for each, channel in setup.channels.items() if channel.recorder == owner]
            if linked not in setup.channels:
                yield where, f"Unknown channel {shown(linked)} in this set-up.{nearest(linked, own)}"
            elif linked not in own:
                yield where, f'{shown(linked)} is not a channel of recorder "{owner}".{nearest(linked, own)}'


def _faces(campaign: CampaignFile) -> Iterator[Problem]:
    """Find transducers that look at the face of a specimen that is not round, without its normal."""
    found = set()
    for test in campaign.tests:
        specimen, setup = campaign.specimens.get(test.specimen), campaign.setups.get(test.setup)
        if specimen is None or setup is None or specimen.shape not in ("prism", "measured"):
            continue
        for name, channel in setup.channels.items():
            place = ("setups", test.setup, "channels", name, "normal")
            if channel.sensing == "surface" and channel.normal is None and place not in found:
                found.add(place)
                yield (
                    place,
                    f'It is missing. Specimen "{test.specimen}" is not round, so a "surface" transducer '
                    "needs the outward normal of the face that it looks at, such as [1, 0, 0].",
                )
