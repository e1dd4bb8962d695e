"""What is drawn of a specimen, and one view of it, to scale."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import cos
from typing import Any, Literal, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.patches import Polygon

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.figures.style import INK, SOFT, shortened

Point = tuple[float, float, float]
"""x, y, z in m from the centre of the base, or a direction."""

Spot = tuple[float, float]
"""A place on the paper, m across and up from the centre of the base, or a direction."""


class Body(NamedTuple):
    """
    A specimen.

    Attributes
    ----------
    base : {"rectangle", "circle"}
    width, depth : (float, float)
        Along x and y, of the base and of the top, m; of a round body its diameters.
    height : float
        m.
    is_known : bool
        Whether this is its outline, and not one that stands in for it.
    rocking : Rocking or None
        None if it is not known.
    words : sequence of str
        What is written beside it.
    parts : mapping of str to (Body, Point)
        Its bodies and where the middle of the base of each is, if it has several.
    """

    base: Literal["rectangle", "circle"]
    width: tuple[float, float]
    depth: tuple[float, float]
    height: float
    is_known: bool
    rocking: Rocking | None
    words: Sequence[str] = ()
    parts: Mapping[str, tuple[Body, Point]] = {}

    def outline(self, axis: int = 0) -> list[Spot]:
        """Return its corners as seen with x (0) or y (1) to the right, from the left end of its base."""
        base, top = (size / 2 for size in (self.width, self.depth)[axis])
        return [(-base, 0.0), (base, 0.0), (top, self.height), (-top, self.height)]


class Rocking(NamedTuple):
    """Where it rocks: x of the poles for θ < 0 and θ > 0, and the centre of mass (x, z), m; α of both sides, rad."""

    poles: tuple[float, float]
    centre: tuple[float, float]
    critical_angles: tuple[float, float]

    @classmethod
    def of(cls, block: Block) -> Rocking:
        """Lay a block out about the middle between its poles."""
        left, right = block.negative.half_width, block.positive.half_width
        height = sum(side.pole_distance * cos(side.critical_angle) for side in block.sides) / 2
        angles = (block.negative.critical_angle, block.positive.critical_angle)
        return cls((-(left + right) / 2, (left + right) / 2), ((left - right) / 2, height), angles)


NAMES = ("x", "y", "z")
MOST = 2
"""Numbers of transducers behind each other that are written."""
THIN, LINE = 0.6, 1.0
FINE, SMALL, NORMAL = 6.5, 7.0, 7.5
"""Sizes of text, points."""

CHARACTER = 0.057
"""Width of a letter of normal size, inches."""


class Label(NamedTuple):
    """What a transducer is called in a margin: where it is, its name, a detail and its colour."""

    spot: Spot
    name: str
    detail: str
    colour: str


def along(start: Spot, direction: Spot, length: float) -> Spot:
    """Return the spot so many lengths of a direction from another."""
    return start[0] + length * direction[0], start[1] + length * direction[1]


@dataclass
class View:
    """
    A view.

    Attributes
    ----------
    axes : Axes
        Its limits are metres, equal in both directions.
    across, up : int
        Number of the axis that points to the right, and up.
    towards : int
        1 if the third axis points to the viewer, −1 if away.
    inch : float
        m on an inch of paper.
    labels : list of Label
        That `write_labels` writes.
    """

    axes: Axes
    across: int
    up: int
    towards: int
    inch: float
    labels: list[Label] = field(default_factory=list)

    @classmethod
    def within(
        cls,
        parent: FigureBase,
        box: tuple[float, float, float, float],
        size: tuple[float, float],
        orientation: tuple[int, int, int],
        inch: float,
        base: Spot,
    ) -> View:
        """
        Place a view in a box (left, bottom, width, height) of a figure of this size, inches.

        `orientation` is `across`, `up`, `towards`; `base` is where the centre of the specimen's base is in the box.
        """
        left, bottom, width, height = box
        axes = parent.add_axes((left / size[0], bottom / size[1], width / size[0], height / size[1]))
        axes.set_axis_off()
        axes.set(xlim=(-base[0] * inch, (width - base[0]) * inch), ylim=(-base[1] * inch, (height - base[1]) * inch))
        return cls(axes, *orientation, inch)

    def spot(self, point: Point) -> Spot:
        """Project a point."""
        return point[self.across], point[self.up]

    def depth(self, direction: Point) -> float:
        """Return the part of a direction towards the viewer."""
        return self.towards * direction[3 - self.across - self.up]

    def shape(self, corners: Sequence[Spot], **look: Any) -> None:
        """Draw a closed outline."""
        self.axes.add_patch(Polygon(corners, **{"edgecolor": INK, "linewidth": LINE, **look}))

    def line(self, *spots: Spot, **look: Any) -> None:
        """Draw a line through spots."""
        look = {"color": SOFT, "linewidth": THIN, "solid_capstyle": "butt", **look}
        self.axes.plot(*zip(*spots, strict=True), **look)

    def arrow(self, start: Spot, end: Spot, colour: str, **look: Any) -> None:
        """Draw an arrow."""
        usual = {"arrowstyle": "-|>", "mutation_scale": 9.0, "linewidth": 1.3, "shrinkA": 0.0, "shrinkB": 0.0}
        look = {**usual, "color": colour, **look}
        self.axes.annotate("", end, start, arrowprops=look, annotation_clip=False, zorder=6)

    def text(self, spot: Spot, text: str, **look: Any) -> None:
        """Write."""
        self.axes.text(*spot, text, **{"fontsize": SMALL, "color": INK, "ha": "center", "va": "center", **look})

    def mark(self, spot: Spot, mark: str, size: float, colour: str, **look: Any) -> None:
        """Draw a mark."""
        self.axes.plot(*spot, mark, markersize=size, color=colour, **look)

    def through(self, spot: Spot, colour: str, *, towards: bool) -> None:
        """Mark a direction at right angles to the paper: a dot towards the viewer, a cross away from him."""
        self.mark(spot, "o", 8.0, colour, markerfacecolor="white", zorder=6)
        self.mark(spot, "." if towards else "x", 4.5, colour, markeredgewidth=1.1, zorder=7)

    def dimension(self, start: Spot, end: Spot, text: str, *, beside: Spot) -> None:
        """Give the distance between two spots; the text stands `beside` (inches) the middle of the line."""
        self.arrow(start, end, SOFT, arrowstyle="<|-|>", mutation_scale=7.0, linewidth=THIN)
        middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
        upright = abs(end[1] - start[1]) > abs(end[0] - start[0])
        self.text(along(middle, beside, self.inch), text, rotation=90 if upright else 0)

    def write_labels(self, margin: float) -> None:
        """Write the labels as near to their heights as they find room, in margins of a width (inches), with leaders."""
        left, right = self.axes.get_xlim()
        low, high = self.axes.get_ylim()
        for sign, end in ((-1, left), (1, right)):
            labels = _together([each for each in self.labels if (each.spot[0] < 0) == (sign < 0)])
            edge = sign * end - margin * self.inch
            inner = sign * max([edge, *(sign * each.spot[0] + 0.04 * self.inch for each in labels)])
            row = min((0.3 if margin > 0.5 else 0.16) * self.inch, (high - low) / max(len(labels), 1))
            heights = _spaced([each.spot[1] for each in labels], row, low + row / 2, high - row / 2)
            most = max(int(abs(end - inner) / self.inch / CHARACTER), 3)
            look = {"ha": "left" if sign > 0 else "right"}
            for label, height in zip(labels, heights.tolist(), strict=True):
                self.line((inner, height), label.spot, color=label.colour, linewidth=0.4, zorder=2)
                place = (inner + sign * 0.03 * self.inch, height)
                name = shortened(label.name, most) if label.detail else label.name
                if label.detail and row > 0.22 * self.inch:
                    self.text(place, name, va="bottom", color=label.colour, fontsize=NORMAL, **look)
                    self.text(place, label.detail, va="top", color=SOFT, fontsize=FINE, **look)
                else:
                    self.text(place, name, color=label.colour, fontsize=NORMAL, **look)


def _together(labels: Sequence[Label]) -> list[Label]:
    """Return labels by rising height, those without detail at one spot as one: transducers behind each other."""
    found: dict[Spot, list[Label]] = {}
    for label in labels:
        if not label.detail:
            found.setdefault(label.spot, []).append(label)
    whole = [label for label in labels if label.detail]
    for own in found.values():
        name = f"{own[0].name} …" if len(own) > MOST else ", ".join(each.name for each in own)
        whole.append(own[-1]._replace(name=name))
    return sorted(whole, key=lambda each: each.spot[1])


def _spaced(wanted: Sequence[float], least: float, low: float, high: float) -> Array:
    """
    Move rising places apart, as little as that takes, so that they are at least `least` apart and within the limits.

    Examples
    --------
    >>> _spaced([1.0, 1.2, 5.0], 1.0, 0.0, 5.5)
    array([1., 2., 5.])
    >>> _spaced([5.0, 5.2], 1.0, 0.0, 5.5)
    array([4.5, 5.5])
    """
    steps = least * np.arange(len(wanted))
    rising = np.maximum.accumulate(np.maximum(wanted, low) - steps) + steps
    return np.asarray(np.minimum(rising, high - steps[::-1]))
