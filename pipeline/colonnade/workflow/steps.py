"""The table of stages: what each reads, where it writes, and the function that does it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from colonnade.campaign import Campaign, Test
from colonnade.store.layout import Layout
from colonnade.store.results import ResultId, models_of

if TYPE_CHECKING:
    import xarray as xr

_ENSEMBLE = "ensemble "
"""What the name of an ensemble begins with among the results that `compare` reads."""

CONTACT = "contact"
"""The model that needs a law of contact."""


@dataclass(frozen=True)
class Step:
    """
    One stage of one test.

    Attributes
    ----------
    stage : str
        One of `STAGES`, "specimen" or "contact".
    path : Path
        Of the result.
    upstream : dict of str to Path
        Results that it reads, by name; of ingest, raw files by recorder.
    instructions : Any
        The stage's own model of what it reads of the campaign.
    work : callable
        Takes the upstream results and the instructions, returns the result.
    model : str or None
        Of a prediction.
    """

    stage: str
    path: Path
    upstream: dict[str, Path]
    instructions: Any
    work: Callable[[Mapping[str, Any], Any], xr.Dataset]
    model: str | None = None

    @property
    def order(self) -> int:
        """Place of its stage in `STAGES`; a specimen's own come with the stages of its tests that they serve."""
        return ResultId("", self.stage).order

    @property
    def is_of_specimen(self) -> bool:
        """Whether it is about a specimen rather than a test."""
        return self.stage in ("specimen", "contact")

    @property
    def is_from_raw(self) -> bool:
        """Whether it reads raw files rather than results."""
        return self.stage == "ingest"


def measuring_steps(campaign: Campaign, layout: Layout, test: Test) -> list[Step]:
    """Steps from the raw files to what was measured."""
    from colonnade.stages import condition, ingest, restitution, rocking

    recorded, conditioned, angle = (layout.stage(test.id, stage) for stage in ("ingest", "condition", "rocking"))
    steps = [
        Step(
            "ingest",
            recorded,
            dict(test.files),
            ingest.IngestInputs.of(campaign, test),
            partial(_ingest, campaign.folder),
        ),
        Step(
            "condition",
            conditioned,
            {"recorded": recorded},
            condition.ConditionInputs.of(campaign, test),
            lambda upstream, read: condition.condition(upstream["recorded"], read),
        ),
        Step(
            "rocking",
            angle,
            {"conditioned": conditioned},
            rocking.RockingInputs.of(campaign, test),
            lambda upstream, read: rocking.rocking(upstream["conditioned"], read),
        ),
    ]
    if test.kind == "free-vibration":
        steps.append(
            Step(
                "restitution",
                layout.stage(test.id, "restitution"),
                {"rocking": angle},
                restitution.RestitutionInputs.of(campaign, test),
                lambda upstream, read: restitution.restitution(upstream["rocking"], read),
            )
        )
    return steps


def specimen_step(campaign: Campaign, layout: Layout, specimen_id: str, identified: Mapping[str, Path]) -> Step:
    """Step that pools the free vibrations of a specimen, given their results by test."""
    from colonnade.stages import specimen

    path = layout.stage(specimen_id, "specimen")
    read = specimen.SpecimenInputs.of(campaign, specimen_id)
    return Step("specimen", path, dict(identified), read, specimen.specimen)


def contact_step(campaign: Campaign, layout: Layout, specimen_id: str) -> Step:
    """Step that finds the law of contact with which a specimen has its restitution."""
    from colonnade.stages import contact

    return Step(
        CONTACT,
        layout.stage(specimen_id, "contact"),
        {"specimen": layout.stage(specimen_id, "specimen")},
        contact.ContactInputs.of(campaign, specimen_id),
        lambda upstream, read: contact.contact(upstream["specimen"], read),
    )


