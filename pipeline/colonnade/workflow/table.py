"""The table of stages: what each reads, what it does, of which tests."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel

from colonnade.campaign import Test
from colonnade.stages import compare, condition, ingest, predict, restitution, rocking, specimen

if TYPE_CHECKING:
    import xarray as xr

Inputs = Mapping[str, Any]
"""What a stage is given, by the name of the stage that made it; raw files by recorder, free vibrations by test."""


@dataclass(frozen=True)
class Stage:
    """
    One row of the table.

    Attributes
    ----------
    name : str
    instructions : callable
        (campaign, test), of a stage that runs once a model (campaign, test, model), of `specimen` (campaign, specimen
        id) -> what the stage reads of the campaign.
    work : callable
        (inputs, instructions) -> Dataset.
    upstream : tuple of str
        Stages of the same test, and "specimen", whose results it reads; empty where it reads raw files.
    applies : callable
        Whether a test has this stage.
    each_model : bool
        Whether it runs once a model.
    """

    name: str
    instructions: Callable[..., BaseModel]
    work: Callable[[Inputs, Any], xr.Dataset]
    upstream: tuple[str, ...] = ()
    applies: Callable[[Test], bool] = lambda test: True
    each_model: bool = False


@dataclass(frozen=True)
class Table:
    """Stages of a test up to its restitution, the pooling of a specimen, and the stages of a test after that."""

    measured: tuple[Stage, ...]
    pooled: Stage
    predicted: tuple[Stage, ...]

    @property
    def of_tests(self) -> tuple[Stage, ...]:
        """All stages of a test."""
        return self.measured + self.predicted


def _is_free_vibration(test: Test) -> bool:
    return test.kind == "free-vibration"


def _ingest(inputs: Inputs, instructions: ingest.Instructions) -> xr.Dataset:
    return ingest.ingest(inputs, instructions)


def _condition(inputs: Inputs, instructions: condition.Instructions) -> xr.Dataset:
    return condition.condition(inputs["ingest"], instructions)


def _rocking(inputs: Inputs, instructions: rocking.Instructions) -> xr.Dataset:
    return rocking.rocking(inputs["condition"], instructions)


def _restitution(inputs: Inputs, instructions: restitution.Instructions) -> xr.Dataset:
    return restitution.restitution(inputs["rocking"], instructions)


def _specimen(inputs: Inputs, instructions: specimen.Instructions) -> xr.Dataset:
    return specimen.specimen(inputs, instructions)


def _predict(inputs: Inputs, instructions: predict.Instructions) -> xr.Dataset:
    return predict.predict(inputs["rocking"], inputs["specimen"], instructions)


def _compare(inputs: Inputs, instructions: compare.Instructions) -> xr.Dataset:
    predicted = {
        name.removeprefix("predict "): result for name, result in inputs.items() if name.startswith("predict ")
    }
    return compare.compare(inputs["rocking"], predicted, instructions)


STAGES = Table(
    measured=(
        Stage("ingest", ingest.instructions, _ingest),
        Stage("condition", condition.instructions, _condition, ("ingest",)),
        Stage("rocking", rocking.instructions, _rocking, ("condition",)),
        Stage("restitution", restitution.instructions, _restitution, ("rocking",), _is_free_vibration),
    ),
    pooled=Stage("specimen", specimen.instructions, _specimen),
    predicted=(
        Stage("predict", predict.instructions, _predict, ("rocking", "specimen"), each_model=True),
        Stage("compare", compare.instructions, _compare, ("rocking", "predict")),
    ),
)
"""The stages of colonnade."""
