"""
What a figure shows, as a table: every line, band, error bar, set of points and field of colours, with all samples.

It is read from the figure itself, so that no figure has a table of its own. A series is named by its label; one that
the legend leaves out, by its group id (`gid`), and without both by its axis alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection, QuadMesh
from matplotlib.container import ErrorbarContainer
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from colonnade.arrays import Array
from colonnade.figures.panels.curve import LongBand

Columns = dict[str, Array | list[str]]
"""By their headings; they need not have one length."""

LOW, HIGH = "low", "high"
"""Endings of the headings of the ends of bars and bands."""


class _Series(NamedTuple):
    """A series of a panel: its name, its columns along both axes by the ending of their headings, and others."""

    name: str
    across: Mapping[str, Array]
    up: Mapping[str, Array]
    others: Mapping[str, Array] = {}

    @property
    def is_single(self) -> bool:
        """Whether it is one point with a name."""
        return bool(self.name) and all(column.size == 1 for column in (*self.across.values(), *self.up.values()))


class _Labels(NamedTuple):
    """Title of a panel and labels of its axes; None of an axis without numbers."""

    title: str
    across: str | None
    up: str | None


def columns_of(figure: Figure) -> Columns:
    """
    Read from a figure what it shows.

    Parameters
    ----------
    figure : Figure

    Returns
    -------
    table : dict of str to ndarray or list of str
        Columns by heading: title of the panel if there are several, label of the axis with its unit, and name of the
        series. Series at the same places share the column of these. Named series of one point each, as the estimates
        of a quantity, are rows with their names in a column.

    Examples
    --------
    >>> figure = Figure()
    >>> axes = figure.subplots()
    >>> _ = axes.plot([0.0, 1.0], [2.0, 3.0], label="measured")
    >>> _ = axes.set_xlabel("time (s)"), axes.set_ylabel("slide (mm)")
    >>> columns_of(figure)
    {'time (s)': array([0., 1.]), 'slide (mm), measured': array([2., 3.])}
    """
    table: Columns = {}
    several = len({_title(axes) for axes in figure.axes}) > 1  # else it tells no panel from another
    title = ""
    for axes in figure.axes:
        title = _title(axes) or title  # one above several panels is of all of them
        labels, found = _labels(axes, title if several else ""), list(_series_of(axes))
        single = [each for each in found if each.is_single]
        if len(single) > 1:
            _add_rows(table, labels, single)
            found = [each for each in found if not each.is_single]
        for each in found:
            _add(table, labels, each)
    return table


def _add(table: Columns, labels: _Labels, series: _Series) -> None:
    if labels.across is not None:
        for ending, values in series.across.items():
            own = _joined(labels.across, "" if series.up else series.name, ending)
            _put(table, values, own, _joined(own, labels.title), _joined(own, labels.title, series.name))
    if labels.up is not None:
        for ending, values in series.up.items():
            _put(table, values, _joined(labels.title, labels.up, series.name, ending))
    for heading, values in series.others.items():
        table[_free(table, _joined(labels.title, heading))] = values


def _put(table: Columns, values: Array, *headings: str) -> None:
    """Add a column under the first of these headings that is free, unless one of them has it already."""
    fitting = (each for each in headings if each not in table or np.array_equal(table[each], values, equal_nan=True))
    table[next(fitting, None) or _free(table, headings[-1])] = values


def _add_rows(table: Columns, labels: _Labels, single: Sequence[_Series]) -> None:
    """Add series of one point each, a row each."""
    rows = [_row(labels, each) for each in single]
    table[_free(table, _joined(labels.title, "series"))] = [each.name for each in single]
    for heading in dict.fromkeys(heading for row in rows for heading in row):
        table[_free(table, heading)] = np.array([row.get(heading, np.nan) for row in rows])


def _row(labels: _Labels, series: _Series) -> dict[str, float]:
    both = ((labels.across, series.across), (labels.up, series.up))
    return {
        _joined(label, ending): float(values[0])
        for label, columns in both
        if label is not None
        for ending, values in columns.items()
    }


def _joined(*parts: str) -> str:
    return ", ".join(filter(None, parts))


def _free(table: Columns, heading: str) -> str:
    """Return a heading that is not in the table yet."""
    wanted, count = heading, 1
    while wanted in table:
        count += 1
        wanted = f"{heading} ({count})"
    return wanted


def _labels(axes: Axes, title: str) -> _Labels:
    shared_x, shared_y = axes.get_shared_x_axes(), axes.get_shared_y_axes()
    across = _label([one.get_xlabel() for one in (axes, *shared_x.get_siblings(axes))])
    up = _label([one.get_ylabel() for one in (axes, *shared_y.get_siblings(axes))])
    return _Labels(
        title,
        across or ("x" if axes.xaxis.get_tick_params()["labelbottom"] else None),
        up or ("y" if axes.yaxis.get_tick_params()["labelleft"] else None),
    )


def _title(axes: Axes) -> str:
    return _label([axes.get_title("left"), axes.get_title("center")])


def _label(given: Sequence[str]) -> str:
    """Return the first label that is not empty, in one line."""
    return next((" ".join(text.split()) for text in given if text.strip()), "")


def _series_of(axes: Axes) -> Iterator[_Series]:
    drawn: set[int] = set()
    for container in axes.containers:
        if isinstance(container, ErrorbarContainer):
            data, caps, ends = container.lines
            drawn |= {id(artist) for artist in (data, *caps, *ends) if artist is not None}
            yield from _bars(container)
    for artist in (*axes.lines, *axes.collections, *axes.patches):
        if id(artist) in drawn:
            continue
        name = _name(artist.get_label(), artist)
        if isinstance(artist, Line2D):
            yield from _line(axes, artist, name)
        elif isinstance(artist, LongBand):
            yield _Series(name, {"": artist.time}, {LOW: artist.below, HIGH: artist.above})
        elif isinstance(artist, PathCollection):
            across, up = np.ma.filled(np.ma.asarray(artist.get_offsets(), dtype=np.float64), np.nan).T
            yield _Series(name, {"": across}, {"": up})
        elif isinstance(artist, LineCollection):
            yield from _segments(artist, name)
        elif isinstance(artist, QuadMesh):
            yield _field(artist, name)
        elif isinstance(artist, Patch) and name:
            yield from _span(axes, artist, name)


def _name(label: object, artist: Artist) -> str:
    """Return the name of a series, with plain spaces: programs look columns up by it."""
    told = str(label or "_")
    return " ".join((str(artist.get_gid() or "") if told.startswith("_") else told).split())


def _line(axes: Axes, line: Line2D, name: str) -> Iterator[_Series]:
    across, up = (np.asarray(each, dtype=np.float64) for each in line.get_data(orig=False))
    is_across, is_up = line.get_transform().contains_branch_seperately(axes.transData)
    if is_across and is_up:
        placed = np.isfinite(across)  # a line may be broken by points that are nowhere
        yield _Series(name, {"": across[placed]}, {"": up[placed]})
    elif name and is_across:
        yield _Series(name, {"": _once(across)}, {})
    elif name and is_up:
        yield _Series(name, {}, {"": _once(up)})


def _once(values: Array) -> Array:
    return np.unique(values[np.isfinite(values)])


def _bars(container: ErrorbarContainer) -> Iterator[_Series]:
    """Read points with error bars, of which matplotlib keeps those along x before those along y."""
    data, _, ends = container.lines
    if data is None:
        return
    across, up = ({"": np.asarray(each, dtype=np.float64)} for each in data.get_data(orig=False))
    bars = [np.array([path.vertices for path in each.get_paths()]) for each in ends]
    for column, is_there in ((0, container.has_xerr), (1, container.has_yerr)):
        if is_there and (bar := bars.pop(0)).size:
            (across, up)[column].update({LOW: bar[:, 0, column], HIGH: bar[:, -1, column]})
    yield _Series(_name(container.get_label(), data), across, up)


def _segments(collection: LineCollection, name: str) -> Iterator[_Series]:
    """Read straight lines along one of the axes, as bars between two values."""
    ends = np.array([np.asarray(path.vertices)[[0, -1]] for path in collection.get_paths()])
    if not ends.size:
        return
    across, up = ends[:, :, 0], ends[:, :, 1]
    if np.array_equal(across[:, 0], across[:, 1]):
        yield _Series(name, {"": across[:, 0]}, {LOW: up.min(axis=1), HIGH: up.max(axis=1)})
    elif np.array_equal(up[:, 0], up[:, 1]):
        yield _Series(name, {LOW: across.min(axis=1), HIGH: across.max(axis=1)}, {"": up[:, 0]})


def _field(mesh: QuadMesh, name: str) -> _Series:
    """Read a field of colours: the middle of each cell and its value."""
    corners = np.asarray(mesh.get_coordinates(), dtype=np.float64)
    across, up = np.moveaxis((corners[1:, 1:] + corners[:-1, :-1]) / 2, -1, 0)
    values = np.asarray(mesh.get_array(), dtype=np.float64)
    return _Series("", {"": across.ravel()}, {"": up.ravel()}, {name or "value": values.ravel()})


def _span(axes: Axes, patch: Patch, name: str) -> Iterator[_Series]:
    """Read a shaded interval of one axis."""
    is_across, is_up = patch.get_data_transform().contains_branch_seperately(axes.transData)
    extent = patch.get_patch_transform().transform_path(patch.get_path()).get_extents()
    if is_across != is_up:
        low, high = (np.array([value]) for value in (extent.intervalx if is_across else extent.intervaly))
        between = {LOW: low, HIGH: high}
        yield _Series(name, between if is_across else {}, between if is_up else {})
