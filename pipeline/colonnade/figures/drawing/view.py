"""What is drawn of a specimen and its transducers, and one view of it, to scale."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import cos
from typing import Literal, NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import FigureBase
from matplotlib.patches import Polygon

from colonnade.dynamics.block import Block
from colonnade.figures.style import INK, SOFT

Point = tuple[float, float, float]
"""x, y, z in m from the centre of the base, or a direction."""


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


MARKER = "marker"
"""Quantity of a point that is followed along three axes."""


class Transducer(NamedTuple):
    """
    A channel, as it is fixed and reads.

    Attributes
    ----------
    name, quantity : str
    on : str
        "specimen", "table" or "ground".
    direction : Point or None
        Of a positive reading; of an angle its axis. None if it is not known, or of a marker.
    at : Point or None
        None if it is not known.
    relative_to : str
        "table" or "ground", empty if it is absolute or not known.
    normal, anchor : Point or None
        Of the face that a laser looks at; the fixed end of a wire.
    is_laser : bool
    """

    name: str
    quantity: str
    on: str
    direction: Point | None
    at: Point | None = None
    relative_to: str = ""
    normal: Point | None = None
    anchor: Point | None = None
    is_laser: bool = False

    @property
    def is_turn(self) -> bool:
        """Whether it reads a rotation about its direction."""
        return self.quantity in ("angle", "angular_velocity")


NAMES = ("x", "y", "z")
MOST = 2
"""Numbers of transducers behind each other that are written."""
THIN, LINE = 0.6, 1.0
FINE, SMALL, NORMAL = 6.5, 7.0, 7.5
"""Sizes of text, points."""

CHARACTER = 0.057
"""Width of a letter of normal size, inches."""

Spot = tuple[float, float]
"""A place on the paper, m across and up from the centre of the base."""


Label = tuple[Spot, str, str, str]
"""What it points to, name, detail and colour."""


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
        Place a view in a figure.

        Parameters
        ----------
        parent : FigureBase
        box : (float, float, float, float)
            Left, bottom, width and height of the view, inches.
        size : (float, float)
            Of the figure, inches.
        orientation : (int, int, int)
            `across`, `up`, `towards`.
        inch : float
            m.
        base : (float, float)
            Where the centre of the specimen's base is in the box, inches.
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

    def shape(self, corners: Sequence[Spot], **look: object) -> None:
        """Draw a closed outline."""
        self.axes.add_patch(Polygon(list(corners), **{"edgecolor": INK, "linewidth": LINE, **look}))  # type: ignore[arg-type]

    def line(self, start: Spot, end: Spot, **look: object) -> None:
        """Draw a line."""
        style = {"color": SOFT, "linewidth": THIN, "solid_capstyle": "butt", **look}
        self.axes.plot([start[0], end[0]], [start[1], end[1]], **style)  # type: ignore[arg-type]

    def arrow(self, start: Spot, end: Spot, colour: str, *, both: bool = False, bend: float = 0.0) -> None:
        """Draw an arrow, with two heads or bent if asked."""
        self.axes.annotate(
            "",
            end,
            start,
            arrowprops={
                "arrowstyle": "<|-|>" if both else "-|>",
                "mutation_scale": 7.0 if both else 9.0,
                "color": colour,
                "linewidth": THIN if both else 1.3,
                "shrinkA": 0.0,
                "shrinkB": 0.0,
                "connectionstyle": f"arc3,rad={bend}",
            },
            annotation_clip=False,
            zorder=6,
        )

    def text(self, spot: Spot, text: str, **look: object) -> None:
        """Write."""
        self.axes.text(*spot, text, **{"fontsize": SMALL, "color": INK, "ha": "center", "va": "center", **look})  # type: ignore[arg-type]

    def through(self, spot: Spot, colour: str, *, towards: bool) -> None:
        """Mark a direction at right angles to the paper: a dot towards the viewer, a cross away from him."""
        self.axes.plot(*spot, "o", markersize=8.0, markerfacecolor="white", markeredgecolor=colour, zorder=6)
        self.axes.plot(*spot, "." if towards else "x", markersize=4.5, color=colour, markeredgewidth=1.1, zorder=7)

    def dimension(self, start: Spot, end: Spot, text: str, *, beside: Spot) -> None:
        """Give the distance between two spots; the text stands `beside` (inches) the middle of the line."""
        self.arrow(start, end, SOFT, both=True)
        middle = ((start[0] + end[0]) / 2 + beside[0] * self.inch, (start[1] + end[1]) / 2 + beside[1] * self.inch)
        upright = abs(end[1] - start[1]) > abs(end[0] - start[0])
        self.text(middle, text, rotation=90 if upright else 0)

    def label(self, spot: Spot, name: str, detail: str, colour: str) -> None:
        """Ask for a label in the margin; `write_labels` writes all of them."""
        self.labels.append((spot, name, detail, colour))

    def write_labels(self, margin: float) -> None:
        """Write the labels as near to their heights as they find room, in margins of a width (inches), with leaders."""
        left, right = self.axes.get_xlim()
        low, high = self.axes.get_ylim()
        for sign, edge in ((-1, left + margin * self.inch), (1, right - margin * self.inch)):
            wanted = sorted(_together([each for each in self.labels if (each[0][0] < 0) == (sign < 0)]), key=_height)
            tips = [sign * each[0][0] + 0.04 * self.inch for each in wanted]
            inner = sign * max([sign * edge, *tips])
            width = abs((right if sign > 0 else left) - inner) / self.inch
            row = min((0.3 if margin > 0.5 else 0.16) * self.inch, (high - low) / max(len(wanted), 1))
            heights = _spaced([*map(_height, wanted)], row, low + row / 2, high - row / 2)
            for label, height in zip(wanted, heights, strict=True):
                self.line((inner, height), label[0], color=label[3], linewidth=0.4, zorder=2)
                self._write_label(label, (inner + sign * 0.03 * self.inch, height), sign, width, row)

    def _write_label(self, label: Label, spot: Spot, sign: int, width: float, row: float) -> None:
        """Write a label in the room that there is: `width` in inches, `row` in m."""
        _, name, detail, colour = label
        most = max(int(width / CHARACTER), 3)
        name = name if len(name) <= most or not detail else f"{name[: most - 1]}…"
        side = "left" if sign > 0 else "right"
        if detail and row > 0.22 * self.inch:
            self.text(spot, name, ha=side, va="bottom", color=colour, fontsize=NORMAL)
            self.text(spot, detail, ha=side, va="top", color=SOFT, fontsize=FINE)
        else:
            self.text(spot, name, ha=side, color=colour, fontsize=NORMAL)


def _height(label: Label) -> float:
    return label[0][1]


def _together(labels: Sequence[Label]) -> list[Label]:
    """Write those without detail that are at one spot as one: the numbers of transducers behind each other."""
    found: dict[Spot, list[Label]] = {}
    for label in labels:
        if not label[2]:
            found.setdefault(label[0], []).append(label)
    many = [
        (spot, f"{own[0][1]} …" if len(own) > MOST else ", ".join(each[1] for each in own), "", own[-1][3])
        for spot, own in found.items()
    ]
    return [*(label for label in labels if label[2]), *many]


def _spaced(wanted: Sequence[float], least: float, low: float, high: float) -> list[float]:
    """
    Move rising places apart, as little as that takes, so that they are at least `least` apart and within the limits.

    Examples
    --------
    >>> _spaced([1.0, 1.2, 5.0], 1.0, 0.0, 5.5)
    [1.0, 2.0, 5.0]
    >>> _spaced([5.0, 5.2], 1.0, 0.0, 5.5)
    [4.5, 5.5]
    """
    placed: list[float] = []
    for each in wanted:
        placed.append(max(each, low, placed[-1] + least if placed else low))
    for index in range(len(placed) - 1, -1, -1):
        limit = high if index == len(placed) - 1 else placed[index + 1] - least
        placed[index] = min(placed[index], limit)
    return placed
