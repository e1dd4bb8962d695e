"""What several questions ask of a campaign: that an id is in it, its one specimen, and the e of a specimen."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import TYPE_CHECKING

from colonnade.campaign import Campaign
from colonnade.campaign.assembly import APART
from colonnade.errors import CampaignError, nearest
from colonnade.store.layout import Layout
from colonnade.workflow.product import read_done

if TYPE_CHECKING:
    import xarray as xr


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
    """Give the e that predictions use (see `stages.specimen`), by the campaign as it is and what is stored."""
    from colonnade.stages.specimen import SpecimenInputs, taken

    return taken(read_done(layout.stage(specimen, "specimen")), SpecimenInputs.of(campaign, specimen))
