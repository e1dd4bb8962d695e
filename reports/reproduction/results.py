"""All numbers of the reproduction in one mapping, as results.json holds them."""

from __future__ import annotations

import json
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from colonnade.campaign import Campaign, load
from colonnade.campaign.forms.summary import Summary
from colonnade.dynamics.block import Block
from colonnade.dynamics.maps.chart import StabilityMap
from colonnade.identification.response.boundaries import MapPoint
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stability_map import as_map
from colonnade.store.records.stored import Stored, read_test
from colonnade.store.records.summary import map_points, read_summary
from reproduction import computed, responses, tables
from reproduction.campaign import CYCLES, MAP_RAMP, NUMERICAL, SEED, SPECIMEN
from reproduction.misfit import added, judged

Numbers = dict[str, Any]

DIGITS = 7
"""Significant digits that are kept: more than any page shows, fewer than machines differ by."""

STUDY, CONVERGENCE = "contact-study.json", "convergence.json"
"""The studies that are cited: their numbers are read, not measured again."""

SPOILT = 0.005
"""Of e: an error that counts."""


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


def gather(found: Found, reports: Path) -> Numbers:
    """Gather all numbers; `reports` is the folder of the studies that are cited."""
    truth = json.loads((found.campaign.folder / "truth" / "truth.json").read_text(encoding="utf-8"))
    study = json.loads((reports / STUDY).read_text(encoding="utf-8"))
    spans = responses.span_tests(found.campaign, SPECIMEN)
    shaken = [*computed.SHAKEN, *computed.SHAKEN.values()]
    recorded = {test: computed.recorded_motion(found.stored[test]) for test in (*spans.values(), *shaken)}
    gathered: Numbers = rounded(
        {
            "made": _made(found),
            "specimens": tables.specimens(),
            "table_2": tables.table_2(study),
            "stable_steps": tables.stable_steps(),
            "restitution": responses.restitution(found.summary, truth),
            "tests": responses.tests(found.summary, truth),
            "free_vibrations": {
                test: responses.free_vibration(found.stored[test], found.block)
                for test in found.of_kind("free-vibration")
            },
            "sines": {test: responses.sine(found.stored[test], found.block) for test in found.of_kind("sine")},
            "boundaries": responses.boundaries(found.points),
            "maps": {model: computed.limits(chart, found.points) for model, chart in found.charts.items()},
            "fine_map": computed.limits(found.fine, found.points),
            "earthquakes": {
                span: {"test": test} | responses.earthquake(found.stored[test], found.block)
                for span, test in spans.items()
            },
            "schemes": computed.schemes(found.block, {span: recorded[test] for span, test in spans.items()}),
            "in_space": computed.in_space(found.campaign, found.layout, {test: recorded[test] for test in shaken}),
            "convergence": _convergence(reports),
            "three_dimensional": _three_dimensional(study),
            "unreduced": [
                {key: run[key] for key in ("mesh", "modulus", "damping_fraction", "stable")}
                for run in study["unreduced"]
            ],
        }
    )
    return gathered


def _made(found: Found) -> Numbers:
    law = files.read(found.layout.stage(SPECIMEN, "contact"))
    return {
        "seed": SEED,
        "gravity": found.campaign.gravity,
        "tests": len(found.campaign.tests),
        "contact": {
            "body": str(law.attrs["body"]),
            "step": found.campaign.processing.predict.contact.step,
            "friction": float(law["friction"]),
            "damping_fraction": float(law["damping_fraction"]),
            "restitution": float(law["restitution"]),
        },
        "map": {"cycles": CYCLES, "ramp": MAP_RAMP, "model": NUMERICAL},
    }


def _convergence(reports: Path) -> list[Numbers]:
    """Give the errors of the paper's schemes at its own step, of the study of their convergence."""
    step = 1e-4
    rows = []
    for series in json.loads((reports / CONVERGENCE).read_text(encoding="utf-8")):
        place = int(np.argmin(np.abs(np.array(series["steps"]) - step)))
        rows.append(
            {key: series[key] for key in ("case", "scheme", "refinement", "order")} | {"error": series["errors"][place]}
        )
    return rows


def _three_dimensional(study: Numbers) -> Numbers:
    """Give what the contact study found of rocking that leaves its plane, at its largest release."""
    runs = study["misfit"]
    release = max(run["release"] for run in runs)
    verdicts = {kind: {"size": size, "prism": prism} for kind, (size, prism) in judged(runs, release).items()}
    smallest = {
        specimen: {
            kind: added(runs, release, specimen, kind)[0]
            for kind in dict.fromkeys(run["kind"] for run in runs if run["kind"] != "none")
            if added(runs, release, specimen, kind)
        }
        for specimen in ("prism", "cylinder", "cone")
    }
    spoilt = {specimen: _spoilt(runs, release, specimen) for specimen in ("prism", "cylinder", "cone")}
    return {"release": release, "disturbances": verdicts, "smallest": smallest, "e_spoilt": spoilt}


def _spoilt(runs: list[Numbers], release: float, specimen: str) -> float:
    """Give the share of disturbed releases whose e was refused, or differs by more than `SPOILT` from a plane "
    "one's."""
    mine = [run for run in runs if (run["release"], run["specimen"]) == (release, specimen) and run["kind"] != "oval"]
    plain = next(run["fitted"] for run in mine if run["kind"] == "none")
    fitted = [run["fitted"] for run in mine if run["kind"] != "none"]
    spoilt = sum(each is None or abs(each - plain) > SPOILT for each in fitted)
    return float(spoilt / len(fitted))


def rounded(value: Any) -> Any:
    """Round all numbers of a tree to `DIGITS` significant digits; what is not finite becomes null."""
    if isinstance(value, dict):
        return {str(key): rounded(each) for key, each in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [rounded(each) for each in value]
    if isinstance(value, (bool, str, int)) or value is None:
        return value
    number = float(value)
    return float(f"{number:.{DIGITS}g}") if isfinite(number) else None
