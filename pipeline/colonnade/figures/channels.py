"""Channels as recorded, with what is flagged; their spectra before and after the filter; each spike enlarged."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullLocator

from colonnade.figures.panels.curve import Curve, envelope
from colonnade.figures.panels.layout import BOTTOM, TOP, borrow_grid, legend_above, margins
from colonnade.figures.panels.lean import add_panel
from colonnade.figures.panels.long import draw_curve
from colonnade.figures.style import FAINT, INK, LIMIT, MEASURED, SOFT, styled, width
from colonnade.signals.metrics import Density

HEIGHT, GAP = 0.62, 0.21
"""Of a channel's row, and between rows; inches."""

HISTORY, SPECTRUM, SPIKE_WIDTH = 0.575, 0.235, 0.16
"""Widths of the panels over the room for them."""

RIGHT = 0.1
"""Right margin, inches."""

SPIKE_HEIGHT, SPIKE_TITLE = 0.6, 0.34
"""Of an enlarged spike and the room above it, inches."""

MOST_SPIKES = 6
"""Spikes that are enlarged."""

LONGEST_NAME = 16
"""Letters of a channel's name above a spike."""

INTERVALS = 300
"""Time intervals to which flagged samples are thinned."""

FAILED, DOUBTFUL = "#b3261e", "#c98a00"
"""Colours of failed or missing, and of suspect samples."""

DIGITS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Scale(NamedTuple):
    """Recorded value = (value − offset) / gain, in its unit; None for the gain if the two are the same."""

    unit: str
    gain: float | None
    offset: float


class Spike(NamedTuple):
    """A spike: its channel, time (s), the samples about it, and which of them are flagged."""

    channel: str
    time: float
    near: Curve
    flagged: Curve


class Channel(NamedTuple):
    """
    One channel.

    Attributes
    ----------
    name, unit : str
    curve : Curve
        As recorded, in its physical unit.
    recorded : Scale
        The scale of the recorder.
    failed, suspect : Curve
        The samples that carry these flags; missing ones count as failed, without a value.
    before, after : Density or None
        Spectra before and after the filter, in the unit per √Hz.
    cutoff : float
        Hz; NaN if it is not filtered.
    """

    name: str
    unit: str
    curve: Curve
    recorded: Scale
    failed: Curve
    suspect: Curve
    before: Density | None
    after: Density | None
    cutoff: float


@styled()
def channels_as_recorded(channels: Sequence[Channel], spikes: Sequence[Spike] = ()) -> Figure:
    """
    Draw a row a channel: as recorded over time, and its spectra; below them the first spikes, enlarged.

    Parameters
    ----------
    channels : sequence of Channel
    spikes : sequence of Spike, optional
        Those after `MOST_SPIKES` are not drawn.

    Returns
    -------
    figure : Figure

    Raises
    ------
    ValueError
        If there is no channel.
    """
    if not channels:
        raise ValueError("no channel was given; at least one was expected")
    rows = len(channels) * (HEIGHT + GAP) - GAP
    strip = SPIKE_TITLE + SPIKE_HEIGHT if spikes else 0.0
    across, (left, _) = width(), margins()
    history, spectrum_width = (share * (across - left - RIGHT) for share in (HISTORY, SPECTRUM))
    figure = Figure(figsize=(across, TOP + rows + BOTTOM + strip))
    histories: list[Axes] = []
    spectra: list[Axes] = []
    for index in range(len(channels)):
        top = TOP + index * (HEIGHT + GAP)
        histories.append(add_panel(figure, left, top, history, HEIGHT, sharex=_first(histories)))
        spectra.append(
            add_panel(figure, across - RIGHT - spectrum_width, top, spectrum_width, HEIGHT, sharex=_first(spectra))
        )
    for over_time, over_frequency, channel in zip(histories, spectra, channels, strict=True):
        _draw_history(over_time, channel)
        _draw_spectrum(over_frequency, channel)
    for panels, name in ((histories, "time (s)"), (spectra, "frequency (Hz)")):
        for one in panels[:-1]:
            borrow_grid(one, panels[-1])
        panels[-1].set_xlabel(name)
    ends = [(channel.curve.time[0], channel.curve.time[-1]) for channel in channels if channel.curve.time.size]
    if ends:
        histories[0].set_xlim(min(first for first, _ in ends), max(last for _, last in ends))
    _scale_frequencies(spectra[-1])
    spike_width = SPIKE_WIDTH * (across - left - RIGHT)
    for index, spike in enumerate(spikes[:MOST_SPIKES]):
        place = left + index * (across - left - RIGHT - spike_width) / (MOST_SPIKES - 1)
        _draw_spike(
            add_panel(figure, place, TOP + rows + BOTTOM + SPIKE_TITLE - 0.06, spike_width, SPIKE_HEIGHT), spike
        )
    legend_above(figure, [*histories, *spectra])
    return figure


