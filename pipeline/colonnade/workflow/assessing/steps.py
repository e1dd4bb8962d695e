"""The step of an assessment: what it is made from, and how its histories are run."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from colonnade.campaign.assessing.assessment import Assessment
from colonnade.errors import ReadError
from colonnade.readers.files import sha256_of
from colonnade.readers.ground_motions.record_set import files_of
from colonnade.store.freshness import Recipe
from colonnade.store.provenance import hash_of
from colonnade.store.results import ResultId
from colonnade.workflow.catalogue import Catalogue
from colonnade.workflow.execution.blocks import Spread
from colonnade.workflow.steps import FORMATS, Graph, Step

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.stages.assessing.plan import AssessmentInputs

MADE_BY = ("colonnade.stages.assessment", "colonnade.workflow.assessing")
"""Modules whose code makes assessments; what they import counts too."""


def assessing(graph: Graph, name: str, asked: Assessment, spread: Spread) -> Step:
    """
    Return the step of an assessment.

    Parameters
    ----------
    graph : Graph
    name : str
    asked : Assessment
        With the whole paths of its files.
    spread : Spread
        Runs blocks of histories.
    """
    from colonnade.stages.assessing.plan import AssessmentInputs

    result, layout = ResultId(name, "assessment"), graph.layout
    code = graph.catalogue.code((*MADE_BY, FORMATS))
    work = partial(made, asked, spread, layout.blocks(result), code)
    return Step(
        result,
        layout.path(result),
        {"specimen": layout.stage(asked.specimen, "specimen")},
        AssessmentInputs.of(graph.campaign, asked),
        work,
        code,
        _given(asked, graph.catalogue),
    )


def _given(asked: Assessment, catalogue: Catalogue) -> dict[str, str | None]:
    """Hash the files that an assessment reads; a set that cannot be listed is reported when it is read."""
    try:
        records = files_of(asked.records)
    except ReadError:
        records = []
    # Files of a list may have one name, in different folders.
    digests = [[path.name, _digest(catalogue, path)] for path in records]
    return {"records": hash_of(digests), "hazard": None if asked.hazard is None else _digest(catalogue, asked.hazard)}


def _digest(catalogue: Catalogue, path: Path) -> str | None:
    found = catalogue.lookup("raw", path, sha256_of, "ground motion")
    return None if found is None else found[1]


def made(
    asked: Assessment, spread: Spread, blocks: Path, code: str, upstream: Mapping[str, Any], inputs: AssessmentInputs
) -> xr.Dataset:
    """
    Make an assessment.

    Parameters
    ----------
    asked : Assessment
        With the whole paths of its files.
    spread : Spread
    blocks : Path
        Folder for the finished blocks of its histories.
    code : str
        Hash of the code, by which such blocks are known again.
    upstream : mapping
        The result of `specimen`.
    inputs : AssessmentInputs

    Raises
    ------
    ColonnadeError
        If a file cannot be read, or the records allow no answer.
    """
    from colonnade.readers.ground_motions.hazard import read_hazard_of
    from colonnade.readers.ground_motions.record_set import read_record_set
    from colonnade.stages.assessing.plan import plan_assessment
    from colonnade.stages.assessment import assessment
    from colonnade.workflow.assessing.blocks import given, outcomes_of

    hazard = None if asked.hazard is None else read_hazard_of(asked.hazard, asked.measure)
    plan = plan_assessment(upstream["specimen"], read_record_set(asked.records), hazard, inputs)
    outcomes = {}
    for number, (name, study) in enumerate(plan.studies.items()):
        key = Recipe("assessment", code, "", given(study.cases)).key
        outcomes[name] = outcomes_of(study.cases, spread, blocks / str(number), key)
    return assessment(plan, outcomes)
