"""Results of the library as pictures: `plot` for each kind of result, `animate` for a rocking history."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib import pyplot
from matplotlib.animation import FuncAnimation
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from colonnade.assessment.fragility import Fragility
from colonnade.assessment.measures import measure_of
from colonnade.dynamics.contact.history import AssemblyHistory
from colonnade.dynamics.ensemble import Ensemble
from colonnade.dynamics.history import History
from colonnade.dynamics.maps import StabilityMap
from colonnade.dynamics.pulses import OverturningSpectrum
from colonnade.dynamics.spectra import RockingSpectrum
from colonnade.figures import fragility
from colonnade.figures.drawing.view import Rocking
from colonnade.figures.files.output import Movie
from colonnade.figures.histories import Spread, draw_angle, limit_of, shade
from colonnade.figures.maps.stability_map import draw_map, draw_overturning, draw_rocking
from colonnade.figures.moving import SIZE, moving_bodies, rocking_block
from colonnade.figures.panels.curve import Curve, draw_curve
from colonnade.figures.restitution.decay import EstimateRow, ImpactSeries, draw_impacts
from colonnade.figures.style import MEASURED, model_style, styled
from colonnade.identification.restitution.result import Restitution
from colonnade.validation import described, instance

KINDS = "a History, an AssemblyHistory, a Restitution, a StabilityMap, an Ensemble, a spectrum or a Fragility"

FINE = 200
"""Points of a fragility curve."""


def plot(result: Any, ax: Axes | None = None) -> Axes:
    """
    Draw a result.

    Parameters
    ----------
    result : History, AssemblyHistory, Restitution, StabilityMap, Ensemble, a spectrum or Fragility
        A history is drawn as θ/α over time, one of an assembly joint by joint; a restitution as e of each impact over
        the angular velocity before it, with the value identified; a map and an overturning spectrum with their limits
        over Ω and A; an ensemble as its bands over time; a rocking spectrum as largest angles over the size of blocks;
        a fragility as its curves.
    ax : matplotlib.axes.Axes, optional
        To draw into, as of several results one over the other; by default those of a new figure.

    Returns
    -------
    ax : matplotlib.axes.Axes

    Raises
    ------
    ValueError
        If the result is of another kind, or `ax` are no axes.

    Examples
    --------
    >>> from colonnade.dynamics.block import Block
    >>> from colonnade.dynamics.rock import rock
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> axes = plot(rock(block, theta0=0.09, restitution=0.95, duration=5.0))
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('time (s)', 'θ / α')
    """
    draw = DRAWN.get(type(result))
    if draw is None:
        raise ValueError(f"result is {described(result)}; {KINDS} was expected")
    if ax is None:
        # A figure of pyplot is shown by a notebook, and by pyplot.show() in a script.
        ax = pyplot.subplots(layout="constrained")[1]
    instance("ax", ax, Axes)
    with styled():
        draw(ax, result)
    ax.legend()
    return ax


def _draw_history(axes: Axes, result: History) -> None:
    drawn = Curve(result.time, result.angle / result.block.critical_angle_at(result.angle))
    reach = axes.get_ylim()[1] if axes.lines else 0.0  # of a history that is there already
    draw_angle(axes, {result.model: drawn}, max(limit_of([drawn]), reach))
    axes.set_xlabel("time (s)")


def _draw_joints(axes: Axes, result: AssemblyHistory) -> None:
    for name, body in result.bodies.items():
        axes.plot(result.time, body.relative.angle / result.assembly.critical_angles[name], label=name)
    axes.set(xlabel="time (s)", ylabel="rocking angle at the joint / α")


def _draw_restitution(axes: Axes, result: Restitution) -> None:
    impacts = result.impacts
    series = ImpactSeries(
        "impacts", impacts.velocity, impacts.restitution, impacts.restitution_standard_error, impacts.used
    )
    value, low, high = (np.nan if each is None else each for each in (result.value, result.low, result.high))
    draw_impacts([axes], [series], level=EstimateRow("e identified", value, low, high))


def _draw_ensemble(axes: Axes, result: Ensemble) -> None:
    spread = Spread(result.time, result.levels, result.bands, 0.0, np.inf)
    shade(axes, spread, result.levels.size // 2, model_style("nonlinear")["color"])
    draw_curve(axes, Curve(result.time, result.central), label="nothing varied", **MEASURED)
    axes.set(xlabel="time (s)", ylabel="θ (rad)")


def _draw_fragility(axes: Axes, result: Fragility) -> None:
    fitted, rising = result.lognormal, result.isotonic
    fine = np.geomspace(rising.intensity[0], rising.intensity[-1], FINE)
    curve = None if fitted.reason else fragility.Curve(fine, *fitted.probability(fine))
    measure = measure_of(result.measure)
    steps = fragility.Curve(rising.intensity, *rising.probability)
    fragility.draw_fragility(axes, curve, steps, label=f"{measure.symbol} ({measure.unit})", taken=result.taken)


DRAWN: dict[type, Callable[[Axes, Any], None]] = {
    History: _draw_history,
    AssemblyHistory: _draw_joints,
    Restitution: _draw_restitution,
    StabilityMap: draw_map,
    Ensemble: _draw_ensemble,
    OverturningSpectrum: draw_overturning,
    RockingSpectrum: draw_rocking,
    Fragility: _draw_fragility,
}


def animate(history: History) -> FuncAnimation:
    """
    Let a block rock as a history says.

    Parameters
    ----------
    history : History or AssemblyHistory
        Its block is drawn from pole to pole, twice as high as its centre of mass: that is a prism.

    Returns
    -------
    animation : matplotlib.animation.FuncAnimation
        `pyplot.show()` plays it in a script, `IPython.display.HTML(animation.to_jshtml())` in a notebook, and
        `animation.save("rocking.gif", writer="pillow")` writes it. It has at most 250 frames: a long history is shown
        faster.

    Raises
    ------
    ValueError
        If it is not a history.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from colonnade.dynamics.block import Block
    >>> from colonnade.dynamics.rock import rock
    >>> block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
    >>> movie = animate(rock(block, theta0=0.09, restitution=0.95, duration=0.3))
    >>> with TemporaryDirectory() as folder:
    ...     movie.save(Path(folder, "rocking.gif"), writer="pillow")
    ...     Path(folder, "rocking.gif").read_bytes()[:3]
    b'GIF'
    """
    if isinstance(history, AssemblyHistory):
        return _animation(moving_bodies(history.outlines(), history.time, pyplot.figure(figsize=SIZE)))
    instance("history", history, History)
    rocking, curve = Rocking.of(history.block), Curve(history.time, history.angle)
    (left, right), height = rocking.poles, 2 * rocking.centre[1]
    corners = [(left, 0.0), (right, 0.0), (right, height), (left, height)]
    # A figure of pyplot: `pyplot.show()` plays it in a script.
    figure = pyplot.figure(figsize=SIZE)
    return _animation(rocking_block({history.model: curve}, corners, rocking.poles, figure=figure))


def _animation(movie: Movie) -> FuncAnimation:
    def show(frame: int) -> list[Artist]:
        movie.show(frame)
        return movie.figure.axes[0].get_children()

    return FuncAnimation(movie.figure, show, frames=movie.frames, interval=1000 / movie.rate)
