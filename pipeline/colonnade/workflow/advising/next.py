"""Next: the test that tells most of each specimen and kind, free vibrations here; the tests that are to come."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import partial
from itertools import product
from typing import TYPE_CHECKING

import numpy as np
from pydantic import TypeAdapter

from colonnade.campaign import Campaign
from colonnade.campaign.forms.summary import TestSummary
from colonnade.errors import StoreError
from colonnade.identification.advice import LAST_PEAK, advise_free_vibration
from colonnade.identification.response.boundaries import SAME_FREQUENCY
from colonnade.stages.predict import sides
from colonnade.stages.specimen import restitution_spread
from colonnade.store.layout import Layout
from colonnade.store.records.advice import Advice, ranked
from colonnade.store.records.summary import map_points, read_summary, records_of_tests
from colonnade.units.text import format_uncertain, interval, number
from colonnade.workflow.advising.sine import advise_earthquakes, advise_sines
from colonnade.workflow.graph import expect_known, restitution_taken
from colonnade.workflow.product import Catalogue, Contents, Product, brought_up_to_date

if TYPE_CHECKING:
    import xarray as xr

MADE_BY = ("colonnade.workflow.advising",)
"""Package whose code makes advice; what it imports counts too."""

_ADVICE = TypeAdapter(list[Advice])

KINDS = ("free-vibration", "sine", "earthquake")
"""Kinds of test that are advised, in their order."""


def advise(
    campaign: Campaign, layout: Layout, catalogue: Catalogue, specimens: Sequence[str] = (), workers: int | None = 1
) -> list[Advice]:
    """
    Advise the next tests of a campaign by the results of its last run, what tells most first.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    catalogue : Catalogue
        Keeps advice about which nothing changed.
    specimens : sequence of str, optional
        Ids; default all.
    workers : int or None, optional
        Processes; None for one a core.

    Raises
    ------
    CampaignError
        If the campaign has no such specimen.
    StoreError
        If the campaign has never been run.
    """
    expect_known(campaign, "specimen", specimens)
    summary = read_summary(layout)
    if summary is None:
        raise StoreError(f"{campaign.folder}: this campaign has no results yet. Run `colonnade run` first.")
    tests, code = records_of_tests(campaign, summary), catalogue.code(MADE_BY)
    products = []
    for specimen, kind in product(specimens or campaign.of_interest, KINDS):
        own = {
            name: [
                campaign.told(test),
                tests[name].model_dump_json(),
                campaign.setups[test.setup].table_tilt,
                catalogue.content(layout.stage(name, "rocking")),
            ]
            for name, test in campaign.tests.items()
            if (test.specimen, test.kind) == (specimen, kind)
        }
        read = [campaign.specimens[specimen], campaign.gravity, campaign.processing, campaign.next, campaign.table]
        upstream = {"specimen": catalogue.content(layout.stage(specimen, "specimen"))}
        make = partial(_advised, campaign, layout, specimen, kind, tests)
        entry = json.dumps([*map(repr, read), own])
        products.append(Product(f"advice {specimen} {kind}", entry, upstream, code, make))
    made = brought_up_to_date(products, catalogue, workers=workers)
    return ranked(each for one in products for each in _ADVICE.validate_json(made[str(one.id)].text))


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
    """Advise the next tests of one kind of a specimen, by the records of all tests; none if it is not one block."""
    if not campaign.specimens[specimen].is_in_plane:
        return []
    pooled = restitution_taken(campaign, layout, specimen)
    if kind == "free-vibration":
        return advise_free(campaign, specimen, pooled, tests)
    if kind == "sine":
        sines = (test for test in campaign.tests.values() if (test.specimen, test.kind) == (specimen, kind))
        tilts = [campaign.setups[test.setup].table_tilt or 0.0 for test in sines]
        deviation, _ = restitution_spread(pooled, campaign.processing.predict.ensemble.restitution)
        tilt = max(tilts, key=abs, default=0.0)
        return advise_sines(campaign, specimen, map_points(tests, specimen), sides(pooled), deviation, tilt)
    return advise_earthquakes(campaign, layout, specimen, tests) if kind == "earthquake" else []


def _advised(campaign: Campaign, layout: Layout, specimen: str, kind: str, tests: dict[str, TestSummary]) -> Contents:
    return [], _ADVICE.dump_json(advise_kind(campaign, layout, specimen, kind, tests)).decode()


LARGEST_RELEASE = 0.6
"""|θ|/α from which a specimen is released at most: large first amplitudes disagree with every model."""


def advise_free(
    campaign: Campaign, specimen: str, pooled: xr.Dataset, tests: Mapping[str, TestSummary]
) -> list[Advice]:
    """
    Advise on the next free vibration; not at all if e is given in the campaign file.

    Parameters
    ----------
    campaign : Campaign
    specimen : str
        Its id.
    pooled : xr.Dataset
        Its e, as the stage `specimen` gives it.
    tests : mapping of str to TestSummary
        Records of the campaign's tests.
    """
    if pooled.attrs["restitution_source"] == "given":
        return []
    wanted = campaign.next.restitution_width
    released = _released(pooled, tests)
    if not released:
        reason = "e is not identified, so predictions use the rigid-body value"
        return [Advice(specimen, "free-vibration", f"release from {LARGEST_RELEASE:g} α", False, reason)]
    names, angles = list(released), np.array(list(released.values()))
    places = [list(pooled["test_id"].to_numpy()).index(name) for name in names]
    advised = advise_free_vibration(
        pooled["test_restitution"].to_numpy()[places],
        pooled["test_restitution_standard_error"].to_numpy()[places],
        angles,
        wanted_half_width=wanted / 2,
        largest_release=LARGEST_RELEASE,
        level=float(pooled["level"]),
    )
    # One test shows nothing of the scatter between tests.
    of = "1, for that record alone" if len(names) == 1 else str(len(names))
    e, half = advised.pooled.value, advised.half_width
    known = f"e {interval(e, e - half, e + half)} from {of}"
    after = format_uncertain(e, float(advised.predicted_half_width[0]))
    advice = Advice(
        specimen=specimen,
        kind="free-vibration",
        test=f"release from {number(LARGEST_RELEASE, 2)} α",  # the records keep no side
        is_enough=advised.is_enough,
        reason=known + (", as narrow as wanted" if advised.is_enough else f"; one more test: about {after}"),
        left=advised.needed,
    )
    return [advice]


def _released(pooled: xr.Dataset, tests: Mapping[str, TestSummary]) -> dict[str, float]:
    """Give |θ|/α of the release of each free vibration whose e is pooled."""
    names = [str(name) for name in pooled["test_id"].to_numpy()] if "test_id" in pooled else []
    ratios = {name: tests[name].release_ratio or tests[name].peak_ratio for name in names if name in tests}
    return {name: ratio for name, ratio in ratios.items() if ratio is not None and LAST_PEAK < ratio < 1.0}
