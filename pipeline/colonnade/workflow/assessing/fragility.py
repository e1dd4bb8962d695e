"""Assessments that are asked for at the command line: those of a campaign, or a question of one's own."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from pydantic import ValidationError

from colonnade.campaign import Campaign
from colonnade.campaign.assessing.assessed import AssessmentSummary
from colonnade.campaign.assessing.assessment import Assessment
from colonnade.campaign.assessing.prototype import Prototype
from colonnade.campaign.syntax.table import Table
from colonnade.errors import CampaignError, ColonnadeError, nearest
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.assessing.steps import made
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.execution.blocks import Counted, in_blocks
from colonnade.workflow.execution.lock import only_run
from colonnade.workflow.pooling import restitution_taken
from colonnade.workflow.steps import Graph
from colonnade.workflow.walk import Walk

if TYPE_CHECKING:
    import xarray as xr

Written = TypeVar("Written", bound=Table)

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
    for name in names:
        if name not in campaign.assessments:
            known = nearest(name, campaign.assessments)
            raise CampaignError(f'{campaign.path.name} has no assessment "{name}".{known}')
    chosen = {name: campaign.assessments[name] for name in names or campaign.assessments}
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


def assess_own(
    campaign: Campaign, layout: Layout, base: str | None, specimen: str | None, options: Mapping[str, Any], where: Where
) -> Assessed:
    """
    Answer a question of one's own about a specimen of a campaign; nothing is stored.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    base : str or None
        Name of the assessment of the campaign whose keys count if no option replaces them.
    specimen : str or None
        Id; default that of `base`.
    options : mapping
        Keys of [assessments.<name>] and of [prototype.<specimen>], as in a campaign file; paths may be anywhere.
    where : Where

    Raises
    ------
    CampaignError
        If an option or a name is not usable, or something is missing.
    """
    known = campaign.assessments
    if base is not None and base not in known:
        raise CampaignError(f'{campaign.path.name} has no assessment "{base}".{nearest(base, known)}')
    written = {} if base is None else known[base].model_dump(exclude_none=True)
    name = specimen or written.get("specimen")
    if name is None:
        raise CampaignError("Say which column is asked about, with --specimen ID.")
    if name not in campaign.specimens:
        raise CampaignError(f'{campaign.path.name} has no specimen "{name}".{nearest(name, campaign.specimens)}')
    asked = _asked(written | {"specimen": name}, options)
    own = campaign.prototype.get(name)
    prototype = _prototype({} if own is None else own.model_dump(exclude_none=True), options)
    changed = replace(campaign, prototype={**campaign.prototype, name: prototype}, assessments={OWN: asked})
    from colonnade.stages.assessing.plan import AssessmentInputs

    inputs = AssessmentInputs.of(changed, asked)
    return _made(asked, inputs, restitution_taken(campaign, layout, name), where)


def assess_column(critical_angle: float, p: float, options: Mapping[str, Any], where: Where) -> Assessed:
    """
    Answer a question about a column that is no specimen of a campaign; arguments and errors as of `assess_own`.

    Parameters
    ----------
    critical_angle : float
        rad.
    p : float
        rad/s.
    options, where
        As of `assess_own`.
    """
    from math import pi

    from colonnade.dynamics.spectra.spectrum import rectangular
    from colonnade.stages.assessing.plan import AssessmentInputs
    from colonnade.stages.specimen import SpecimenInputs, taken

    if options.get("scale") not in (None, 1.0):
        raise CampaignError("--scale is for a specimen. With --critical-angle and --p give those of the real column.")
    if options.get("restitution") == "identified":
        raise CampaignError("--restitution identified: e is identified of a specimen. Give CAMPAIGN and --specimen.")
    asked = _asked({"specimen": OWN}, options)
    try:
        block = rectangular(critical_angle, 2 * pi / p)
    except ValueError as error:
        raise CampaignError(f"The column cannot be: {error}.") from None
    prototype = _prototype({"restitution": "rigid-body"}, options)
    inputs = AssessmentInputs(block=block, scale=1.0, prototype=prototype, specimen=OWN, asked=asked)
    return _made(asked, inputs, taken(None, SpecimenInputs(block=block, given=None, level=0.95)), where)


def _asked(written: dict[str, Any], options: Mapping[str, Any]) -> Assessment:
    """Put options over the keys of an assessment; their files may be anywhere."""
    if options.get("measure") not in (None, written.get("measure")):
        # Levels and hazard are of another measure.
        written = {key: value for key, value in written.items() if key not in ("levels", "hazard")}
    paths = {key: Path(options[key]) for key in ("records", "hazard") if options.get(key) is not None}
    paths = {key: written.pop(key) for key in ("records", "hazard") if key in written} | paths
    if "records" not in paths:
        raise CampaignError("Say which ground motions are run, with --records DIR or a CSV list of them.")
    keys = Assessment.model_fields.keys() - {"records", "hazard"}
    given = {key: value for key, value in options.items() if key in keys and value is not None}
    # A placeholder for what may not leave a campaign's folder, and here may.
    asked = _validated(Assessment, {**written, **given, "records": "records"})
    return asked.model_copy(update=paths)


def _prototype(written: dict[str, Any], options: Mapping[str, Any]) -> Prototype:
    """Put options over what a campaign says of the real column."""
    given = {key: options[key] for key in Prototype.model_fields if options.get(key) is not None}
    # Limits of another value are none of this one.
    written = {key: value for key, value in written.items() if key.removesuffix("_range") not in given}
    if "restitution" not in written | given:
        raise CampaignError(
            'The e of the real column is not given. Add --restitution: a number, "rigid-body", or "identified" to '
            "assume that of the model."
        )
    checked = _validated(Prototype, {"restitution": written.get("restitution"), **given})
    return checked.model_copy(update={key: value for key, value in written.items() if key not in given})


def _validated(model: type[Written], written: dict[str, Any]) -> Written:
    try:
        return model.model_validate(written)
    except ValidationError as error:
        named = ((str(each["loc"][0]), each["msg"]) for each in error.errors())
        problems = [f"--{OPTIONS.get(key, key).replace('_', '-')}: {said}" for key, said in named]
        raise CampaignError("\n".join(problems)) from None


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
