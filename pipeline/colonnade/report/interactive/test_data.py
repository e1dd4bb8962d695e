"""The data of a test's page: the panels of its figures, channels conditioned and recorded, the moving block."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any

import numpy as np
import xarray as xr

from colonnade.arrays import Array
from colonnade.figures.channels import line_between
from colonnade.figures.files.output import Picture
from colonnade.figures.histories import Panel
from colonnade.figures.stored import bodies
from colonnade.figures.stored.record import BASE, MOTIONS, SHADED, misfit, quantities
from colonnade.figures.stored.subject import OfTest
from colonnade.figures.style import model_style, name_of
from colonnade.report.interactive import panels
from colonnade.report.interactive.panels import Samples, look_of, script, tables_of
from colonnade.report.test_page.channels import FLAGS
from colonnade.store.records.stored import GOOD
from colonnade.units import CHANNEL_UNITS, from_si
from colonnade.units.text import format_percent

TOO_MANY = "Too many samples for a page; they are in the stored results of this test."
"""Said of a group of panels that is left out."""

Described = dict[str, Any]
"""A panel as the script of a page reads it."""


def of_test(one: OfTest, pictures: Iterable[Picture]) -> str:
    """Return the script with the data of a test's page, on which these pictures are."""
    samples = Samples()
    groups: list[tuple[str, bool, Callable[[OfTest, Samples], list[Described]]]] = [
        ("Response", True, _response),
        ("Table motion", False, _base),
        ("Channels, conditioned", False, _conditioned),
        ("Channels, as recorded", False, _recorded),
    ]
    shown: list[dict[str, Any]] = []
    for title, is_open, panels_of in groups:
        found = samples.with_more(partial(panels_of, one))
        if found is None or found:
            note = TOO_MANY if found is None else ""
            shown.append({"title": title, "is_open": is_open, "panels": found or [], "note": note})
    drawn = [group for group in shown if group["panels"]]
    if drawn:
        drawn[0]["is_open"] = True
    moves = None
    if any(panel.get("is_angle") for group in drawn for panel in group["panels"]):
        moves = samples.with_more(partial(panels.of_test, one))
    critical = [one.block.negative.critical_angle, one.block.positive.critical_angle]
    shown, tables = shown if drawn else [], tables_of(pictures, samples)
    return script(one.test.id, samples, groups=shown, critical=critical, moving=moves, tables=tables)


def _described(panel: Panel, samples: Samples) -> Described:
    curves = [
        samples.curve(name_of(who) or "measured", *curve, **look_of(who), width=1.2)
        for who, curve in panel.curves.items()
    ]
    level = {"level": panel.level, "level_name": panel.level_name}
    return {"title": panel.title, "unit": panel.unit, "curves": curves, **level}


def _response(one: OfTest, samples: Samples) -> list[Described]:
    ratios = one.ratios()
    angle = [_angle(one, Panel("Rocking angle θ/α", "", "", ratios, 1.0, "α"), samples)] if ratios else []
    others = (*bodies.panels(one), *misfit(one), *quantities(one, MOTIONS))
    return angle + [_described(panel, samples) for panel in others if panel.curves]


