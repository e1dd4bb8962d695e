"""The recorded channels of a test with their flags, spikes and spectra, from its stored samples."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import xarray as xr

from colonnade.arrays import Array, Codes, Mask
from colonnade.campaign import Test
from colonnade.errors import count
from colonnade.figures.channels import MOST_SPIKES, Channel, Scale, Spike, channels_as_recorded
from colonnade.figures.files.output import Picture
from colonnade.figures.panels.curve import Curve
from colonnade.signals.metrics import Density, density
from colonnade.signals.quality import Flag
from colonnade.store.records.stored import Stored
from colonnade.units import from_si
from colonnade.units.text import CHANNEL_UNITS

MOST_CHANNELS = 12
"""Channels that are drawn."""

LONGEST_SPIKE = 20
"""Samples; longer failed stretches are no spikes."""

AROUND = 12
"""Samples before and after a spike that are drawn with it."""


def picture(test: Test, stored: Stored) -> Picture | None:
    """Draw all channels of a test as recorded; None if their samples are not at hand."""
    recorded, conditioned = (stored.datasets.get((stage, None)) for stage in ("ingest", "condition"))
    names = [] if recorded is None else [str(name) for name, each in recorded.data_vars.items() if _is_channel(each)]
    if recorded is None or not names:
        return None
    shown = names[:MOST_CHANNELS]
    attributes = {name: stored.channels.get(str(recorded[name].attrs["channel"]), {}) for name in shown}
    channels = [_channel(name, recorded, conditioned, attributes[name]) for name in shown]
    spikes = [
        spike
        for channel, name in zip(channels, shown, strict=True)
        for spike in _spikes(channel, _flags(recorded, name))
    ]
    flagged = [f"{each.name}: {count(each.failed.time.size, 'failed or missing sample')}" for each in channels]
    notes = []
    if len(names) > MOST_CHANNELS:
        notes.append(f"{MOST_CHANNELS} of {len(names)} channels are drawn.")
    if len(spikes) > MOST_SPIKES:
        notes.append(f"The first {MOST_SPIKES} of {len(spikes)} spikes are enlarged.")
    return Picture(
        channels_as_recorded(channels, spikes),
        f"channels-{test.id}",
        f"{test.id}: channels as recorded, and their spectra before and after the filter",
        f"{'; '.join(flagged)}. {count(len(spikes), 'spike')}.",
        " ".join(notes),
    )


def _is_channel(variable: xr.DataArray) -> bool:
    return "channel" in variable.attrs and variable.ndim == 1


def _channel(name: str, recorded: xr.Dataset, conditioned: xr.Dataset | None, given: Mapping[str, Any]) -> Channel:
    variable = recorded[name]
    unit = CHANNEL_UNITS.get(str(given.get("quantity", "")), str(given.get("recorded_unit", "")))
    factor = from_si(1.0, unit) if str(given.get("quantity", "")) in CHANNEL_UNITS else 1.0
    time, values = recorded[str(variable.dims[0])].to_numpy(), factor * variable.to_numpy()
    flags = _flags(recorded, name)
    failed, suspect = np.isin(flags, (Flag.FAIL, Flag.MISSING)), flags == Flag.SUSPECT
    cutoff = given.get("cutoff_hz", np.nan)
    return Channel(
        str(variable.attrs["channel"]),
        unit or "–",
        Curve(time, values),
        _scale(values, recorded.get(f"{name}_recorded"), str(given.get("recorded_unit", "")), unit),
        Curve(time[failed], values[failed]),
        Curve(time[suspect], values[suspect]),
        _density(time, values, ~failed),
        None if conditioned is None or name not in conditioned else _conditioned(conditioned, name, factor),
        float(cutoff) if isinstance(cutoff, (int, float)) else np.nan,
    )


def _flags(recorded: xr.Dataset, name: str) -> Codes:
    flags = recorded.get(f"{name}_quality")
    return np.full(recorded[name].size, Flag.GOOD, np.int8) if flags is None else flags.to_numpy()


def _scale(values: Array, recorded: xr.DataArray | None, unit: str, physical: str) -> Scale:
    """Return the recorder's scale from two of its samples: physical values follow from recorded ones by a line."""
    if recorded is None:
        return Scale(unit, None, 0.0)
    raw = recorded.to_numpy()
    known = np.flatnonzero(np.isfinite(raw) & np.isfinite(values))
    if not known.size or raw[known].min() == raw[known].max():
        return Scale(unit, None, 0.0)
    low, high = known[np.argmin(raw[known])], known[np.argmax(raw[known])]
    gain = float((values[high] - values[low]) / (raw[high] - raw[low]))
    offset = float(values[low] - gain * raw[low])
    same = unit == physical and np.isclose(gain, 1.0) and abs(offset) < 1e-9 * max(abs(float(values[high])), 1e-12)
    return Scale(unit, None if same or gain == 0.0 else gain, offset)


def _conditioned(conditioned: xr.Dataset, name: str, factor: float) -> Density | None:
    values = factor * conditioned[name].to_numpy()
    return _density(conditioned[str(conditioned[name].dims[0])].to_numpy(), values, np.isfinite(values))


def _density(time: Array, values: Array, usable: Mask) -> Density | None:
    interval = float(np.nanmedian(np.diff(time))) if time.size > 1 else 0.0
    return density(values, interval, usable)


def _spikes(channel: Channel, flags: Codes) -> Iterator[Spike]:
    """Yield short stretches of failed samples with what is around them."""
    at = np.flatnonzero(flags == Flag.FAIL)
    if not at.size:
        return
    for stretch in np.split(at, np.flatnonzero(np.diff(at) > 1) + 1):
        if stretch.size <= LONGEST_SPIKE:
            time, values = channel.curve
            near = slice(max(stretch[0] - AROUND, 0), stretch[-1] + AROUND + 1)
            yield Spike(
                channel.name,
                float(time[stretch[0]]),
                Curve(time[near], values[near]),
                Curve(time[stretch], values[stretch]),
            )
