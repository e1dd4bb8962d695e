"""The data of a test's page: histories as in its figures, channels conditioned and recorded, the moving block."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
import xarray as xr

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.block import Block
from colonnade.figures.files.output import Picture
from colonnade.figures.histories import Spread
from colonnade.figures.panels.curve import Curve
from colonnade.figures.stored import bodies
from colonnade.figures.stored.record import (
    BASE,
    MOTIONS,
    SHADED,
    misfits,
    motion,
    ratios,
    spreads,
)
from colonnade.figures.style import model_style
from colonnade.report.interactive import panels
from colonnade.report.interactive.panels import Samples, script, tables_of
from colonnade.store.records.stored import GOOD, Stored
from colonnade.units import from_si
from colonnade.units.text import CHANNEL_UNITS, format_percent

PROPORTIONAL = 1e-6
"""A channel in SI is a straight line of what was recorded if no sample is further from it, over the largest."""

TOO_MANY = "Too many samples for a page; they are in the stored results of this test."
"""Said of a group of panels that is left out."""

Panel = dict[str, Any]


def of_test(
    campaign: Campaign,
    test: Test,
    stored: Stored,
    pictures: Iterable[Picture],
    recorded: xr.Dataset | None,
    conditioned: xr.Dataset | None,
) -> str:
    """
    Return the script with the data of a test's page.

    Parameters
    ----------
    campaign : Campaign
    test : Test
    stored : Stored
        What is known of the test.
    pictures : iterable of Picture
        Those of the page.
    recorded, conditioned : Dataset or None
        Results of `ingest` and `condition` with their samples.
    """
    block, samples = campaign.block(test.specimen), Samples()
    groups: list[tuple[str, bool, Callable[[Samples], list[Panel]]]] = [
        ("Response", True, partial(_response, stored, block)),
        ("Table motion", False, partial(_base, stored, block)),
        ("Channels, conditioned", False, partial(_conditioned, conditioned)),
        ("Channels, as recorded", False, partial(_recorded, recorded, conditioned)),
    ]
    shown: list[dict[str, Any]] = []
    for title, is_open, panels_of in groups:
        samples, found = samples.with_more(panels_of)
        if found is None or found:
            note = TOO_MANY if found is None else ""
            shown.append({"title": title, "is_open": is_open, "panels": found or [], "note": note})
    drawn = [group for group in shown if group["panels"]]
    if drawn:
        drawn[0]["is_open"] = True
    moves = None
    if any(panel.get("is_angle") for group in drawn for panel in group["panels"]):
        samples, moves = samples.with_more(partial(panels.of_test, campaign.specimens[test.specimen], block, stored))
    critical = [block.negative.critical_angle, block.positive.critical_angle]
    samples, tables = tables_of(pictures, samples)
    return script(test.id, samples, groups=shown if drawn else [], critical=critical, moving=moves, tables=tables)


def _response(stored: Stored, block: Block, samples: Samples) -> list[Panel]:
    return [
        *_angles(stored, block, samples),
        *_joints(stored, samples),
        *_misfit(stored, block, samples),
        *_motions(stored, samples),
    ]


def _panel(title: str, short: str, unit: str, curves: list[dict[str, Any]], **more: Any) -> list[Panel]:
    """Describe a panel; none without a curve."""
    return [{"title": title, "short": short, "unit": unit, "curves": curves, **more}] if curves else []


def _compared(curves: Mapping[str, Curve], samples: Samples, factor: float = 1.0) -> list[dict[str, Any]]:
    """Describe curves as measured and by each model."""
    return [
        samples.curve("measured", curve.time, factor * curve.values, colour="ink", width=1.3)
        if who == "measured"
        else samples.curve(f"{who} model", curve.time, factor * curve.values, **_look(who))
        for who, curve in curves.items()
        if _has(curve)
    ]


def _angles(stored: Stored, block: Block, samples: Samples) -> list[Panel]:
    curves = _compared(ratios(stored, block), samples)
    if not curves:
        return []
    bands, marks = [], []
    found = spreads(stored, block)
    for model, spread in found.items():
        bands += _bands(model, spread, samples, is_open=model == SHADED or len(found) == 1)
        if np.isfinite(spread.horizon) and spread.horizon < spread.time[-1]:
            text = f"horizon, {model} model"
            marks.append({"name": text, "time": spread.horizon, "colour": model_style(model)["color"]})
    title, more = "Rocking angle over critical angle, θ/α", {"is_angle": True, "levels": [1.0, -1.0]}
    return _panel(title, "θ/α", "", curves, bands=bands, marks=marks, **more)


def _bands(model: str, spread: Spread, samples: Samples, *, is_open: bool) -> list[dict[str, Any]]:
    clock, look = samples.clock(spread.time), _look(model)
    return [
        {
            "name": f"{model} model, {format_percent(spread.share(index))} of runs",
            "clock": clock,
            "low": samples.add(spread.bands[index]),
            "high": samples.add(spread.bands[-1 - index]),
            "colour": look["colour"],
            "dash": look["dash"],
            "is_hidden": not (is_open and index == 0),
        }
        for index in range(spread.levels.size // 2)
    ]


def _joints(stored: Stored, samples: Samples) -> list[Panel]:
    """One panel for the joint below each body of an assembly, the upper ones first."""
    found = []
    for place, name in reversed(list(enumerate(stored.array("rocking", "body")))):
        curves = _compared(bodies.histories(stored, place, "body_joint_angle"), samples, 1e3)
        found += _panel(f"Rocking angle in the joint below {name}", f"joint below {name}", "mrad", curves)
    return found


def _misfit(stored: Stored, block: Block, samples: Samples) -> list[Panel]:
    found = misfits(stored, ratios(stored, block))
    return _panel("Predicted minus measured, over critical angle", "misfit", "", _compared(found, samples))


def _motions(stored: Stored, samples: Samples) -> list[Panel]:
    """One panel for lengths, one for angles."""
    found: dict[str, list[dict[str, Any]]] = {}
    for index, (name, words, _, unit) in enumerate(MOTIONS):
        curve = motion(stored, name, unit)
        if curve is not None and _has(curve):
            found.setdefault(unit, []).append(samples.curve(words, *curve, **_numbered(index)))
    named = {unit: [curve["name"] for curve in curves] for unit, curves in found.items()}
    return [
        panel
        for unit, curves in found.items()
        for panel in _panel(", ".join(named[unit]).capitalize(), " ".join(named[unit]), unit, curves)
    ]


def _base(stored: Stored, block: Block, samples: Samples) -> list[Panel]:
    found = []
    for name, words, _, unit in BASE:
        curve = motion(stored, name, unit)
        if curve is not None and _has(curve):
            level = block.uplift_acceleration
            levels = [level, -level] if name == "base_acceleration" else []
            curves = [samples.curve(words, *curve, colour="soft", width=1)]
            title = words.capitalize() + ("; dotted: ± g tan α" if levels else "")
            found += _panel(title, words, unit, curves, levels=levels)
    return found


def _conditioned(conditioned: xr.Dataset | None, samples: Samples) -> list[Panel]:
    """One panel a quantity, with all channels that measure it."""
    if conditioned is None:
        return []
    time = conditioned["elapsed"].to_numpy()
    found: dict[str, list[dict[str, Any]]] = {}
    for variable in conditioned.data_vars.values():
        channel, quantity = variable.attrs.get("channel"), str(variable.attrs.get("quantity"))
        if channel is not None and quantity in CHANNEL_UNITS:
            curves = found.setdefault(quantity, [])
            values = from_si(1.0, CHANNEL_UNITS[quantity]) * variable.to_numpy()
            curves.append(samples.curve(str(channel), time, values, **_numbered(len(curves))))
    panels = []
    for quantity, curves in found.items():
        words = quantity.replace("_", " ")
        panels += _panel(f"{words.capitalize()}, conditioned", f"conditioned {words}", CHANNEL_UNITS[quantity], curves)
    return panels


def _recorded(recorded: xr.Dataset | None, conditioned: xr.Dataset | None, samples: Samples) -> list[Panel]:
    """One panel a channel, in the unit of the file with SI at the right, on the common clock where that is known."""
    if recorded is None:
        return []
    found = []
    for name, variable in recorded.data_vars.items():
        channel = variable.attrs.get("channel")
        if channel is None or f"{name}_recorded" not in recorded:
            continue
        as_recorded = recorded[f"{name}_recorded"]
        offset = conditioned[name].attrs if conditioned is not None and name in conditioned else {}
        time = _on_common_clock(recorded[str(variable.dims[0])].to_numpy(), offset)
        if not (time.size and np.isfinite(time).all()):
            continue
        quantity, unit = str(variable.attrs.get("quantity")), str(variable.attrs.get("recorded_unit", ""))
        panel: Panel = {
            "title": f"{channel}, as recorded",
            "short": f"{channel} recorded",
            "unit": unit,
            "curves": [samples.curve(str(channel), time, as_recorded.to_numpy(), colour="ink", width=1)],
            "flags": _flags(recorded.get(f"{name}_quality")),
        }
        if quantity in CHANNEL_UNITS and CHANNEL_UNITS[quantity] != unit:
            line = _line(as_recorded.to_numpy(), from_si(1.0, CHANNEL_UNITS[quantity]) * variable.to_numpy())
            if line is not None:
                panel["second"] = {"unit": CHANNEL_UNITS[quantity], "factor": line[0], "offset": line[1]}
        found.append(panel)
    return found


def _on_common_clock(time: Array, given: dict[str, Any]) -> Array:
    """Take off what `condition` took off a channel's times; its own time where it took off nothing."""
    drift = 1e-6 * float(given.get("clock_rate_ppm", 0.0)) * (time - float(given.get("clock_offset_at", 0.0)))
    return np.asarray(time - float(given.get("clock_offset", 0.0)) - drift)


