"""Whether the measured angle is within each model's own spread."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan

from colonnade.campaign.forms.summary import PredictionSummary
from colonnade.figures.files.output import Picture
from colonnade.identification.response.rank import FEWEST, is_within
from colonnade.report.pictures.registry import picture
from colonnade.report.pictures.subjects import OfTest
from colonnade.units.text import format_percent, quantity


@dataclass(frozen=True)
class ModelSpread:
    """`verdicts` has a sentence for each model; `bands` is None without an ensemble."""

    verdicts: list[str]
    bands: Picture | None


def of_test(subject: OfTest) -> ModelSpread:
    """Say of each model whether the measured angle is within its spread, and draw the bands."""
    predictions = subject.row.record.predicted.items()
    verdicts = (verdict_sentence(model, predicted) for model, predicted in predictions)
    return ModelSpread(list(filter(None, verdicts)), picture("bands", subject))


def verdict_sentence(model: str, predicted: PredictionSummary) -> str:
    """Say whether the measured angle is within the model's own spread, up to its horizon."""
    if predicted.horizon is None:
        return ""
    name, until = f"{model.capitalize()} model", quantity(predicted.horizon, "s", 4)
    rank = predicted.within_spread
    within = is_within(nan if rank is None else rank)
    if within is None:
        return f"{name}: predicted up to {until}; not ranked: that needs {FEWEST} runs and a measured angle."
    said = [f"{format_percent(rank or 0.0)} of the runs are closer to their median"]
    if predicted.peak_rank is not None:
        said.append(f"{format_percent(predicted.peak_rank)} stay below the measured peak")
    if predicted.overturning_probability:
        said.append(f"{format_percent(predicted.overturning_probability)} overturn")
    where = "within" if within else "outside"
    return f"{name}: the measured angle is {where} its own spread up to {until} ({'; '.join(said)})."
