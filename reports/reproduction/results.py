"""All numbers of the reproduction in one mapping, as results.json holds them."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

from colonnade.campaign import Campaign, load
from colonnade.campaign.forms.summary import Summary
from colonnade.dynamics.block import Block
from colonnade.dynamics.maps import StabilityMap
from colonnade.figures.stored.subject import OfTest
from colonnade.identification.response.boundaries import MapPoint
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stored import Stored, as_map, read_test
from colonnade.store.records.summary import map_points, read_summary
from reproduction import computed, responses
from reproduction.campaign import CYCLES, MAP_RAMP, NUMERICAL, SEED, SPECIMEN
from reproduction.computed import Numbers
from reproduction.printed import specimens
from study import rounded

DIGITS = 7
"""Significant digits that are kept: more than any page shows, fewer than machines differ by."""


@dataclass(frozen=True)
class Found:
    """
    The campaign after its run: what the numbers and the figures are made from.

    Attributes
    ----------
    campaign, layout, summary
    block : Block
        Of the prism.
    stored : dict of str to Stored
        Results of the prism's tests, by id.
    points : list of MapPoint
        Its sine tests.
    charts : dict of str to StabilityMap
        Its maps by model, with the limits that their levels show.
    fine : StabilityMap
        The analytical model's, finely scanned.
    """

    campaign: Campaign
    layout: Layout
    summary: Summary
    block: Block
    stored: dict[str, Stored]
    points: list[MapPoint]
    charts: dict[str, StabilityMap]
    fine: StabilityMap

    def of_kind(self, kind: str) -> list[str]:
        """Return the ids of the prism's tests of a kind."""
        return [name for name in self.stored if self.campaign.tests[name].kind == kind]

    def of(self, test: str) -> OfTest:
        """Return a test of the prism as figures see it."""
        return OfTest(self.campaign, self.campaign.tests[test], self.summary.tests[test], self.stored[test])


def read(path: Path) -> Found:
    """Read the results of a campaign that `campaign.perform` has run."""
    campaign = load(path)
    layout = Layout(campaign.folder)
    summary = read_summary(layout)
    assert summary is not None
    restitution = summary.specimens[SPECIMEN].restitution.value
    assert isinstance(restitution, float)
    return Found(
        campaign,
        layout,
        summary,
        campaign.block(SPECIMEN),
        {test.id: read_test(campaign, layout, test) for test in campaign.tests.values() if test.specimen == SPECIMEN},
        map_points(summary.tests, SPECIMEN),
        {
            model: computed.by_level(as_map(files.read(layout.stage(SPECIMEN, "map", model))))
            for model in campaign.processing.predict.models
        },
        computed.fine_map(restitution),
    )


def gather(found: Found, kept: Numbers) -> Numbers:
    """
    Gather all numbers; `kept` are those of results.json.

    What studies that have ended found stays as it is there: `table_2`, `stable_steps`, `convergence`,
    `three_dimensional` and `unreduced`, gathered from the studies' files by the program at commit 26e34e5.
    """
    truth = json.loads((found.campaign.folder / "truth" / "truth.json").read_text(encoding="utf-8"))
    spans = responses.span_tests(found.campaign, SPECIMEN)
    shaken = [*computed.SHAKEN, *computed.SHAKEN.values()]
    recorded = {test: computed.recorded_motion(found.stored[test]) for test in (*spans.values(), *shaken)}
    return kept | rounded(
        {
            "made": _made(found),
            "specimens": specimens(),
            "restitution": responses.restitution(found.summary, truth),
            "tests": responses.tests(found.summary, truth),
            "free_vibrations": {
                test: responses.free_vibration(found.of(test)) for test in found.of_kind("free-vibration")
            },
            "sines": {test: responses.sine(found.of(test)) for test in found.of_kind("sine")},
            "boundaries": responses.boundaries(found.points),
            "maps": {model: computed.limits(chart, found.points) for model, chart in found.charts.items()},
            "fine_map": computed.limits(found.fine, found.points),
            "earthquakes": {
                span: {"test": test} | responses.earthquake(found.of(test)) for span, test in spans.items()
            },
            "schemes": computed.schemes(found.block, {span: recorded[test] for span, test in spans.items()}),
            "in_space": computed.in_space(found.campaign, found.layout, {test: recorded[test] for test in shaken}),
        },
        DIGITS,
    )


def _made(found: Found) -> Numbers:
    law = files.read(found.layout.stage(SPECIMEN, "contact"))
    return {
        "seed": SEED,
        "gravity": found.campaign.gravity,
        "tests": len(found.campaign.tests),
        "contact": {
            "body": str(law.attrs["body"]),
            "step": found.campaign.processing.predict.contact.step,
            **{name: float(law[name]) for name in ("friction", "damping_fraction", "restitution")},
        },
        "map": {"cycles": CYCLES, "ramp": MAP_RAMP, "model": NUMERICAL},
    }