def _line(recorded: Array, physical: Array) -> tuple[float, float] | None:
    """Give factor and offset from one to the other; None if they are not on a line, as after a correction in part."""
    both = np.isfinite(recorded) & np.isfinite(physical)
    if both.sum() < 2 or np.ptp(recorded[both]) == 0:
        return None
    low, high = np.argmin(recorded[both]), np.argmax(recorded[both])
    (x, from_), (y, to) = ((values[both][low], values[both][high]) for values in (recorded, physical))
    factor = (to - y) / (from_ - x)
    offset = y - factor * x
    wrong = np.abs(physical[both] - offset - factor * recorded[both]).max()
    return (float(factor), float(offset)) if wrong <= PROPORTIONAL * np.abs(physical[both]).max() else None


def _flags(quality: xr.DataArray | None) -> list[list[int]]:
    """First sample, the one after the last, and the flag of each stretch that is not good."""
    if quality is None or not quality.size:
        return []
    flags = quality.to_numpy()
    starts = np.concatenate(([0], np.flatnonzero(np.diff(flags)) + 1, [flags.size]))
    stretches: Sequence[tuple[int, int]] = list(zip(starts[:-1].tolist(), starts[1:].tolist(), strict=True))
    return [[first, last, int(flags[first])] for first, last in stretches if flags[first] != GOOD]


def _has(curve: Curve) -> bool:
    return bool(np.isfinite(curve.values).any())


def _look(model: str) -> dict[str, Any]:
    style = model_style(model)
    dash = style["linestyle"][1] if isinstance(style["linestyle"], tuple) else ()
    return {"colour": style["color"], "dash": list(dash), "width": 1.2 * style["linewidth"]}


def _numbered(index: int) -> dict[str, Any]:
    """Colours of curves that have none of their own, which tell apart for all eyes in light and dark."""
    return {"colour": ("ink", "#c8660d", "#2a7fb8", "#b0428c", "#3a8f5c", "#8a6d1c")[index % 6], "width": 1.2}
