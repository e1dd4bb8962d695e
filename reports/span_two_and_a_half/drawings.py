"""Figures of the study: one member that shows the pattern, and the likelihoods of the causes."""

from __future__ import annotations

from typing import Any

import numpy as np

from colonnade import figures
from colonnade.figures.style import FAINT, MEASURED, blank_figure, model_style, styled
from span_two_and_a_half.counting import causes_of
from span_two_and_a_half.criterion import Response
from span_two_and_a_half.design import (
    BOTH,
    CAUSES,
    EVERY,
    GRADES,
    MODELS,
    ONLY,
    SPANS,
    STRANGE,
    TAIL,
    Cell,
    nominal,
    table_motion,
)
from span_two_and_a_half.members import run_member
from span_two_and_a_half.trial import predict, response, table

COLOURS = dict(zip(GRADES, ("#7fb2d9", "#0b6bb0", "#d1490f", "#8a1f11"), strict=True))
LEAST = 3e-5
"""Left end of the likelihoods: a share that was never seen has only its upper limit."""


def draw_all(found: dict[str, Any]) -> dict[str, str]:
    """Give the figures as SVG, by file name."""
    made = {
        "span-2.5-likelihood.svg": figures.to_svg(
            draw_likelihoods(found["rows"], found["space"]),
            identity="span-2.5-likelihood",
            title="How often each cause makes the pattern",
            description="Likelihood of the pattern by cause and size, with 95 % intervals.",
        )
    }
    if found["example"] is not None:
        made["span-2.5-example.svg"] = figures.to_svg(
            draw_example(found["example"]),
            identity="span-2.5-example",
            title="A virtual test in which the prediction misbehaves in that way",
            description="Measured and predicted rocking at Spans 2.0, 2.5 and 3.0 of one member.",
        )
    return made


def example_responses(example: dict[str, Any]) -> dict[float, tuple[Response, dict[str, Response]]]:
    """Run the member of the example again: measured and predicted at each Span."""
    cell, shape = Cell(example["cause"], example["grade"]), table_motion()
    found = {}
    for span in SPANS:
        motion = table(shape, example["intensity"], span)
        runs = {model: response(history, motion.dt) for model, history in predict(motion).items()}
        if example["scope"] == ONLY and span != STRANGE:
            found[span] = runs["nonlinear"], runs
        else:
            found[span] = run_member(cell, example["number"], span, motion, runs)
    return found


def draw_example(example: dict[str, Any]) -> Any:
    """Draw θ/α over time at the three Spans: measured, and both predictions."""
    responses = example_responses(example)
    alpha = nominal()[0].critical_angle
    with styled():
        figure = blank_figure(5.2)
        panels = figure.subplots(len(SPANS), 1, sharex=True, sharey=True)
        for axes, (span, (measured, predictions)) in zip(panels, responses.items(), strict=True):
            time = np.arange(measured.angle.size) * measured.dt
            axes.plot(time, np.clip(measured.angle / alpha, -1, 1), label="measured (virtual)", **MEASURED)
            for model in MODELS:
                angle = np.clip(predictions[model].angle / alpha, -1, 1)
                axes.plot(time, angle, label=f"{model} prediction", **model_style(model))
            axes.set_title(f"Span {span:.1f}", loc="left", fontsize=8)
            axes.set_ylabel("θ / α")
        panels[-1].set_xlabel("time on the record's clock, s")
        panels[-1].set_xlim(0.0, time[-1] - TAIL + 1.0)
        panels[0].legend(fontsize=7, loc="upper right", ncols=3, frameon=False)
    return figure


def draw_likelihoods(rows: list[dict[str, Any]], space: list[dict[str, Any]]) -> Any:
    """Draw the likelihood of each cause at each size, for both predictions and for the nonlinear one."""
    shown = [row for row in rows if row["scope"] == EVERY] + space
    names = causes_of(shown)
    with styled():
        figure = blank_figure(7.4)
        panels = figure.subplots(1, 2, sharey=True, sharex=True)
        for axes, view, title in zip(
            panels, (BOTH, "nonlinear"), ("both predictions", "nonlinear prediction"), strict=True
        ):
            for row in shown:
                grade = GRADES.index(row["grade"]) if row["grade"] else 1
                place = names.index(row["cause"]) + 0.18 * (grade - 1.5)
                share, low, high = row[view]["likelihood"]
                colour = COLOURS[row["grade"]] if row["grade"] else "0.25"
                axes.plot([max(low, LEAST), high], [place, place], color=colour, linewidth=1.2, solid_capstyle="butt")
                if share > 0:
                    axes.plot(share, place, "o", color=colour, markersize=3.5)
                else:
                    axes.plot(high, place, "|", color=colour, markersize=5)
                back = row[view]["reverse_likelihood"][0]
                if back > LEAST:
                    axes.plot(back, place, "o", markerfacecolor="none", markeredgecolor=colour, markersize=3.5)
            axes.set_xscale("log")
            axes.set_xlim(LEAST, 1.0)
            axes.set_xticks([1e-4, 1e-3, 1e-2, 1e-1, 1.0], ["0.01 %", "0.1 %", "1 %", "10 %", "100 %"])
            axes.minorticks_off()
            axes.set_title(title, fontsize=8)
            axes.set_xlabel("share of the members")
            axes.axhline(len(CAUSES) - 0.5, color=FAINT, linewidth=0.6)
        panels[0].set_yticks(range(len(names)), names)
        panels[0].set_ylim(len(names) - 0.4, -0.6)
        for grade, colour in COLOURS.items():
            panels[1].plot([], [], "o-", color=colour, markersize=3.5, label=grade)
        panels[1].plot([], [], "o", markerfacecolor="none", markeredgecolor="0.4", markersize=3.5, label="reverse")
        figure.legend(*panels[1].get_legend_handles_labels(), fontsize=7, loc="outside upper right", ncols=5)
    return figure