def _first(panels: Sequence[Axes]) -> Axes | None:
    return panels[0] if panels else None


def _draw_history(axes: Axes, channel: Channel) -> None:
    draw_curve(axes, channel.curve, color=MEASURED["color"], linewidth=0.7)
    for flagged, colour, mark, label in (
        (channel.suspect, DOUBTFUL, ".", "suspect"),
        (channel.failed, FAILED, "x", "failed or missing"),
    ):
        if flagged.time.size:
            time, values = envelope(flagged, intervals=INTERVALS)
            low = float(np.nanmin(channel.curve.values)) if np.isfinite(channel.curve.values).any() else 0.0
            shown = np.where(np.isfinite(values), values, low)
            axes.plot(time, shown, mark, color=colour, markersize=4, label=label, zorder=3, clip_on=False)
    axes.margins(y=0.08)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=3, steps=[1, 2, 5, 10]))
    axes.set_ylabel(channel.unit)
    axes.text(0.0, 1.02, channel.name, transform=axes.transAxes, fontsize=8, va="bottom", color=INK, weight="bold")
    _draw_recorded(axes, channel.recorded)


def _draw_recorded(axes: Axes, recorded: Scale) -> None:
    """Write the recorder's values at the right, at the heights of the ticks of the physical ones."""
    if recorded.gain is None:
        return
    low, high = axes.get_ylim()
    ends = sorted(((low - recorded.offset) / recorded.gain, (high - recorded.offset) / recorded.gain))
    for tick in MaxNLocator(nbins=3, steps=[1, 2, 5, 10]).tick_values(*ends):
        height = recorded.gain * tick + recorded.offset
        if low <= height <= high:
            text = f"{tick:g}".replace("-", "−")
            axes.text(1.01, height, text, transform=axes.get_yaxis_transform(), fontsize=7.5, va="center", color=SOFT)
    axes.text(1.01, 1.02, recorded.unit, transform=axes.transAxes, fontsize=8, va="bottom", color=SOFT)


def _draw_spectrum(axes: Axes, channel: Channel) -> None:
    for spectrum, colour, label in (
        (channel.before, FAINT, "spectrum before the filter"),
        (channel.after, MEASURED["color"], "after it"),
    ):
        if spectrum is not None:
            shown = spectrum.amplitude > 0
            axes.plot(spectrum.frequency[shown], spectrum.amplitude[shown], color=colour, linewidth=0.8, label=label)
    known = [each for each in (channel.before, channel.after) if each is not None and (each.amplitude > 0).any()]
    if not known:
        axes.text(0.5, 0.5, "no spectrum", transform=axes.transAxes, ha="center", va="center", fontsize=8)
        axes.set_yticks([])
        return
    axes.set_xscale("log")
    axes.set_yscale("log")
    highest = max(float(each.amplitude.max()) for each in known)
    # Far above its cut-off a filtered channel is rounding alone.
    first = known[0].amplitude
    axes.set_ylim(0.2 * float(first[first > 0].min()), 3 * highest)
    axes.yaxis.set_major_locator(LogLocator(numticks=4))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(_power_of_ten))
    axes.tick_params(labelsize=7.5)
    axes.set_ylabel(f"{channel.unit}/√Hz", fontsize=8)
    if np.isfinite(channel.cutoff):
        axes.axvline(channel.cutoff, label="cut-off", **LIMIT)


def _scale_frequencies(axes: Axes) -> None:
    if axes.get_xscale() == "log":
        axes.xaxis.set_major_locator(LogLocator(numticks=5))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def _draw_spike(axes: Axes, spike: Spike) -> None:
    axes.plot(*spike.near, ".-", color=MEASURED["color"], linewidth=0.7, markersize=2.5)
    axes.plot(*spike.flagged, "x", color=FAILED, markersize=5)
    axes.set_xticks([])
    axes.set_yticks([])
    axes.margins(0.05, 0.12)
    name = spike.channel if len(spike.channel) <= LONGEST_NAME else f"{spike.channel[: LONGEST_NAME - 1]}…"
    axes.set_title(f"{name}\n{spike.time:.3f} s", fontsize=7.5, pad=2)


def _power_of_ten(value: float, _: int) -> str:
    return "10" + str(round(float(np.log10(value)))).translate(DIGITS)
