"""Channels as recorded, with what is flagged; and their spectra before and after the filter."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullLocator

from colonnade.arrays import Array, Codes, Mask
from colonnade.errors import count
from colonnade.figures.files.output import Picture
from colonnade.figures.histories import time_limits
from colonnade.figures.panels.curve import Curve, draw_curve, envelope
from colonnade.figures.panels.layout import (
    BOTTOM,
    TOP,
    add_panel,
    leave_scale_to_last,
    legend_above,
    margins,
    note,
    plain_decades,
)
from colonnade.figures.stored.subject import OfTest
from colonnade.figures.style import FAINT, LIMIT, MEASURED, SOFT, styled, width
from colonnade.signals.metrics import Density, density
from colonnade.signals.quality import Flag
from colonnade.units import CHANNEL_UNITS, from_si

HEIGHT, GAP = 0.62, 0.21
"""Of a channel's row, and between rows; inches."""

HISTORY, SPECTRUM = 0.575, 0.235
"""Widths of the panels over the room for them."""

RIGHT = 0.1
"""Right margin, inches."""

UNIT_ROOM = 0.06
"""Of a row's height, in which the recorder's unit leaves no room for a value."""

INTERVALS = 300
"""Time intervals to which flagged samples are thinned."""

FAILED, DOUBTFUL = "#b3261e", "#c98a00"
"""Colours of failed or missing, and of suspect samples."""

DIGITS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Scale(NamedTuple):
    """Of the recorder: value = gain · recorded value + offset; `unit` is that of the recorded value."""

    unit: str
    gain: float
    offset: float


class Channel(NamedTuple):
    """
    One channel.

    Attributes
    ----------
    name, unit : str
    curve : Curve
        As recorded, in its physical unit.
    flags : ndarray of int8
        `Flag` of each sample.
    recorded : Scale or None
        The scale of the recorder; None if its values are those that are shown, or not in proportion to them.
    before, after : Density or None
        Spectra before and after the filter, in the unit per √Hz.
    cutoff : float
        Hz; NaN if it is not filtered.
    """

    name: str
    unit: str
    curve: Curve
    flags: Codes
    recorded: Scale | None
    before: Density | None
    after: Density | None
    cutoff: float

    def flagged(self, *flags: Flag) -> Curve:
        """Return the samples that carry one of these flags."""
        chosen = np.isin(self.flags, flags)
        return Curve(self.curve.time[chosen], self.curve.values[chosen])


@styled()
def channels_as_recorded(channels: Sequence[Channel]) -> Figure:
    """Draw a row a channel: as recorded over time, and its spectra."""
    rows = len(channels) * (HEIGHT + GAP) - GAP
    across, (left, _) = width(), margins()
    room = across - left - RIGHT
    figure = Figure(figsize=(across, TOP + rows + BOTTOM))
    histories: list[Axes] = []
    spectra: list[Axes] = []
    for index, channel in enumerate(channels):
        top, (first, second) = TOP + index * (HEIGHT + GAP), (histories[0], spectra[0]) if histories else (None, None)
        histories.append(add_panel(figure, left, top, HISTORY * room, HEIGHT, sharex=first))
        beside = across - RIGHT - SPECTRUM * room
        spectra.append(add_panel(figure, beside, top, SPECTRUM * room, HEIGHT, sharex=second))
        _draw_history(histories[-1], channel)
        _draw_spectrum(spectra[-1], channel)
    for panels, name in ((histories, "time (s)"), (spectra, "frequency (Hz)")):
        leave_scale_to_last(panels)
        panels[-1].set_xlabel(name)
    histories[0].set_xlim(*time_limits(channel.curve for channel in channels))
    if spectra[-1].get_xscale() == "log":
        plain_decades(spectra[-1].xaxis, subs=(1.0,))
    legend_above(figure, [*histories, *spectra])
    return figure


def _draw_history(axes: Axes, channel: Channel) -> None:
    draw_curve(axes, channel.curve, color=MEASURED["color"], linewidth=0.7)
    known = channel.curve.values[np.isfinite(channel.curve.values)]
    foot = float(known.min()) if known.size else 0.0
    for flags, colour, mark, label in (
        ((Flag.SUSPECT,), DOUBTFUL, ".", "suspect"),
        ((Flag.FAIL, Flag.MISSING), FAILED, "x", "failed or missing"),
    ):
        flagged = channel.flagged(*flags)
        if flagged.time.size:
            time, values = envelope(flagged, intervals=INTERVALS)
            shown = np.where(np.isfinite(values), values, foot)
            axes.plot(time, shown, mark, color=colour, markersize=4, label=label, zorder=3, clip_on=False)
    axes.margins(y=0.08)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=3, steps=[1, 2, 5, 10]))
    axes.set_ylabel(channel.unit)
    axes.set_title(channel.name, loc="left", fontsize=8, weight="bold", pad=2)
    if channel.recorded is not None:
        _draw_recorded(axes, channel.recorded)


def _draw_recorded(axes: Axes, recorded: Scale) -> None:
    """Write the recorder's values at the right, at the heights of the ticks of the physical ones."""
    low, high = axes.get_ylim()
    ends = sorted(((low - recorded.offset) / recorded.gain, (high - recorded.offset) / recorded.gain))
    for tick in MaxNLocator(nbins=3, steps=[1, 2, 5, 10]).tick_values(*ends):
        height = recorded.gain * tick + recorded.offset
        if low <= height <= high - UNIT_ROOM * (high - low):
            text = f"{tick:g}".replace("-", "−")
            place = axes.get_yaxis_transform()
            note(axes, text, (1.01, height), xycoords=place, fontsize=7.5, va="center", color=SOFT)
    note(axes, recorded.unit, (1.01, 1.02), xycoords="axes fraction", va="bottom", color=SOFT)


