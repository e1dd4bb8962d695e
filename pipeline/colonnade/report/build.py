"""The report: one page that stands alone, made from the store whatever became of the tests."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from colonnade import __version__
from colonnade.campaign import Campaign, Test
from colonnade.campaign.settings import Setting, settings
from colonnade.report import charts, results, rows, wording
from colonnade.report.results import NOTHING, Results
from colonnade.store import files
from colonnade.store.layout import Layout

Stored = list[tuple[Test, Results]]


class SpanGroup(NamedTuple):
    """Earthquake tests of one specimen and motion, by rising Span."""

    title: str
    tests: tuple[str, ...]
    chart: Markup


def build(campaign: Campaign, layout: Layout, outdated: Collection[str] = ()) -> Path:
    """
    Write the report of a campaign.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
        Where its results lie. Tests that failed or were never run are reported as such.
    outdated : collection of str, optional
        Tests whose stored results are not of this campaign any more: they are pending, and not shown.

    Returns
    -------
    page : Path
        ``report/index.html``. The same results give the same bytes, and an unchanged page is not written again.

    Raises
    ------
    StoreError
        If the page cannot be written.
    """
    layout.report.parent.mkdir(parents=True, exist_ok=True)
    files.write_text(layout.report, render(campaign, layout, outdated))
    return layout.report


def render(campaign: Campaign, layout: Layout, outdated: Collection[str] = ()) -> str:
    """Return the page as text."""
    stored: Stored = [
        (test, NOTHING if test.id in outdated else results.of_test(campaign, layout, test))
        for test in campaign.tests.values()
    ]
    tests = [rows.of_test(campaign, test, found) for test, found in stored]
    pooled = {name: results.of_specimen(layout, name) for name in campaign.specimens}
    specimens = [
        rows.of_specimen(campaign, name, found, _free_vibrations(stored, name)) for name, found in pooled.items()
    ]
    versions = {version for found in (*pooled.values(), *(found for _, found in stored)) for version in found.versions}
    environment = Environment(
        loader=PackageLoader("colonnade.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.globals |= {"count": wording.count}
    environment.filters["setting"] = _setting
    return environment.get_template("page.html.jinja").render(
        campaign=campaign,
        gravity=wording.quantity(campaign.gravity, "m/s²", 5),
        tests=tests,
        models=campaign.processing.predict.models,
        specimens=specimens,
        spans=list(_span_groups(campaign, stored)),
        settings=list(settings(campaign.processing)),
        agreement=_agreement(tests, campaign.processing.predict.models),
        version=__version__,
        versions=sorted(versions),
    )


def _free_vibrations(stored: Stored, specimen: str) -> Stored:
    return [(test, found) for test, found in stored if test.specimen == specimen and test.kind == "free-vibration"]


def _span_groups(campaign: Campaign, stored: Stored) -> Iterator[SpanGroup]:
    def group(entry: tuple[Test, Results]) -> tuple[str, str, float]:
        return entry[0].specimen, entry[0].motion or "", entry[0].time_scale or 1.0

    drawn = [
        (test, found)
        for test, found in stored
        if test.span is not None and any("rocking_angle" in dataset for dataset in found.datasets.values())
    ]
    for number, ((specimen, motion, scale), members) in enumerate(
        groupby(sorted(drawn, key=group), key=group), start=1
    ):
        together = sorted(members, key=lambda entry: (entry[0].span or 0.0, entry[0].id))
        if len(together) < 2:
            continue
        title = f"{motion or 'Base motion'}, {specimen}" + (f", time scale {scale:.4g}" if scale != 1.0 else "")
        block = campaign.specimens[specimen].block(campaign.gravity)
        chart = charts.spans(f"spans-{number}", title, together, block)
        yield SpanGroup(title, tuple(test.id for test, _ in together), chart)


def _agreement(tests: list[rows.TestRow], models: tuple[str, ...]) -> dict[str, tuple[int, int]]:
    """Count, for each model, the tests whose outcome it predicts rightly, and those where both are known."""
    agreed = {model: [test.models[model].agrees for test in tests] for model in models}
    return {model: (verdicts.count(True), len(verdicts) - verdicts.count(None)) for model, verdicts in agreed.items()}


def _setting(setting: Setting) -> str:
    """Write a setting's value with its unit."""
    value = setting.value
    if isinstance(value, (list, tuple)):
        return ", ".join(map(str, value))
    if isinstance(value, str):
        return value
    return f"{value:g} {setting.unit}".rstrip()
