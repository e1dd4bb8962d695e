"""Assessments that are asked for at the command line: those of a campaign, or a question of one's own."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from colonnade.campaign import Campaign
from colonnade.campaign.assessing.assessed import AssessmentSummary
from colonnade.campaign.assessing.assessment import Assessment
from colonnade.errors import CampaignError, ColonnadeError, nearest
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.assessing.steps import made
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.execution.blocks import Counted, in_blocks
from colonnade.workflow.execution.lock import only_run
from colonnade.workflow.real_column import AskedColumn, checked, find_column
from colonnade.workflow.steps import Graph
from colonnade.workflow.walk import Walk

if TYPE_CHECKING:
    import xarray as xr

OPTIONS = {"levels": "level"}
"""Options that are not called like their keys, as they are repeated."""

OWN = "column"
"""Name of a question of one's own."""


@dataclass(frozen=True)
class Assessed:
    """An assessment: its name, its record, its result if it was made, and where that is stored, if it is."""

    name: str
    record: AssessmentSummary
    result: xr.Dataset | None
    path: Path | None = None


@dataclass(frozen=True)
class Where:
    """Where histories are run, and who is told of their blocks."""

    workers: int | None = None
    scheduler: str | None = None
    progress: Counted | None = None


def assess_campaign(campaign: Campaign, layout: Layout, names: Sequence[str], where: Where) -> list[Assessed]:
    """
    Bring assessments of a campaign up to date, with the e that is identified so far.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    names : sequence of str
        Default all.
    where : Where

    Raises
    ------
    CampaignError
        If the campaign has no such assessment, or none at all.
    StoreError
        If a run is in progress, or a result cannot be written.
    """
    chosen = {name: _known(campaign, name) for name in names or campaign.assessments}
    if not chosen:
        raise CampaignError(
            f"{campaign.path.name} has no [assessments.<name>]. Add one, or ask with --specimen ID --records DIR."
        )
    with only_run(layout) as run_id:
        catalogue = Catalogue(layout)
        walk = Walk(Graph(campaign, layout, catalogue), run_id, workers=where.workers, scheduler=where.scheduler)
        walk.pool(sorted({asked.specimen for asked in chosen.values()}))
        walk.assess(chosen, where.progress)
        catalogue.save(is_whole=False)
    found = []
    for name, asked in chosen.items():
        path = layout.stage(name, "assessment")
        if name in walk.failed_assessments:
            found.append(Assessed(name, _failed(asked.specimen, asked.measure, walk.failed_assessments[name]), None))
        else:
            result = files.read(path)
            record = AssessmentSummary.model_validate_json(result.attrs["answer"])
            found.append(Assessed(name, record, result, path))
    return found


def _known(campaign: Campaign, name: str) -> Assessment:
    if name not in campaign.assessments:
        known = nearest(name, campaign.assessments)
        raise CampaignError(f'{campaign.path.name} has no assessment "{name}".{known}')
    return campaign.assessments[name]


def assess_own(
    campaign: Campaign | None,
    layout: Layout | None,
    base: str | None,
    column: AskedColumn,
    options: Mapping[str, Any],
    where: Where,
) -> Assessed:
    """
    Answer a question of one's own about a real column; nothing is stored.

    Parameters
    ----------
    campaign, layout : optional
        None without a campaign.
    base : str or None
        Name of the assessment of the campaign whose keys count if nothing replaces them.
    column : AskedColumn
        Default the column of `base`.
    options : mapping
        Keys of [assessments.<name>], as in a campaign file; paths may be anywhere.
    where : Where

    Raises
    ------
    CampaignError
        If an option or a name is not usable, or something is missing.
    """
    from colonnade.stages.assessing.plan import AssessmentInputs

    written = {} if campaign is None or base is None else _known(campaign, base).model_dump(exclude_none=True)
    meant = replace(
        column, specimen=column.specimen or written.get("specimen"), scale=column.scale or written.get("scale")
    )
    found = find_column(meant, campaign, layout, is_real=True)
    name = found.specimen or OWN
    asked = _asked(written | {"specimen": name, "scale": found.inputs.scale}, options)
    inputs = AssessmentInputs(**dict(found.inputs), specimen=name, asked=asked)
    return _made(asked, inputs, found.pooled, where)


def _asked(written: dict[str, Any], options: Mapping[str, Any]) -> Assessment:
    """Put options over the keys of an assessment; their files may be anywhere."""
    if options.get("measure") not in (None, written.get("measure")):
        # Levels and hazard are of another measure.
        written = {key: value for key, value in written.items() if key not in ("levels", "hazard")}
    paths = {key: Path(options[key]) for key in ("records", "hazard") if options.get(key) is not None}
    paths = {key: written.pop(key) for key in ("records", "hazard") if key in written} | paths
    if "records" not in paths:
        raise CampaignError("Say which ground motions are run, with --records DIR or a CSV list of them.")
    keys = Assessment.model_fields.keys() - {"records", "hazard", "specimen", "scale"}
    given = {key: value for key, value in options.items() if key in keys and value is not None}
    # The model keeps paths inside a campaign's folder; here they may be anywhere, so they are put in afterwards.
    asked = checked(Assessment, {**written, **given, "records": "records"}, OPTIONS)
    return asked.model_copy(update=paths)


def _made(asked: Assessment, inputs: Any, pooled: xr.Dataset, where: Where) -> Assessed:
    spread = partial(in_blocks, workers=where.workers, scheduler=where.scheduler, progress=where.progress)
    with tempfile.TemporaryDirectory(prefix="colonnade-") as blocks:
        try:
            result = made(asked, spread, Path(blocks), "", {"specimen": pooled}, inputs)
        except ColonnadeError as error:
            return Assessed(OWN, _failed(asked.specimen, asked.measure, str(error)), None)
    return Assessed(OWN, AssessmentSummary.model_validate_json(result.attrs["answer"]), result)


def _failed(specimen: str, measure: str, reason: str) -> AssessmentSummary:
    return AssessmentSummary(status="failed", reason=reason, specimen=specimen, measure=measure)
