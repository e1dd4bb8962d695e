"""Next: the test that tells most of each specimen and kind, and the tests that are still to come."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path

from colonnade.campaign import Campaign, load
from colonnade.campaign.forms.summary import TestSummary
from colonnade.errors import CampaignError, StoreError, nearest
from colonnade.identification.response.boundaries import SAME_FREQUENCY
from colonnade.stages.predict import sides
from colonnade.stages.specimen import restitution_spread
from colonnade.store.layout import Layout
from colonnade.store.records.advice import Advice, ranked
from colonnade.store.records.summary import map_points, read_summary, records_of_tests
from colonnade.workflow.advising.earthquake import advise_earthquakes
from colonnade.workflow.advising.free import advise_free
from colonnade.workflow.advising.sine import Known, advise_sines
from colonnade.workflow.pooling import restitution_taken

KINDS = ("free-vibration", "sine", "earthquake")
"""Kinds of test that are advised, in their order."""


@dataclass(frozen=True)
class Next:
    """
    What a campaign should do next.

    Attributes
    ----------
    advice : tuple of Advice
        What tells most first, see `store.records.advice.ranked`.
    awaited : dict of str to str
        Tests that have no raw file yet, and the file that is expected.
    """

    advice: tuple[Advice, ...]
    awaited: dict[str, str]


def advise(
    campaign: Path | str,
    *,
    specimens: Sequence[str] = (),
    results: Path | str | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Next:
    """
    Advise the next tests of a campaign, by the results of its last run.

    Parameters
    ----------
    campaign : Path or str
        A campaign.toml or its folder.
    specimens : sequence of str, optional
        Ids; default all.
    results : Path or str, optional
        As for `run`.
    progress : callable, optional
        Called with the number of kinds of test that were looked at, and their total.

    Raises
    ------
    CampaignError
        If the campaign file or a specimen is not usable.
    StoreError
        If the campaign has never been run.
    """
    loaded = load(Path(campaign)).awaiting()
    for name in specimens:
        if name not in loaded.specimens:
            raise CampaignError(f'{loaded.path.name} has no specimen "{name}".{nearest(name, loaded.specimens)}')
    layout = Layout.of(loaded.path, results)
    summary = read_summary(layout)
    if summary is None:
        raise StoreError(f"{loaded.folder}: this campaign has no results yet. Run `colonnade run` first.")
    tests = records_of_tests(loaded, summary)
    advice: list[Advice] = []
    asked = list(product(specimens or loaded.specimens, KINDS))
    for done, (name, kind) in enumerate(asked, 1):
        advice += advise_kind(loaded, layout, name, kind, tests)
        if progress is not None:
            progress(done, len(asked))
    return Next(tuple(ranked(advice)), loaded.awaited)


def advise_after(campaign: Campaign, layout: Layout, name: str, measured: Mapping[str, TestSummary]) -> list[Advice]:
    """
    Advise the next test like one that was just measured: of its specimen and kind, and of its frequency.

    `measured` are the records of this test and of those before it; the summary of the last run may not have them yet.
    """
    known, record = records_of_tests(campaign, read_summary(layout)), measured[name]
    tests = {test: measured.get(test, each) if each.status == "pending" else each for test, each in known.items()}
    tests |= {name: record}
    found = advise_kind(campaign, layout, record.specimen, record.kind, tests)
    if record.frequency_ratio is None:
        return found
    ratio = record.frequency_ratio
    return [each for each in found if abs(each.values.get("frequency_ratio", 0.0) / ratio - 1) < SAME_FREQUENCY]


def advise_kind(
    campaign: Campaign, layout: Layout, specimen: str, kind: str, tests: dict[str, TestSummary]
) -> list[Advice]:
    """Advise the next tests of one kind of a specimen, by the records of all tests."""
    pooled = restitution_taken(campaign, layout, specimen)
    if kind == "free-vibration":
        free = advise_free(campaign, specimen, pooled, tests)
        return [] if free is None else [free]
    if kind == "sine":
        sines = (test for test in campaign.tests.values() if (test.specimen, test.kind) == (specimen, kind))
        tilts = [campaign.setups[test.setup].table_tilt or 0.0 for test in sines]
        deviation, _ = restitution_spread(pooled, campaign.processing.predict.ensemble.restitution)
        points = tuple(map_points(tests, specimen))
        return advise_sines(campaign, specimen, Known(sides(pooled), deviation, points, max(tilts, key=abs, default=0)))
    return advise_earthquakes(campaign, layout, specimen, tests) if kind == "earthquake" else []
