"""Names that must exist and ids that must differ, in a campaign whose values have all been read."""

from __future__ import annotations

from collections.abc import Iterable

from colonnade.campaign.assembly import RESERVED, Whole
from colonnade.campaign.assessment import Assessment
from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.channel import MAIN, SURROUNDINGS
from colonnade.campaign.setup import Setup
from colonnade.campaign.specimen import ROUND
from colonnade.campaign.syntax.document import Place, unknown
from colonnade.campaign.syntax.fields import shown
from colonnade.campaign.syntax.names import clashes
from colonnade.campaign.syntax.table import Problems


def dangling(campaign: CampaignFile) -> Problems:
    """Find names that refer to nothing and ids that clash: the place of each, and what is wrong."""
    for table in ("specimens", "setups", "assessments"):
        yield from _clashing((table,), getattr(campaign, table))
    yield from _assemblies(campaign)
    for name, setup in campaign.setups.items():
        yield from _setup(("setups", name), setup, campaign)
    for name in campaign.prototype:
        yield from unknown(("prototype", name), "specimen", name, campaign.specimens)
    for name, assessment in campaign.assessments.items():
        yield from unknown(("assessments", name, "specimen"), "specimen", assessment.specimen, campaign.specimens)
        if assessment.specimen in campaign.specimens:
            yield from _assessed(campaign, name, assessment)
    yield from _clashing(("tests",), (test.id for test in campaign.tests))
    for index, test in enumerate(campaign.tests):
        yield from unknown(("tests", index, "specimen"), "specimen", test.specimen, campaign.specimens)
        yield from unknown(("tests", index, "setup"), "setup", test.setup, campaign.setups)
        if test.setup in campaign.setups:
            where, known = f' in set-up "{test.setup}"', campaign.setups[test.setup].recorders
            for recorder in test.files:
                yield from unknown(("tests", index, "file", recorder), "recorder", recorder, known, where)
    yield from _faces(campaign)


def _assessed(campaign: CampaignFile, name: str, assessment: Assessment) -> Problems:
    """Find what an assessment of one block needs, and one of several bodies."""
    specimen, place = assessment.specimen, ("assessments", name)
    if campaign.specimens[specimen].is_in_plane:
        if specimen not in campaign.prototype:
            yield (
                (*place, "specimen"),
                f"[prototype.{specimen}] is missing. It says what is assumed of the real column; its `restitution` at "
                'least was expected: a number, "rigid-body", or "identified" to take that of the model.',
            )
        if assessment.displaced is not None:
            yield (*place, "displaced"), f"It is for several bodies, and {specimen} rocks as one block. Leave it out."
        return
    if specimen in campaign.prototype:
        yield (
            ("prototype", specimen),
            f"The bodies of {specimen} do not rock as one block, so that it has no e, α and p. Leave this table out; "
            "friction and damping are those of [processing.predict.contact].",
        )
    if assessment.levels is None:
        message = f"It is missing. A history of the bodies of {specimen} takes minutes, so that none is run to find it."
        yield (*place, "levels"), message


def _clashing(place: Place, names: Iterable[str], *, as_variables: bool = False) -> Problems:
    same = "upper and lower case, '.', '-' and '_'" if as_variables else "upper and lower case"
    for index, name, earlier in clashes(names, as_variables=as_variables):
        where = (index, "id") if place == ("tests",) else (name,)
        yield (*place, *where), f'The id "{earlier}" is taken, and {same} do not tell ids apart. Choose another.'


def _setup(place: Place, setup: Setup, campaign: CampaignFile) -> Problems:
    against = (*SURROUNDINGS, *campaign.bodies)
    bodies = ("specimen", *against)
    yield from _clashing((*place, "channels"), setup.channels, as_variables=True)
    yield from _clashing((*place, "recorders"), setup.recorders)
    for name, channel in setup.channels.items():
        where = (*place, "channels", name)
        yield from unknown((*where, "recorder"), "recorder", channel.recorder, setup.recorders, " in this set-up")
        for key, body, known in (("on", channel.on, bodies), ("relative_to", channel.relative_to, against)):
            if body is not None:
                yield from unknown((*where, key), "body", body, known)
    for name, recorder in setup.further_recorders.items():
        links = () if recorder.clock == "trigger" else recorder.clock.align
        for linked, owner in zip(links, (MAIN, name), strict=False):
            own = [each for each, channel in setup.channels.items() if channel.recorder == owner]
            where = (*place, "recorders", name, "clock", "align")
            yield from unknown(where, "channel", linked, own, f' of recorder "{owner}"')


def _assemblies(campaign: CampaignFile) -> Problems:
    """Find ids of assemblies and bodies that are taken, and bodies of no specimen."""
    specimens = [name for name, each in campaign.specimens.items() if not isinstance(each, Whole)]
    for name, table in campaign.assemblies.items():
        place = ("assemblies", name)
        if bool(table.stack) == bool(table.bodies):
            yield place, "Either `stack`, a list of specimens from bottom to top, or `bodies` was expected."
        for taken, where in ((name, place), *((body, (*place, "bodies", body)) for body in table.placed)):
            if taken in RESERVED or (taken == name and taken in specimens):
                said = "it has a meaning of its own" if taken in RESERVED else "a specimen has it"
                yield where, f"{shown(taken)} cannot be the id of an assembly or a body: {said}. Choose another."
        for body, each in table.placed.items():
            where = (*place, "bodies", body, "specimen") if table.bodies else (*place, "stack")
            yield from unknown(where, "specimen", each.specimen, specimens)


def _faces(campaign: CampaignFile) -> Problems:
    """Find transducers that look at the face of a specimen that is not round, without its normal."""
    for where, what in dict.fromkeys((test.setup, test.specimen) for test in campaign.tests):
        specimen, setup = campaign.specimens.get(what), campaign.setups.get(where)
        if specimen is None or setup is None or specimen.shape in ROUND or specimen.is_assembly:
            continue
        for name, channel in setup.channels.items():
            if channel.sensing == "surface" and channel.normal is None:
                message = (
                    f'It is missing. Specimen "{what}" is not round, so a "surface" transducer needs the outward '
                    "normal of the face that it looks at, such as [1, 0, 0]."
                )
                yield ("setups", where, "channels", name, "normal"), message
