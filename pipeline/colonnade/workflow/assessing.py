"""Assessments of real columns: products of a campaign, or questions of one's own; their histories in blocks."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from colonnade.assessment.cases import CaseOutcomes, Cases, joined, run_cases
from colonnade.campaign import Campaign
from colonnade.campaign.assessment import Assessment
from colonnade.campaign.forms.assessed import AssessmentSummary
from colonnade.errors import CampaignError, ReadError
from colonnade.readers.files import sha256_of
from colonnade.readers.record_set import files_of
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of
from colonnade.store.results import ResultId
from colonnade.workflow.asked import OWN, Given, checked, find_column
from colonnade.workflow.executors import MOST_BLOCKS, Arrays, Run, Where, in_blocks
from colonnade.workflow.graph import FORMATS, Graph, expect_known
from colonnade.workflow.product import Catalogue, Product
from colonnade.workflow.summary import record_of_assessment
from colonnade.workflow.walk import walking

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.readers.record_set import RecordSet
    from colonnade.stages.assessment_plan import AssessmentInputs, Plan

MADE_BY = ("colonnade.stages.assessment", "colonnade.workflow.assessing")
"""Modules whose code makes assessments; what they import counts too."""


@dataclass(frozen=True)
class Assessed:
    """An assessment: its name, its record, its result if it was made, and where that is stored, if it is."""

    name: str
    record: AssessmentSummary
    result: xr.Dataset | None
    path: Path | None = None


def assess(
    campaign: Campaign | None, layout: Layout | None, names: Sequence[str], given: Given, where: Where
) -> list[Assessed]:
    """
    Answer what is asked: assessments of a campaign, or with options a question of one's own, which is stored nowhere.

    Parameters
    ----------
    campaign, layout : optional
        None without a campaign.
    names : sequence of str
        Of assessments of the campaign, by default all; with options of the one, by default the only one, whose keys
        count if nothing replaces them.
    given : Given
        What says which column, by default that of the assessment, and keys of [assessments.<name>]; paths may be
        anywhere.
    where : Where

    Raises
    ------
    CampaignError
        If an option or a name is not usable, or something is missing.
    StoreError
        If a run is in progress, or a result cannot be written.
    ReadError, StageError
        If a question of one's own has no answer.
    """
    known: dict[str, Assessment] = {}
    if campaign is not None and layout is not None:
        expect_known(campaign, "assessment", names)
        known = {name: campaign.assessments[name] for name in names or campaign.assessments}
        if not given:
            return _of_campaign(campaign, layout, known, where)
    if len(names) > 1:
        raise CampaignError("Options are for one assessment. Name one.")
    written = next(iter(known.values())).model_dump(exclude_none=True) if len(known) == 1 else {}
    return [_assess_own(campaign, layout, written, given, where)]


def _of_campaign(campaign: Campaign, layout: Layout, chosen: Mapping[str, Assessment], where: Where) -> list[Assessed]:
    """Bring assessments up to date, with the e that is identified so far."""
    if not chosen:
        raise CampaignError(
            f"{campaign.path.name} has no [assessments.<name>]. Add one, or ask with --specimen ID --records DIR."
        )
    with walking(campaign, layout, where) as walk:
        walk.pool(sorted({asked.specimen for asked in chosen.values()}))
        walk.assess(chosen)
    found = []
    for name, asked in chosen.items():
        record = record_of_assessment(layout, name, asked, walk.failed["assessment"].get(name, ""))
        assert record is not None  # it was made or it failed
        path = layout.stage(name, "assessment") if record.status == "done" else None
        found.append(Assessed(name, record, None if path is None else files.read(path), path))
    return found


def _assess_own(
    campaign: Campaign | None, layout: Layout | None, written: dict[str, Any], given: Given, where: Where
) -> Assessed:
    """Answer a question with options over the keys of an assessment."""
    from colonnade.stages.assessment_plan import AssessmentInputs

    meant = {key: written[key] for key in ("specimen", "scale") if key in written} | dict(given)
    found = find_column(meant, campaign, layout, is_real=True)
    name = found.specimen or OWN
    asked = _asked(written | {"specimen": name, "scale": found.inputs.scale}, given)
    inputs = AssessmentInputs(**dict(found.inputs), specimen=name, asked=asked)
    with tempfile.TemporaryDirectory(prefix="colonnade-") as blocks:
        run = partial(in_blocks, folder=Path(blocks), key="own", where=where)
        result = _made(asked, inputs=inputs, specimen=found.pooled, run=run)
    return Assessed(OWN, AssessmentSummary.model_validate_json(result.attrs["answer"]), result)


def _asked(written: dict[str, Any], given: Given) -> Assessment:
    """Put options over the keys of an assessment; their files may be anywhere."""
    if given.get("measure", written.get("measure")) != written.get("measure"):
        # Levels and hazard are of another measure.
        written = {key: value for key, value in written.items() if key not in ("levels", "hazard")}
    keys = written | {key: given[key] for key in given.keys() & Assessment.model_fields.keys() - {"specimen", "scale"}}
    # The model keeps paths inside a campaign's folder; here they may be anywhere, so they are put in afterwards.
    paths: dict[str, Path] = {key: Path(keys.pop(key)) for key in ("records", "hazard") if key in keys}
    if "records" not in paths:
        raise CampaignError("Say which ground motions are run, with --records DIR or a CSV list of them.")
    return checked(Assessment, keys | {"records": "records"}).model_copy(update=paths)


def assessing(graph: Graph, name: str, asked: Assessment, where: Where) -> Product:
    """Return an assessment of a campaign; `asked` has the whole paths of its files."""
    from colonnade.stages.assessment_plan import AssessmentInputs

    upstream = {"specimen": ResultId(asked.specimen, "specimen"), **_given(asked, graph.catalogue)}
    inputs, code = AssessmentInputs.of(graph.campaign, asked), (*MADE_BY, FORMATS)
    return graph.product(ResultId(name, "assessment"), inputs, upstream, partial(_made, asked), *code, where=where)


def _given(asked: Assessment, catalogue: Catalogue) -> dict[str, str | None]:
    """Hash the files that an assessment reads; a set that cannot be listed is reported when it is read."""
    records: Sequence[Path] = ()
    with suppress(ReadError):
        records = files_of(asked.records)
    # Files of a list may have one name, in different folders.
    digests = [[path.name, _digest(catalogue, path)] for path in records]
    return {"records": hash_of(digests), "hazard": None if asked.hazard is None else _digest(catalogue, asked.hazard)}


def _digest(catalogue: Catalogue, path: Path) -> str | None:
    found = catalogue.entry("raw", path, sha256_of, "ground motion")
    return None if found is None else found[1]


def _made(asked: Assessment, *, inputs: AssessmentInputs, specimen: xr.Dataset, run: Run) -> xr.Dataset:
    from colonnade.stages.assessment import assessment

    _, plan = planned(asked, inputs, specimen)
    studies = enumerate(plan.studies.items())
    return assessment(plan, {name: outcomes_of(study.cases, run, str(number)) for number, (name, study) in studies})


def planned(asked: Assessment, inputs: AssessmentInputs, specimen: xr.Dataset) -> tuple[RecordSet, Plan]:
    """Read the ground motions and the hazard of an assessment, and plan it."""
    from colonnade.readers.hazard import read_hazard
    from colonnade.readers.record_set import read_record_set
    from colonnade.stages.assessment_plan import plan_assessment

    hazard = None if asked.hazard is None else read_hazard(asked.hazard, asked.measure)
    records = read_record_set(asked.records)
    return records, plan_assessment(specimen, records, hazard, inputs)


def outcomes_of(cases: Cases, run: Run, part: str = "") -> CaseOutcomes:
    """Run all cases of an assessment in blocks; the same to the last bit, whatever the processes and interruptions."""
    return joined([CaseOutcomes(**each) for each in run(_arrays, cases.blocks(MOST_BLOCKS), part=part)])


def _arrays(block: Cases) -> Arrays:
    return vars(run_cases(block))
