"""Which stages of which tests a run is asked for."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from colonnade.campaign import Campaign
from colonnade.errors import CampaignError, nearest

ORDER = ("ingest", "condition", "rocking", "restitution", "predict", "compare", "report")
"""Names that `until` and `start_from` take, in the order in which they run."""


@dataclass(frozen=True)
class Selection:
    """
    What a run is asked for.

    Attributes
    ----------
    until : str
        Last stage.
    start_from : str or None
        Stage that is redone, with what follows, even where it is up to date.
    tests : tuple of str
        Tests that are asked for, in the order of the campaign.
    needed : tuple of str
        Those, and the free vibrations of their specimens where predictions need their restitution.
    """

    until: str
    start_from: str | None
    tests: tuple[str, ...]
    needed: tuple[str, ...]

    def includes(self, stage: str) -> bool:
        """Whether a stage is asked for."""
        return ORDER.index(stage) <= ORDER.index(self.until)

    def redoes(self, stage: str) -> bool:
        """Whether a stage is executed even where it is up to date."""
        return self.start_from is not None and ORDER.index(stage) >= ORDER.index(self.start_from)


def select(campaign: Campaign, until: str | None, start_from: str | None, only: Iterable[str]) -> Selection:
    """
    Check what a run is asked for.

    Raises
    ------
    CampaignError
        If a stage or test does not exist, with the nearest name, or `start_from` comes after `until`.
    """
    last = until or ORDER[-1]
    for option, stage in (("until", until), ("from", start_from)):
        if stage is not None and stage not in ORDER:
            raise CampaignError(f'{option}: there is no stage "{stage}".{nearest(stage, ORDER)}')
    if start_from is not None and ORDER.index(start_from) > ORDER.index(last):
        raise CampaignError(
            f"from {start_from}, until {last}: nothing lies between. The stages are: {', '.join(ORDER)}."
        )
    asked = (only,) if isinstance(only, str) else tuple(only)
    unknown = [f'only: there is no test "{name}".{nearest(name, campaign.tests)}' for name in asked]
    unknown = [text for name, text in zip(asked, unknown, strict=True) if name not in campaign.tests]
    if unknown:
        raise CampaignError("\n".join(unknown))
    tests = tuple(name for name in campaign.tests if not asked or name in asked)
    needed = set(tests)
    if ORDER.index(last) >= ORDER.index("restitution"):
        specimens = {campaign.tests[name].specimen for name in tests}
        needed |= {
            name
            for name, test in campaign.tests.items()
            if test.kind == "free-vibration" and test.specimen in specimens
        }
    return Selection(last, start_from, tests, tuple(name for name in campaign.tests if name in needed))