def predicting_steps(campaign: Campaign, layout: Layout, test: Test) -> list[Step]:
    """Steps from what was measured to how far predictions agree."""
    from colonnade.stages import compare, predict

    rocking, specimen = layout.stage(test.id, "rocking"), layout.stage(test.specimen, "specimen")
    models = models_of(campaign, test)
    predicted = {model: layout.stage(test.id, "predict", model) for model in models}
    steps = [
        Step(
            "predict",
            path,
            {"rocking": rocking, "specimen": specimen}
            | _identified(layout, test)
            | ({CONTACT: layout.stage(test.specimen, "contact")} if model == CONTACT else {}),
            predict.PredictInputs.of(campaign, test, model),
            lambda upstream, read: predict.predict(
                upstream["rocking"], upstream["specimen"], read, upstream.get(CONTACT), upstream.get("restitution")
            ),
            model,
        )
        for model, path in predicted.items()
    ]
    ensembles = [
        _ensemble(campaign, layout, test, model) for model in models if campaign.processing.predict.members(model) > 0
    ]
    spread = {step.model: step.path for step in ensembles}
    steps += ensembles
    steps.append(
        Step(
            "compare",
            layout.stage(test.id, "compare"),
            {"rocking": rocking, **predicted, **{f"{_ENSEMBLE}{model}": path for model, path in spread.items()}},
            compare.CompareInputs.of(campaign, test),
            _compare,
        )
    )
    return steps


def _ensemble(campaign: Campaign, layout: Layout, test: Test, model: str) -> Step:
    """Step that repeats the prediction of a model over what is not exactly known."""
    from colonnade.stages import contact_ensemble, ensemble

    path, rocking = layout.stage(test.id, "ensemble", model), layout.stage(test.id, "rocking")
    if model == CONTACT:
        return Step(
            "ensemble",
            path,
            {
                "conditioned": layout.stage(test.id, "condition"),
                "rocking": rocking,
                CONTACT: layout.stage(test.specimen, "contact"),
            }
            | _identified(layout, test),
            contact_ensemble.ContactEnsembleInputs.of(campaign, test),
            lambda upstream, read: contact_ensemble.contact_ensemble(
                upstream["conditioned"], upstream["rocking"], upstream[CONTACT], read, upstream.get("restitution")
            ),
            model,
        )
    return Step(
        "ensemble",
        path,
        {
            "conditioned": layout.stage(test.id, "condition"),
            "rocking": rocking,
            "specimen": layout.stage(test.specimen, "specimen"),
        }
        | _identified(layout, test),
        ensemble.EnsembleInputs.of(campaign, test, model),
        lambda upstream, read: ensemble.ensemble(
            upstream["conditioned"], upstream["rocking"], upstream["specimen"], read, upstream.get("restitution")
        ),
        model,
    )


def _identified(layout: Layout, test: Test) -> dict[str, Path]:
    """What the free vibration itself gave: the zero of its angle."""
    return {"restitution": layout.stage(test.id, "restitution")} if test.kind == "free-vibration" else {}


def _compare(upstream: Mapping[str, Any], read: Any) -> xr.Dataset:
    from colonnade.stages.compare import compare

    results = {name: each for name, each in upstream.items() if name != "rocking"}
    ensembles = {name: each for name, each in results.items() if name.startswith(_ENSEMBLE)}
    predicted = {name: each for name, each in results.items() if name not in ensembles}
    by_model = {name.removeprefix(_ENSEMBLE): each for name, each in ensembles.items()}
    return compare(upstream["rocking"], predicted, read, by_model)


def _ingest(folder: Path, paths: Mapping[str, Path], read: Any) -> xr.Dataset:
    from colonnade.readers.registry import read as read_recording
    from colonnade.stages.ingest import ingest

    recordings = {}
    for recorder, path in paths.items():
        how = read.files[recorder]
        window = read.wanted(recorder)
        recordings[recorder] = read_recording(path, how["format"], how["options"], window=window, within=folder)
    return ingest(recordings, read)
