"""The table of stages: what each reads, where it writes, and the function that does it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from colonnade.campaign import Campaign, Test
from colonnade.store.layout import Layout

if TYPE_CHECKING:
    import xarray as xr

STAGES = ("ingest", "condition", "rocking", "restitution", "predict", "ensemble", "compare", "report")
"""In the order of the data's way."""

_ENSEMBLE = "ensemble "
"""What the name of an ensemble begins with among the results that `compare` reads."""

CONTACT = "contact"
"""The model that needs a law of contact."""

WITHOUT_PREDICTION = ("tilt", "other")
"""Kinds of test that have no base motion to predict from."""


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
        return STAGES.index({"specimen": "restitution", "contact": "predict"}.get(self.stage, self.stage))

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
            "ingest", recorded, dict(test.files), ingest.instructions(campaign, test), partial(_ingest, campaign.folder)
        ),
        Step(
            "condition",
            conditioned,
            {"recorded": recorded},
            condition.instructions(campaign, test),
            lambda upstream, read: condition.condition(upstream["recorded"], read),
        ),
        Step(
            "rocking",
            angle,
            {"conditioned": conditioned},
            rocking.instructions(campaign, test),
            lambda upstream, read: rocking.rocking(upstream["conditioned"], read),
        ),
    ]
    if test.kind == "free-vibration":
        steps.append(
            Step(
                "restitution",
                layout.stage(test.id, "restitution"),
                {"rocking": angle},
                restitution.instructions(campaign, test),
                lambda upstream, read: restitution.restitution(upstream["rocking"], read),
            )
        )
    return steps


def specimen_step(campaign: Campaign, layout: Layout, specimen_id: str, identified: Mapping[str, Path]) -> Step:
    """Step that pools the free vibrations of a specimen, given their results by test."""
    from colonnade.stages import specimen

    path = layout.specimen(specimen_id)
    read = specimen.instructions(campaign, specimen_id)
    return Step("specimen", path, dict(identified), read, specimen.specimen)


def contact_step(campaign: Campaign, layout: Layout, specimen_id: str) -> Step:
    """Step that finds the law of contact with which a specimen has its restitution."""
    from colonnade.stages import contact

    return Step(
        CONTACT,
        layout.contact(specimen_id),
        {"specimen": layout.specimen(specimen_id)},
        contact.instructions(campaign, specimen_id),
        lambda upstream, read: contact.contact(upstream["specimen"], read),
    )


def models_of(campaign: Campaign, test: Test) -> tuple[str, ...]:
    """Models that a test is predicted by."""
    return () if test.kind in WITHOUT_PREDICTION else campaign.processing.predict.models


def predicting_steps(campaign: Campaign, layout: Layout, test: Test) -> list[Step]:
    """Steps from what was measured to how far predictions agree."""
    from colonnade.stages import compare, predict

    rocking, specimen = layout.stage(test.id, "rocking"), layout.specimen(test.specimen)
    models = models_of(campaign, test)
    predicted = {model: layout.stage(test.id, "predict", model) for model in models}
    steps = [
        Step(
            "predict",
            path,
            {"rocking": rocking, "specimen": specimen}
            | _identified(layout, test)
            | ({CONTACT: layout.contact(test.specimen)} if model == CONTACT else {}),
            predict.instructions(campaign, test, model),
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
            compare.instructions(campaign, test),
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
                CONTACT: layout.contact(test.specimen),
            }
            | _identified(layout, test),
            contact_ensemble.instructions(campaign, test),
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
            "specimen": layout.specimen(test.specimen),
        }
        | _identified(layout, test),
        ensemble.instructions(campaign, test, model),
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
