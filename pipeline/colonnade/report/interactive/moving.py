"""The block itself as it moves: its outline, the poles, the base below it, and the angles that turn it."""

from __future__ import annotations

from typing import Any

import numpy as np

from colonnade.campaign.specimen import Specimen
from colonnade.dynamics.block import Block
from colonnade.figures.drawing.described import body_of
from colonnade.figures.drawing.parts import Body, Rocking
from colonnade.figures.stored.curves import base_displacement, measured_ratio, motion, predicted_ratios
from colonnade.figures.style import model_style
from colonnade.report.interactive.panels import Samples
from colonnade.store.records.stored import Stored


def outline(body: Body) -> list[tuple[float, float]]:
    """Return the corners of a specimen seen along y, x and z in m: from the left end of its base around its top."""
    base, top = (size / 2 for size in body.width)
    return [(-base, 0.0), (-top, body.height), (top, body.height), (base, 0.0)]


def of_test(specimen: Specimen, block: Block, stored: Stored, samples: Samples) -> dict[str, Any]:
    """Describe the moving block for the script: measured and by each model, on the recorded motion of the base."""
    body, rocking = body_of(specimen, block), Rocking.of(block)
    measured, slide = measured_ratio(stored, block), motion(stored, "slide", "mm")
    bodies = []
    if measured is not None:
        bodies.append(samples.curve("measured", *measured, colour="ink"))
        if slide is not None and np.isfinite(slide.values).any():
            bodies[0]["slide"] = samples.add(slide.values)
    for model, curve in predicted_ratios(stored, block).items():
        bodies.append(samples.curve(f"{model} model", *curve, colour=model_style(model)["color"]))
    base, how = base_displacement(stored)
    return {
        "outline": outline(body),
        "poles": rocking.poles,
        "bodies": bodies,
        "base": None if base is None else samples.curve("base", base.time, 1e3 * base.values),
        "how": f"base: {how}",
    }
