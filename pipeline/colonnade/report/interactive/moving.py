"""The block itself as it moves: its outline, the poles, the base below it, and the angles that turn it."""

from __future__ import annotations

from typing import Any

import numpy as np

from colonnade.campaign.assembly import Whole
from colonnade.campaign.specimen import Specimen
from colonnade.dynamics.block import Block
from colonnade.figures.drawing.described import body_of
from colonnade.figures.drawing.parts import Body, Rocking
from colonnade.figures.stored import bodies
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
    base, how = base_displacement(stored)
    around = {
        "base": None if base is None else samples.curve("base", base.time, 1e3 * base.values),
        "how": f"base: {how}",
    }
    if isinstance(specimen, Whole):
        return _bodies(specimen, block.gravity, stored, samples) | around
    body, rocking = body_of(specimen, block), Rocking.of(block)
    measured, slide = measured_ratio(stored, block), motion(stored, "slide", "mm")
    moving = []
    if measured is not None:
        moving.append(samples.curve("measured", *measured, colour="ink"))
        if slide is not None and np.isfinite(slide.values).any():
            moving[0]["slide"] = samples.add(slide.values)
    for model, curve in predicted_ratios(stored, block).items():
        moving.append(samples.curve(f"{model} model", *curve, colour=model_style(model)["color"]))
    return {
        "height": body.height,
        "bodies": [
            {
                "name": each["name"],
                "colour": each["colour"],
                "parts": [{"outline": outline(body), "poles": rocking.poles, **each}],
            }
            for each in moving
        ],
        **around,
    }


def _bodies(specimen: Whole, gravity: float, stored: Stored, samples: Samples) -> dict[str, Any]:
    """Describe the bodies of an assembly, each turned by its angle (rad) with its slide and rise (mm)."""
    assembly = specimen.assembly(gravity)
    found: dict[str, list[dict[str, Any]]] = {}
    for place, (name, placed) in enumerate(assembly.bodies.items()):
        body = body_of(specimen.made[name], placed.block)
        slides, rises = (bodies.histories(stored, place, f"body_{each}") for each in ("slide", "uplift"))
        for who, angle in bodies.histories(stored, place, "body_angle").items():
            part = samples.curve(name, *angle, colour="") | {
                "outline": outline(body),
                "poles": Rocking.of(placed.block).poles,
                "place": [placed.position[0], assembly.levels[name]],
                "is_angle": True,
            }
            more = {"slide": slides.get(who), "rise": rises.get(who)}
            part |= {key: samples.add(1e3 * curve.values) for key, curve in more.items() if curve is not None}
            found.setdefault(who, []).append(part)
    return {
        "height": assembly.height,
        "bodies": [
            {"name": who, "colour": "ink", "parts": parts}
            if who == "measured"
            else {"name": f"{who} model", "colour": model_style(who)["color"], "parts": parts}
            for who, parts in found.items()
        ],
    }