def _angle(one: OfTest, panel: Panel, samples: Samples) -> Described:
    """Describe the panel of the rocking angle with the bands of each model, and its horizon."""
    bands, marks, found = [], [], one.spreads()
    for model, spread in found.items():
        clock, is_open = samples.clock(spread.time), model == SHADED or len(found) == 1
        bands += [
            {
                "name": f"{model} model, {format_percent(spread.share(index))} of runs",
                "clock": clock,
                "low": samples.add(spread.bands[index]),
                "high": samples.add(spread.bands[-1 - index]),
                "is_hidden": not (is_open and index == 0),
                **look_of(model),
            }
            for index in range(spread.levels.size // 2)
        ]
        if spread.horizon < spread.time[-1]:
            text = f"horizon, {model} model"
            marks.append({"name": text, "time": spread.horizon, "colour": model_style(model)["color"]})
    return _described(panel, samples) | {"bands": bands, "marks": marks, "is_angle": True}


def _base(one: OfTest, samples: Samples) -> list[Described]:
    return [_described(panel, samples) for panel in quantities(one, BASE)]


def _conditioned(one: OfTest, samples: Samples) -> list[Described]:
    """One panel a quantity, with all channels that measure it."""
    conditioned = one.stored.datasets.get(("condition", None), xr.Dataset())
    found: dict[str, Described] = {}
    for variable in conditioned.data_vars.values():
        channel, quantity = variable.attrs.get("channel"), str(variable.attrs.get("quantity"))
        if channel is not None and quantity in CHANNEL_UNITS:
            unit, title = CHANNEL_UNITS[quantity], f"{quantity.replace('_', ' ').capitalize()}, conditioned"
            curves = found.setdefault(quantity, {"title": title, "unit": unit, "curves": []})["curves"]
            values = from_si(1.0, unit) * variable.to_numpy()
            look = {"colour": COLOURS[len(curves) % len(COLOURS)], "width": 1.2}
            curves.append(samples.curve(str(channel), conditioned["elapsed"].to_numpy(), values, **look))
    return list(found.values())


def _recorded(one: OfTest, samples: Samples) -> list[Described]:
    """One panel a channel, in the unit of the file with SI at the right, on the common clock where that is known."""
    recorded, conditioned = (one.stored.datasets.get((stage, None), xr.Dataset()) for stage in ("ingest", "condition"))
    found = []
    for name, variable in recorded.data_vars.items():
        channel = variable.attrs.get("channel")
        if channel is None or f"{name}_recorded" not in recorded:
            continue
        values = recorded[f"{name}_recorded"].to_numpy()
        offset = conditioned[name].attrs if name in conditioned else {}
        time = _on_common_clock(recorded[str(variable.dims[0])].to_numpy(), offset)
        if not (time.size and np.isfinite(time).all()):
            continue
        given = str(variable.attrs.get("recorded_unit", ""))
        panel: Described = {
            "title": f"{channel}, as recorded",
            "unit": given,
            "curves": [samples.curve(str(channel), time, values, colour="ink", width=1)],
            "flags": _flags(recorded.get(f"{name}_quality")),
        }
        unit = CHANNEL_UNITS.get(str(variable.attrs.get("quantity"))) or given
        line = None if unit == given else line_between(values, from_si(1.0, unit) * variable.to_numpy())
        if line is not None:
            panel["second"] = {"unit": unit, "factor": line[0], "offset": line[1]}
        found.append(panel)
    return found


def _on_common_clock(time: Array, given: dict[str, Any]) -> Array:
    """Take off what `condition` took off a channel's times; its own time where it took off nothing."""
    drift = 1e-6 * float(given.get("clock_rate_ppm", 0.0)) * (time - float(given.get("clock_offset_at", 0.0)))
    return np.asarray(time - float(given.get("clock_offset", 0.0)) - drift)


def _flags(quality: xr.DataArray | None) -> list[tuple[int, int, str]]:
    """First sample, the one after the last, and the flag of each stretch that is not good."""
    if quality is None or not quality.size:
        return []
    flags = quality.to_numpy()
    starts = np.concatenate(([0], np.flatnonzero(np.diff(flags)) + 1, [flags.size]))
    stretches: Sequence[tuple[int, int]] = list(zip(starts[:-1].tolist(), starts[1:].tolist(), strict=True))
    return [(first, last, FLAGS[flags[first]]) for first, last in stretches if flags[first] != GOOD]


COLOURS = ("ink", "#c8660d", "#2a7fb8", "#b0428c", "#3a8f5c", "#8a6d1c")
"""Of channels beside each other, which tell apart for all eyes in light and dark."""
