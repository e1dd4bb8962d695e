"""Orders and amplitudes of steady responses over frequency and amplitude; pictures of all kinds of maps."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.history import NO_ROCKING_RATIO
from colonnade.dynamics.maps import AT_REST, IRREGULAR, LARGEST_ORDER, OVERTURNED, StabilityMap, SteadyResponse
from colonnade.figures.files.output import Picture
from colonnade.figures.histories import SMALLEST_RATIO
from colonnade.figures.maps.stability_map import (
    OVERTURNED_COLOUR,
    draw_points,
    measured_map,
    scale_axes,
    stability_map,
    words_of_restitution,
    words_of_sine,
)
from colonnade.figures.panels.layout import caption, legend_outside
from colonnade.figures.style import FAINT, INK, blank_figure, styled
from colonnade.identification.response.boundaries import MapPoint


class Orders(NamedTuple):
    """Orders that share a colour."""

    name: str
    orders: tuple[int, ...]
    colour: str


REGIONS = (
    Orders("at rest", (AT_REST,), "#ffffff"),
    Orders("every cycle", (1,), "#dbe7f1"),
    Orders("sub-harmonic 1/2", (2,), "#5fb59b"),
    Orders("sub-harmonic 1/3", (3,), "#5b93c7"),
    Orders("sub-harmonic 1/4", (4,), "#2c5f8f"),
    Orders(f"sub-harmonic 1/5 … 1/{LARGEST_ORDER}", tuple(range(5, LARGEST_ORDER + 1)), "#8a3fa8"),
    Orders("irregular", (IRREGULAR,), INK),
    Orders("overturned", (OVERTURNED,), OVERTURNED_COLOUR),
)

CURVES = 4
"""Response curves in a panel."""

LEAST_SHARE = 0.15
"""Of an axis: an A (or Ω) at which the block rocks steadily on less of the other axis makes no curve."""

CURVE_COLOURS = ("#0b6bb0", "#0a8a5f", "#c07a00", "#8a3fa8")


@styled()
def response_orders(response: SteadyResponse, points: Sequence[MapPoint], options: Mapping[str, Any]) -> Figure:
    """
    Draw the orders of steady responses over Ω and A, and below them curves of the largest angle over each.

    `points` are measured sine tests; `options` say what the responses depend on: `model`, `settling`, `ramp`, `phase`,
    and e as in the options of a stability map. A response of order k repeats every k cycles of the base. A curve breaks
    where the block overturns and where the order changes; dots mark responses that are sub-harmonic or irregular.
    """
    if min(response.order.shape) < 2:
        raise ValueError(f"orders of {response.order.shape} Ω and A were given; at least two of each were expected")
    figure = blank_figure(6.6)
    grid = figure.add_gridspec(2, 2, height_ratios=(1.7, 1.0))
    axes = figure.add_subplot(grid[0, :])
    patches = _draw_regions(axes, response)
    scale_axes(axes, response.frequency_ratio, response.amplitude_ratio, points)
    draw_points(axes, points, prefix="measured: ")
    settled = f"{options['model']} model; {words_of_restitution(options)}; {words_of_sine(options)}"
    caption(axes, f"{settled}, {options['settling']} cycles to settle")
    legend_outside(figure, [axes], below=True, patches=patches)
    frequencies, amplitudes = response.frequency_ratio, response.amplitude_ratio
    below = figure.add_subplot(grid[1, 0])
    _draw_curves(below, frequencies, response.amplitude.T, response.order.T, amplitudes, "A")
    below.set(xlabel="Ω = ω / p", ylabel="largest |θ| / α")
    beside = figure.add_subplot(grid[1, 1])
    _draw_curves(beside, amplitudes, response.amplitude, response.order, frequencies, "Ω")
    beside.set_xlabel("A = a / (g tan α)")
    return figure


def _draw_regions(axes: Axes, response: SteadyResponse) -> list[Patch]:
    """Draw the cells in the colours of their regions; return a patch for each region there is."""
    colours = {order: region.colour for region in REGIONS for order in region.orders}
    orders = sorted(colours)
    axes.grid(False)
    axes.pcolormesh(
        response.frequency_ratio,
        response.amplitude_ratio,
        response.order.T,
        cmap=ListedColormap([colours[order] for order in orders]),
        norm=BoundaryNorm([*(order - 0.5 for order in orders), orders[-1] + 0.5], len(orders)),
        shading="nearest",
        rasterized=True,
        zorder=0,
        gid=f"order ({AT_REST} at rest, {IRREGULAR} irregular, {OVERTURNED} overturned)",
    )
    present = [region for region in REGIONS if np.isin(response.order, region.orders).any()]
    return [Patch(facecolor=each.colour, edgecolor=FAINT, linewidth=0.5, label=each.name) for each in present]


def _draw_curves(
    axes: Axes, ratios: Array, amplitudes: Array, orders: NDArray[np.int8], others: Array, name: str
) -> None:
    """Draw some rows of `amplitudes`, each at one of the `others`, over `ratios`."""
    chosen = _rows(amplitudes)
    for row, colour in zip(chosen, CURVE_COLOURS, strict=False):
        # Between responses of different orders the curve jumps: no line leads across.
        jumps = np.flatnonzero(orders[row, 1:] != orders[row, :-1]) + 1
        axes.plot(
            np.insert(ratios, jumps, np.nan),
            np.insert(amplitudes[row], jumps, np.nan),
            color=colour,
            linewidth=1.1,
            label=f"{name} = {others[row]:.2f}",
        )
        unlike = (orders[row] > 1) | (orders[row] == IRREGULAR)
        named = f"{name} = {others[row]:.2f}, sub-harmonic or irregular"
        axes.plot(ratios[unlike], amplitudes[row][unlike], ".", color=colour, markersize=4.0, gid=named)
    largest = float(np.nanmax(amplitudes[chosen], initial=SMALLEST_RATIO)) if chosen else SMALLEST_RATIO
    axes.set(ylim=(0.0, 1.3 * largest), xlim=(float(ratios[0]), float(ratios[-1])))
    if chosen:
        axes.legend(loc="upper left", ncols=CURVES // 2, fontsize=7.5, handlelength=1.4, columnspacing=1.0)


def _rows(amplitudes: Array) -> list[int]:
    """Return up to `CURVES` rows, evenly spread over those in which the block rocks steadily often enough."""
    rocking = np.flatnonzero((np.nan_to_num(amplitudes) > NO_ROCKING_RATIO).mean(axis=1) >= LEAST_SHARE)
    if rocking.size == 0:
        return []
    return sorted(set(rocking[np.linspace(0, rocking.size - 1, CURVES).round().astype(np.intp)].tolist()))


def tested(identity: str, points: Sequence[MapPoint]) -> Picture:
    """Draw the sine tests of a specimen by outcome over Ω and A."""
    outcomes = [point.outcome for point in points]
    described = ", ".join(f"{outcomes.count(outcome)} {outcome}" for outcome in dict.fromkeys(outcomes))
    return Picture(
        measured_map(points),
        identity,
        "Sine tests by outcome over frequency ratio Ω and amplitude ratio A",
        f"{len(points)} tests: {described}.",
    )


def computed(specimen: str, charts: Sequence[StabilityMap], points: Sequence[MapPoint]) -> Picture:
    """Draw the stability maps of a specimen, one for each model, with its sine tests."""
    models = [str(chart.options["model"]) for chart in charts]
    return Picture(
        stability_map(charts, points),
        f"map-{specimen}-{'-'.join(models)}",
        f"Stability map of {specimen}, {' and '.join(models)} model",
        f"Outcomes over frequency ratio Ω and amplitude ratio A, with {len(points)} measured points.",
    )


def responses(
    specimen: str, response: SteadyResponse, points: Sequence[MapPoint], options: Mapping[str, Any]
) -> Picture:
    """Draw the steady responses of a specimen by their order, with its measured sine tests."""
    model = str(options["model"])
    return Picture(
        response_orders(response, points, options),
        f"response-{specimen}-{model}",
        f"Steady responses of {specimen}, {model} model",
        f"Orders over frequency ratio Ω and amplitude ratio A, with {len(points)} measured points.",
    )
