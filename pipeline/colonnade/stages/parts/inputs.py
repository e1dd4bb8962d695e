"""The base class of what a stage reads of the campaign."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class Inputs(BaseModel):
    """
    What a stage reads of the campaign: parts of specimen, set-up and test, and the models of its settings.

    It is stored with the result as JSON and enters the result's key, so that it holds nothing else. A field holds of a
    larger model only what its own type declares: `settings: QualitySettings` keeps four keys of `campaign.processing`.
    """

    model_config = ConfigDict(frozen=True)
