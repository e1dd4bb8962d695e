"""What the free vibrations of a specimen tell its other tests: their e, and that sizes or gains are wrong."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from math import isclose
from typing import TYPE_CHECKING

from colonnade.campaign import Campaign, Test
from colonnade.campaign.assembly import APART
from colonnade.errors import CampaignError, nearest
from colonnade.findings import Finding, Severity
from colonnade.store.layout import Layout
from colonnade.workflow.product import read_done
from colonnade.workflow.raw_files import listed

if TYPE_CHECKING:
    import xarray as xr

CALIBRATED = 0.05
"""Relative difference of two gains up to which they are those of one transducer."""


def contradictions(campaign: Campaign, found: Mapping[str, Iterable[Finding]]) -> Iterator[Finding]:
    """
    Say where free vibrations contradict sizes or gains of shaken tests that are silent.

    Parameters
    ----------
    campaign : Campaign
    found : mapping of str to iterable of Finding
        What the stage `condition` found, by test.
    """
    said = {name: next(filter(_is_of_scale, findings), None) for name, findings in found.items()}
    free = [name for name in said if campaign.tests[name].kind == "free-vibration"]
    silent: dict[str, list[str]] = {}
    for name in [each for each in said if each not in free]:
        test = campaign.tests[name]
        like = [each for each in free if _shares(campaign, test, campaign.tests[each])]
        against = [each for each in like if said[each]]
        if said[name] is None and 2 * len(against) > len(like):
            silent.setdefault(against[0], []).append(name)
    for witness, tests in silent.items():
        finding = said[witness]
        assert finding is not None
        yield replace(
            finding,
            text=f"{witness} contradicts sizes or gains that it shares with {listed(sorted(tests))}, whose θ/α is off "
            f"for the same cause. {finding.text}",
            about=f"specimens.{campaign.tests[witness].specimen}",
        )


def _is_of_scale(finding: Finding) -> bool:
    return finding.kind in ("gain", "specimen") and finding.severity is not Severity.NOTE


def _shares(campaign: Campaign, test: Test, other: Test) -> bool:
    """Whether two tests are of one specimen, and of transducers with the same places and gains."""
    here, there = (campaign.channels(one) for one in (test, other))
    both = [name for name in here.keys() & there.keys() if here[name].on == there[name].on == "specimen"]
    same = (
        here[name].at == there[name].at and isclose(here[name].factor, there[name].factor, rel_tol=CALIBRATED)
        for name in both
    )
    return test.specimen == other.specimen and bool(both) and all(same)


def expect_known(campaign: Campaign, what: str, names: Iterable[str], more: str = "") -> None:
    """Refuse ids of a test, a specimen or an assessment that a campaign does not have."""
    known: Collection[str] = getattr(campaign, f"{what}s")
    for name in names:
        if name not in known:
            raise CampaignError(f'{campaign.path.name} has no {what} "{name}".{nearest(name, known)}{more}')


def one_specimen(campaign: Campaign, name: str | None) -> str:
    """Give the specimen of this id or, without one, the only one of a campaign; it has to rock as one block."""
    if name is None and len(campaign.of_interest) > 1:
        listed = nearest("", campaign.of_interest)
        raise CampaignError(f"The campaign has several specimens. Name one with --specimen ID.{listed}")
    chosen = campaign.of_interest[0] if name is None else name
    expect_known(campaign, "specimen", [chosen])
    if not campaign.specimens[chosen].is_in_plane:
        raise CampaignError(
            f"{chosen}: {APART}, which the models in the plane move. "
            "For several bodies: `colonnade map --model contact`, or [assessments.<name>] in the campaign file."
        )
    return chosen


def restitution_taken(campaign: Campaign, layout: Layout, specimen: str) -> xr.Dataset:
    """
    Give the e that predictions of a specimen use, by the campaign as it is now and the free vibrations that are stored.

    Returns
    -------
    pooled : xr.Dataset
        As of `stages.specimen`; nothing is written.
    """
    from colonnade.stages.specimen import SpecimenInputs, taken

    return taken(read_done(layout.stage(specimen, "specimen")), SpecimenInputs.of(campaign, specimen))
