"""Which forecast of a test counts: the last one that was made before its raw file was there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from colonnade.campaign import Campaign
from colonnade.store.forecasts import Forecasts, Known
from colonnade.workflow.raw_files import RawFiles


@dataclass(frozen=True)
class Chosen:
    """
    The forecasts of a campaign by what they are for.

    Attributes
    ----------
    blind : dict of str to bool
        By file, of those that are for a test: whether it is blind.
    counts : dict of str to Known
        By test the one that counts: the last one that is blind, else the last one.
    """

    blind: dict[str, bool]
    counts: dict[str, Known]

    @property
    def scored(self) -> dict[str, Known]:
        """Those of `counts` that are blind."""
        return {test: known for test, known in self.counts.items() if self.blind[known.name]}


def choose(campaign: Campaign, forecasts: Forecasts, raw: Mapping[str, RawFiles]) -> Chosen:
    """
    Find the forecast of each test that counts.

    Parameters
    ----------
    campaign : Campaign
    forecasts : Forecasts
        A forecast is for the test that it names, if that is still one of its specimen.
    raw : mapping of str to mapping of str to RawFile
        Raw files by test.
    """
    blind, counts = {}, dict[str, Known]()
    for known in forecasts.known:
        test = campaign.tests.get(known.forecast.test or "")
        if test is None or test.specimen != known.forecast.specimen:
            continue
        blind[known.name] = is_blind(known, raw[test.id])
        earlier = counts.get(test.id)
        if earlier is None or blind[known.name] or not blind[earlier.name]:
            counts[test.id] = known
    return Chosen(blind, counts)


def is_blind(known: Known, raw: RawFiles) -> bool:
    """Whether none of a test's raw files was there when a forecast was made, by name or by content."""
    there = known.forecast.raw_files
    content = {file.sha256 for file in raw.values() if file.sha256 is not None}
    return not (raw.keys() & there.keys() or content & set(there.values()))
