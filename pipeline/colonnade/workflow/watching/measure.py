"""One test, as fast as it goes: measured, identified, predicted in the plane; the rest is left to a run."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from colonnade.campaign import Campaign, Test
from colonnade.campaign.forms.summary import TestSummary
from colonnade.errors import StoreError
from colonnade.findings import Finding
from colonnade.identification.plausibility.since_last import ChannelState, changes
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.stability_map import as_map
from colonnade.store.records.stored import Failure, Stored
from colonnade.store.records.test import record_of_specimen, record_of_test
from colonnade.store.results import ResultId
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.execution.lock import only_run
from colonnade.workflow.pooling import restitution_taken
from colonnade.workflow.raw_files import raw_files
from colonnade.workflow.steps import Graph
from colonnade.workflow.walk import Walk
from colonnade.workflow.watching.arrivals import last_change
from colonnade.workflow.watching.line import Line

if TYPE_CHECKING:
    import xarray as xr

LIMITS = ("no_rocking", "lower", "upper")


def measure(campaign: Campaign, layout: Layout, name: str, finished: float) -> Line:
    """
    Bring one test up to date as far as it takes seconds, and say what is known of it then.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    name : str
        Id of the test.
    finished : float
        When its files were last changed, s since 1970.

    Raises
    ------
    StoreError
        If a run holds the campaign, or results cannot be written.
    """
    test = campaign.tests[name]
    with only_run(layout) as run_id:
        catalogue = Catalogue(layout)
        raw = {name: raw_files(campaign, test, catalogue)}
        walk = Walk(Graph(campaign, layout, catalogue), run_id, raw, until="predict", workers=1)
        made = walk.at_once(name)
        catalogue.save(is_whole=False)
    stored = Stored()
    for result in made:
        stored.add(result, layout.path(result))
    if reason := walk.failed_tests.get(name, ""):
        stored.failures = stored.failures or [Failure("", reason)]
    else:
        _compare(campaign, test, stored)
    record = record_of_test(campaign, test, stored)
    pooled = restitution_taken(campaign, layout, test.specimen)
    known = record_of_specimen(campaign, test.specimen, pooled).restitution
    changed = () if walk.failed_tests else tuple(_changes(campaign, layout, test))
    return Line(name, record, known, _limits(layout, test.specimen, record), changed, time.time() - finished)


def measured(campaign: Campaign, layout: Layout) -> set[str]:
    """Give the tests that nothing has to be measured of: their results are up to date, or they are left out."""
    catalogue = Catalogue(layout)
    raw = {test.id: raw_files(campaign, test, catalogue) for test in campaign.tests.values()}
    walk = Walk(Graph(campaign, layout, catalogue), "", raw)
    return set(campaign.tests) - walk.stale("measuring").keys()


def _compare(campaign: Campaign, test: Test, stored: Stored) -> None:
    """Add the comparison with the models that have run; it is not kept, as the whole one follows."""
    from colonnade.stages.compare import CompareInputs, compare

    predicted: dict[str, xr.Dataset] = {model: stored.datasets["predict", model] for model in stored.models("predict")}
    if ("rocking", None) in stored.datasets:
        measured = stored.datasets["rocking", None]
        stored.datasets["compare", None] = compare(measured, predicted, CompareInputs.of(campaign, test))


def _changes(campaign: Campaign, layout: Layout, test: Test) -> Iterator[Finding]:
    """Compare the channels with those of the test with the same set-up that was recorded last before this one."""
    alike = [each for each in campaign.tests.values() if each.setup == test.setup]
    recorded = {each.id: last_change(each.files.values()) for each in alike}
    before = [name for name in recorded if 0 < recorded[name] < recorded[test.id]]
    done = [name for name in before if layout.stage(name, "condition").exists()]
    if done:
        last = max(done, key=recorded.__getitem__)
        yield from changes(_states(layout, test.id), _states(layout, last), last)


def _states(layout: Layout, name: str) -> dict[str, ChannelState]:
    try:
        conditioned = files.read(layout.stage(name, "condition"))
    except StoreError:
        return {}
    return {
        str(variable): ChannelState(float(values.attrs["zero"]), float(values.attrs["noise"]), motion)
        for variable, values in conditioned.data_vars.items()
        if {"zero", "noise"} <= values.attrs.keys() and np.isfinite(motion := float(np.abs(values).max()))
    }


def _limits(layout: Layout, specimen: str, record: TestSummary) -> dict[str, float]:
    """Read the limits at a test's frequency ratio off the specimen's map, by the last of its models that has one."""
    if record.frequency_ratio is None:
        return {}
    for model in reversed(list(record.predicted)):
        try:
            chart = as_map(files.read(layout.path(ResultId(specimen, "map", model))))
        except (StoreError, KeyError, ValueError):
            continue
        found = {limit: getattr(chart, limit) for limit in LIMITS}
        at = {
            limit: float(np.interp(record.frequency_ratio, chart.frequency_ratio, values, left=np.nan, right=np.nan))
            for limit, values in found.items()
        }
        return {limit: value for limit, value in at.items() if np.isfinite(value)}
    return {}
