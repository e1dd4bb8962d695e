"""The moving block of a test, from what is stored of it."""

from __future__ import annotations

from colonnade.campaign import Test
from colonnade.campaign.specimen import Specimen
from colonnade.dynamics.block import Block
from colonnade.figures.drawing.described import body_of
from colonnade.figures.files.output import Movie
from colonnade.figures.moving import rocking_block
from colonnade.figures.panels.curve import Curve
from colonnade.figures.stored.curves import base_displacement, true_angle
from colonnade.store.records.stored import Stored


def animation(test: Test, specimen: Specimen, stored: Stored, block: Block) -> Movie | None:
    """Draw the block of a test as it rocks, measured and by each model; None without an angle."""
    angles: dict[str, Curve] = {}
    histories = [("measured", "rocking", None), *((model, "predict", model) for model in stored.models("predict"))]
    for name, stage, model in histories:
        if stored.has(stage, "rocking_angle", model):
            times, values = (stored.array(stage, each, model) for each in ("elapsed", "rocking_angle"))
            angles[name] = Curve(times, true_angle(stored, values) if stage == "rocking" else values)
    if not angles:
        return None
    base, how = base_displacement(stored)
    title = f"{test.id}: the rocking block"
    said = "measured and predicted" if len(angles) > 1 else next(iter(angles))
    return rocking_block(angles, body_of(specimen, block), base, title=title, description=f"{said}; base: {how}.")