def _draw_spectrum(axes: Axes, channel: Channel) -> None:
    drawn = ((channel.before, FAINT, "spectrum before the filter"), (channel.after, MEASURED["color"], "after it"))
    known = [each for each, *_ in drawn if each is not None and (each.amplitude > 0).any()]
    for spectrum, colour, label in drawn:
        if spectrum is not None:
            shown = spectrum.amplitude > 0
            axes.plot(spectrum.frequency[shown], spectrum.amplitude[shown], color=colour, linewidth=0.8, label=label)
    if not known:
        axes.text(0.5, 0.5, "no spectrum", transform=axes.transAxes, ha="center", va="center", fontsize=8)
        axes.set_yticks([])
        return
    axes.set(xscale="log", yscale="log")
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


def _power_of_ten(value: float, _: int) -> str:
    return "10" + str(round(float(np.log10(value)))).translate(DIGITS)


PROPORTIONAL = 1e-6
"""Values follow from recorded ones by a line if none is further from it, over the largest."""

MOST_CHANNELS = 12
"""Channels that are drawn."""


def picture(one: OfTest) -> Picture | None:
    """
    Every channel as recorded: flags, spikes, spectra.

    Left: channels as recorded, in their physical unit and, at the right of each panel, in the unit of the recorder.
    Right: amplitude spectral density before and after the filter, flagged samples bridged; dotted line: cut-off of the
    low-pass.
    """
    stored = one.stored
    recorded, conditioned = (stored.datasets.get((stage, None)) for stage in ("ingest", "condition"))
    variables = {} if recorded is None else recorded.data_vars
    names = [str(name) for name, each in variables.items() if "channel" in each.attrs and each.ndim == 1]
    if recorded is None or not names:
        return None
    shown = names[:MOST_CHANNELS]
    attributes = {name: stored.channels.get(str(recorded[name].attrs["channel"]), {}) for name in shown}
    channels = [_channel(name, recorded, conditioned, attributes[name]) for name in shown]
    failed = {channel.name: channel.flagged(Flag.FAIL, Flag.MISSING).time.size for channel in channels}
    flagged = [f"{name}: {count(number, 'failed or missing sample')}" for name, number in failed.items()]
    said = f"{MOST_CHANNELS} of {len(names)} channels are drawn." if len(names) > MOST_CHANNELS else ""
    return Picture(
        channels_as_recorded(channels),
        f"channels-{one.test.id}",
        f"{one.test.id}: channels as recorded, and their spectra before and after the filter",
        f"{'; '.join(flagged)}.",
        said,
    )


def _channel(name: str, recorded: xr.Dataset, conditioned: xr.Dataset | None, given: Mapping[str, Any]) -> Channel:
    variable, quantity = recorded[name], str(given.get("quantity", ""))
    recorder = str(given.get("recorded_unit", ""))
    unit = CHANNEL_UNITS.get(quantity, recorder)
    factor = from_si(1.0, unit) if quantity in CHANNEL_UNITS else 1.0
    time, values = recorded[str(variable.dims[0])].to_numpy(), factor * variable.to_numpy()
    quality, raw = recorded.get(f"{name}_quality"), recorded.get(f"{name}_recorded")
    flags = np.full(time.size, Flag.GOOD, np.int8) if quality is None else quality.to_numpy()
    after = None
    if conditioned is not None and name in conditioned:
        kept = factor * conditioned[name].to_numpy()
        after = _density(conditioned[str(conditioned[name].dims[0])].to_numpy(), kept, np.isfinite(kept))
    cutoff = given.get("cutoff_hz", np.nan)
    return Channel(
        str(variable.attrs["channel"]),
        unit or "–",
        Curve(time, values),
        flags,
        None if raw is None else _scale(values, raw.to_numpy(), recorder, unit),
        _density(time, values, ~np.isin(flags, (Flag.FAIL, Flag.MISSING))),
        after,
        float(cutoff) if isinstance(cutoff, (int, float)) else np.nan,
    )


def _scale(values: Array, recorded: Array, unit: str, physical: str) -> Scale | None:
    """Return the recorder's scale, None if its values are those that are shown."""
    line = line_between(recorded, values)
    if line is None or (
        unit == physical and np.allclose(line, (1.0, 0.0), atol=1e-9 * float(np.nanmax(np.abs(values))))
    ):
        return None
    return Scale(unit, *line)


def line_between(recorded: Array, values: Array) -> tuple[float, float] | None:
    """Return gain and offset that lead from recorded values to others; None if they do not, as after corrections."""
    known = np.isfinite(recorded) & np.isfinite(values)
    raw, shown = recorded[known], values[known]
    if not raw.size or np.ptp(raw) == 0 or np.ptp(shown) == 0:
        return None
    low, high = raw.argmin(), raw.argmax()
    gain = float((shown[high] - shown[low]) / (raw[high] - raw[low]))
    offset = float(shown[low] - gain * raw[low])
    wrong = np.abs(shown - offset - gain * raw).max()
    return (gain, offset) if wrong <= PROPORTIONAL * np.abs(shown).max() and gain != 0.0 else None


def _density(time: Array, values: Array, usable: Mask) -> Density | None:
    interval = float(np.nanmedian(np.diff(time))) if time.size > 1 else 0.0
    return density(values, interval, usable)
