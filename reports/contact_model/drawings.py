"""Figures of the study of the contact model."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from colonnade.figures.style import blank_figure, styled
from contact_model.convergence import step_errors
from contact_model.free import MESHES, TARGET
from contact_model.misfit_words import VISIBLE

MARKERS = "osD^vPX*<"
MESH_COLOUR = "#0a8a5f"
GRID_COLOUR = "#0b6bb0"
SPECIMENS = {"prism": "#1c2430", "cylinder": "#d1490f", "cone": "#8a3fa8"}
GREY = "0.6"


def named(body: str) -> str:
    """Name a body for people."""
    return f"{body} mesh" if body in MESHES else f"rigid, {body} nodes"


def draw_collapse(found: dict[str, Any]) -> Figure:
    """Draw e over ξ_eff, a line a body."""
    with styled():
        figure = blank_figure(3.8)
        axes = figure.subplots()
        runs = found["collapse"]
        for place, body in enumerate(dict.fromkeys(run["body"] for run in runs)):
            series = [run for run in runs if run["body"] == body and run["damping_fraction"] > 0.0]
            mesh = body in MESHES
            axes.semilogx(
                [run["effective_damping"] for run in series],
                [run["restitution"] for run in series],
                color=MESH_COLOUR if mesh else GRID_COLOUR,
                linestyle="-" if mesh else "--",
                marker=MARKERS[place],
                markersize=4,
                markerfacecolor="none",
                label=named(body),
            )
        axes.axhline(TARGET, color=GREY, linewidth=0.8)
        axes.xaxis.set_major_formatter("{x:g}")
        axes.margins(x=0.04)
        axes.set_xlabel("effective damping fraction ξ_eff of the whole body")
        axes.set_ylabel("restitution e")
        figure.legend(loc="outside right", fontsize=7)
    return figure


def draw_convergence(found: dict[str, Any]) -> Figure:
    """Draw errors over step, e over modes, e over nodes."""
    with styled():
        figure = blank_figure(3.5)
        steps, modes, nodes = figure.subplots(1, 3)
        for series in step_errors(found["steps"]):
            colour = MESH_COLOUR if series["body"] in MESHES else GRID_COLOUR
            for what, line in (("peaks", "-"), ("e", "--")):
                steps.loglog(
                    [1e6 * row["step"] for row in series["rows"]],
                    [row[what] for row in series["rows"]],
                    color=colour,
                    linestyle=line,
                    marker="o",
                    markersize=3,
                    label=f"{named(series['body'])}: {'peaks, of α' if what == 'peaks' else 'e'}",
                )
        steps.set_xlabel("step, µs")
        steps.set_ylabel("difference from the shortest step")
        steps.set_xticks((2, 5, 10, 20))
        modes.plot(
            [run["modes"] for run in found["modes"]],
            [run["restitution"] for run in found["modes"]],
            color=MESH_COLOUR,
            marker="o",
            markersize=3,
        )
        modes.set_xlabel("modes of the coarse mesh")
        modes.set_ylabel("restitution e")
        for kind, colour in (("grid", GRID_COLOUR), ("mesh", MESH_COLOUR)):
            runs = [run for run in found["nodes"] if (run["body"] in MESHES) == (kind == "mesh")]
            nodes.semilogx(
                [along(run["body"]) for run in runs],
                [run["restitution"] for run in runs],
                color=colour,
                marker="o",
                markersize=3,
                label="rigid on nodes" if kind == "grid" else "elastic meshes",
            )
        nodes.set_xticks((2, 3, 5, 9, 17, 33))
        nodes.set_xlabel("nodes along the base")
        nodes.set_ylabel("restitution e")
        nodes.legend(fontsize=7)
        for axes in (steps, modes, nodes):
            axes.margins(x=0.05)
        for axis in (steps.xaxis, steps.yaxis, nodes.xaxis):
            axis.set_major_formatter("{x:g}")
            axis.set_minor_formatter(NullFormatter())
        figure.legend(*steps.get_legend_handles_labels(), loc="outside lower center", ncols=2, fontsize=7)
    return figure


def along(body: str) -> int:
    """Nodes along the base, in the direction of rocking."""
    return {"coarse": 6, "medium": 9, "fine": 11}.get(body) or int(body.split(" × ")[0])


def draw_amplitude(found: dict[str, Any]) -> Figure:
    """Draw e over release, friction and disturbance."""
    panels: tuple[tuple[str, str, str, Callable[[float], float]], ...] = (
        ("amplitudes", "release", "release |θ|/α", float),
        ("friction", "friction", "friction µ", float),
        ("disturbance", "disturbance", "rotation about x at first, % of α", lambda share: 100.0 * share),
    )
    with styled():
        figure = blank_figure(2.7)
        for axes, (part, name, label, scaled) in zip(figure.subplots(1, 3, sharey=True), panels, strict=True):
            axes.plot(
                [scaled(run[name]) for run in found[part]],
                [run["restitution"] for run in found[part]],
                color=GRID_COLOUR,
                marker="o",
                markersize=3,
            )
            axes.axhline(TARGET, color=GREY, linewidth=0.8)
            axes.margins(x=0.05)
            axes.set_xlabel(label)
        figure.axes[0].set_ylabel("restitution e")
    return figure


def draw_misfit(found: dict[str, Any]) -> Figure:
    """Draw the misfit of the first cycles after a large release over the disturbance, a panel a kind."""
    release = max(run["release"] for run in found["misfit"])
    runs = [run for run in found["misfit"] if run["release"] == release]
    panels = (
        ("push", "sideways push, % of pα", 100.0),
        ("spin", "spin, % of p", 100.0),
        ("tilt", "table tilted across, % of α", 100.0),
        ("warp", "base warped by, µm", 1e6),
        ("feet", "three low spots, µm", 1e6),
        ("oval", "radius oval by ±, µm", 1e6),
    )
    with styled():
        figure = blank_figure(4.4)
        grid = figure.subplots(2, 3, sharey=True)
        for axes, (kind, label, scale) in zip(grid.ravel(), panels, strict=True):
            for specimen, colour in SPECIMENS.items():
                series = [run for run in runs if (run["specimen"], run["kind"]) == (specimen, kind)]
                axes.semilogx(
                    [scale * run["size"] for run in series],
                    [100.0 * run["misfit"]["nonlinear"] for run in series],
                    color=colour,
                    marker="o",
                    markersize=3,
                    markerfacecolor="none",
                    label=specimen,
                )
            axes.axhline(100.0 * VISIBLE, color=GREY, linewidth=0.8)
            axes.margins(x=0.04)
            axes.set_xlabel(label)
            axes.xaxis.set_major_formatter("{x:g}")
            axes.xaxis.set_minor_formatter(NullFormatter())
        for axes in grid[:, 0]:
            axes.set_ylabel("misfit, % of α")
        grid[0, 0].legend(fontsize=7)
    return figure
