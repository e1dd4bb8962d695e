"""Condition: recorded channels -> one uniform clock, de-spiked, low-passed without delay, zeroed at rest."""

from __future__ import annotations

from dataclasses import dataclass
from math import acosh
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from colonnade.campaign import Campaign, Test
from colonnade.campaign.setup import Align
from colonnade.errors import StageError
from colonnade.signals.alignment import find_offset
from colonnade.signals.clock import resample, sampling_interval, uniform_clock
from colonnade.signals.filters import bridge, lowpass, noise_below, second_derivative
from colonnade.signals.quality import Flag
from colonnade.signals.rest import RestWindow, find_rest
from colonnade.store.variables import variable_name

Array = NDArray[np.float64]

SMALL_AMPLITUDE = 0.02
"""|θ|/α whose rocking frequency, the highest of interest, sets the default cut-off."""

HARMONICS = 5.0
"""Default cut-off over that frequency: the arcs' third harmonic passes, see the notes of `default_lowpass`."""

LINK_BANDWIDTH = 10.0
"""Hz; recorders are aligned on what their linked channels share below it, where a displacement's noise is no matter."""


class Instructions(BaseModel):
    """
    What this stage reads of the campaign.

    Attributes
    ----------
    channels : dict of str to (quantity, on, recorder)
        By channel id.
    delays : dict of str to float
        s, by channel id.
    links : dict of str to (channel of the main recorder, own channel)
        By recorder; one that is not in it starts with the main recorder.
    sampling_rate, lowpass, base_lowpass : float or "auto"
        Hz.
    p : float
        Of the specimen, rad/s.
    zero : str or (float, float)
        "auto", "start", "end", "none" or a stretch, s.
    """

    model_config = ConfigDict(frozen=True)

    channels: dict[str, tuple[str, str | None, str]]
    delays: dict[str, float]
    links: dict[str, tuple[str, str]]
    sampling_rate: float | str
    lowpass: float | str
    base_lowpass: float | str
    filter_order: int
    p: float
    kind: str
    zero: str | tuple[float, float]
    rest_duration: float
    longest_offset: float


def instructions(campaign: Campaign, test: Test) -> Instructions:
    """Gather what `condition` reads for one test."""
    setup, settings = campaign.setups[test.setup], campaign.processing
    return Instructions(
        channels={name: (channel.quantity, channel.on, channel.recorder) for name, channel in setup.channels.items()},
        delays={name: channel.delay for name, channel in setup.channels.items()},
        links={
            name: (recorder.clock.channel, recorder.clock.own_channel)
            for name, recorder in setup.recorders.items()
            if isinstance(recorder.clock, Align)
        },
        sampling_rate=settings.sampling_rate,
        lowpass=settings.lowpass,
        base_lowpass=settings.base_lowpass,
        filter_order=settings.filter_order,
        p=campaign.specimens[test.specimen].block(campaign.gravity).p,
        kind=test.kind,
        zero=test.zero,
        rest_duration=settings.rest_duration,
        longest_offset=settings.longest_offset,
    )


@dataclass(frozen=True)
class _Source:
    """A channel on its own clock, bad samples bridged."""

    time: Array
    values: Array
    flags: NDArray[np.int8]
    interval: float


def condition(recorded: xr.Dataset, instructions: Instructions) -> xr.Dataset:
    """
    Bring all channels to one clock and to what they mean.

    Parameters
    ----------
    recorded : xr.Dataset
        Result of `ingest`.
    instructions : Instructions

    Returns
    -------
    conditioned : xr.Dataset
        For each channel `<name>` (SI) and `<name>_quality` on `elapsed`. Attributes of `<name>`: `zero` (taken
        off, SI), `zero_window`, `noise` (standard deviation, SI), `cutoff_hz`, `clock_offset` (taken off, s).

    Raises
    ------
    StageError
        If no channel has a good sample, or the channels share no time.
    """
    warnings: list[str] = []
    sources = _sources(recorded, instructions, warnings)
    offsets = _offsets(sources, instructions, warnings)
    clock = _common_clock(sources, offsets, instructions)
    interval = float(clock[1] - clock[0])

    raw, filtered, flags, attributes = {}, {}, {}, {}
    for name, source in sources.items():
        _, on, recorder = instructions.channels[name]
        offset, error = offsets.get(recorder, (0.0, 0.0))
        shift = offset + instructions.delays[name]
        values, missing = resample(source.time - shift, source.values, clock, source.interval)
        cutoff = _cutoff(on, interval, source.interval, instructions)
        raw[name], filtered[name] = values, lowpass(values, interval, cutoff, instructions.filter_order)
        flags[name] = _flags_on(clock, source, shift, missing)
        attributes[name] = recorded[variable_name(name)].attrs | {
            "cutoff_hz": cutoff,
            "noise": noise_below(values, interval, cutoff, instructions.filter_order),
            "clock_offset": shift,
            "clock_offset_standard_error": error,
        }
        attributes[name].pop("quality_report", None)

    window = _rest(clock, filtered, attributes, instructions, warnings)
    variables: dict[str, Any] = {}
    for name, values in filtered.items():
        zero = _zero(clock, values, name, attributes[name], window, instructions)
        values = np.where(flags[name] == Flag.MISSING, np.nan, values - zero)
        variables[variable_name(name)] = ("elapsed", values, attributes[name])
        variables[f"{variable_name(name)}_quality"] = ("elapsed", flags[name])
    return xr.Dataset(variables, coords={"elapsed": ("elapsed", clock)}, attrs={"warnings": warnings})


def default_lowpass(p: float, rate: float) -> float:
    """
    Cut-off for channels on the specimen, Hz.

    Parameters
    ----------
    p : float
        rad/s.
    rate : float
        Sampling rate, Hz.

    Notes
    -----
    A block rocks at p / (4 acosh(1/(1 − |θ|/α))) Hz (Housner 1963). Its history is close to a row of alternating
    parabolas, whose harmonics fall with the cube of their number; five times the frequency at 0.02 α lets the third
    pass whole.
    """
    return min(HARMONICS * p / (4 * acosh(1 / (1 - SMALL_AMPLITUDE))), 0.4 * rate)


def _sources(recorded: xr.Dataset, instructions: Instructions, warnings: list[str]) -> dict[str, _Source]:
    sources = {}
    for name in instructions.channels:
        variable = recorded[variable_name(name)]
        time = recorded[str(variable.dims[0])].to_numpy()
        values, flags = variable.to_numpy(), recorded[f"{variable_name(name)}_quality"].to_numpy()
        kept = np.isfinite(time)
        latest = np.fmax.accumulate(np.where(kept, time, -np.inf))
        kept[1:] &= time[1:] > latest[:-1]
        bad = (flags[kept] >= Flag.FAIL) | ~np.isfinite(values[kept])
        if (~bad).sum() < 2:
            warnings.append(f"channel {name} is left out: none of its {values.size} samples is usable.")
            continue
        bridged = bridge(time[kept], values[kept], bad)
        sources[name] = _Source(time[kept], bridged, flags[kept].astype(np.int8), sampling_interval(time[kept]))
    if not sources:
        raise StageError("No channel of this test has a usable sample; see the warnings of its ingest.")
    return sources


def _offsets(
    sources: dict[str, _Source], instructions: Instructions, warnings: list[str]
) -> dict[str, tuple[float, float]]:
    """Delay of each recorder against the main one and its standard error, s."""
    offsets = {}
    for recorder, (channel, own_channel) in instructions.links.items():
        if channel not in sources or own_channel not in sources:
            warnings.append(f"recorder {recorder} could not be aligned, as {channel} or {own_channel} is not usable.")
            continue
        found = _link(sources[channel], sources[own_channel], channel, own_channel, instructions)
        if found.is_determined:
            offsets[recorder] = (found.seconds, found.standard_error)
        else:
            warnings.append(
                f"recorder {recorder} was taken to start with the main one: {channel} and {own_channel} agree by "
                f"{found.correlation:.2f} only (0.7 is needed), as they do where the table hardly moves."
            )
    return offsets


def _link(first: _Source, second: _Source, channel: str, own_channel: str, instructions: Instructions) -> Any:
    interval = max(first.interval, second.interval)
    reach = instructions.longest_offset
    clock = uniform_clock(max(first.time[0], second.time[0]), min(first.time[-1], second.time[-1]), interval)
    if clock.size < 16:
        raise StageError(
            f"channels {channel} and {own_channel} share {clock.size} samples; recorders are aligned on what both saw. "
            "Look at the times in their files."
        )
    bandwidth = min(LINK_BANDWIDTH, 0.2 / interval)
    quantities = [instructions.channels[name][0] for name in (channel, own_channel)]
    signals = []
    for source, quantity in zip((first, second), quantities, strict=True):
        values, _ = resample(source.time, source.values, clock, source.interval)
        if quantity == "displacement" and "acceleration" in quantities:
            signals.append(second_derivative(values, interval, bandwidth))
        else:
            signals.append(lowpass(values, interval, bandwidth))
    return find_offset(signals[0], signals[1], interval, longest=reach, bandwidth_hz=bandwidth)


def _common_clock(
    sources: dict[str, _Source], offsets: dict[str, tuple[float, float]], instructions: Instructions
) -> Array:
    """Clock of the main recorder over the stretch that all channels share."""
    starts, stops = [], []
    for name, source in sources.items():
        shift = offsets.get(instructions.channels[name][2], (0.0, 0.0))[0] + instructions.delays[name]
        starts.append(source.time[0] - shift)
        stops.append(source.time[-1] - shift)
    of_main = [source for name, source in sources.items() if instructions.channels[name][2] == "main"]
    leading = (of_main or list(sources.values()))[0]
    rate = instructions.sampling_rate
    interval = leading.interval if isinstance(rate, str) else 1 / rate
    steps = np.ceil((max(starts) - leading.time[0]) / interval - 1e-6)
    clock = uniform_clock(leading.time[0] + steps * interval, min(stops), interval)
    if clock.size < 16:
        raise StageError(
            f"The channels share {max(min(stops) - max(starts), 0.0):.3g} s, {clock.size} samples; at least 16 were "
            "expected. Look at the start times of the recorders and at the test's `window`."
        )
    return clock


def _cutoff(on: str | None, interval: float, own_interval: float, instructions: Instructions) -> float:
    rate = 1 / max(interval, own_interval)
    wanted = instructions.lowpass if on == "specimen" else instructions.base_lowpass
    if not isinstance(wanted, str):
        if wanted >= 0.5 / interval:
            key = "lowpass" if on == "specimen" else "base_lowpass"
            raise StageError(
                f"processing.{key} is {wanted:g} Hz; below {0.5 / interval:g} Hz, half the sampling rate of "
                'this test, was expected. Choose a lower one, or "auto".'
            )
        return wanted
    return default_lowpass(instructions.p, rate) if on == "specimen" else 0.2 * rate


def _flags_on(clock: Array, source: _Source, shift: float, missing: NDArray[np.bool_]) -> NDArray[np.int8]:
    """Flags of the nearest recorded sample; what was bridged is suspect, not failed."""
    times = source.time - shift
    after = np.clip(np.searchsorted(times, clock), 1, times.size - 1)
    nearest = np.where(clock - times[after - 1] < times[after] - clock, after - 1, after)
    flags = source.flags[nearest].copy()
    flags[flags >= Flag.FAIL] = Flag.SUSPECT
    flags[missing] = Flag.MISSING
    return flags


def _rest(
    clock: Array,
    filtered: dict[str, Array],
    attributes: dict[str, dict[str, Any]],
    instructions: Instructions,
    warnings: list[str],
) -> RestWindow | None:
    """Window of the true rest state: of a free vibration the end, of all others the start."""
    if instructions.zero == "none":
        return None
    if not isinstance(instructions.zero, str):
        low, high = instructions.zero
        return RestWindow(low, high, True)
    end = instructions.zero == "end" or (instructions.zero == "auto" and instructions.kind == "free-vibration")
    judged = {
        name: (values, float(attributes[name]["noise"]))
        for name, values in filtered.items()
        if instructions.channels[name][0] in ("displacement", "angle")
    } or {
        name: (values, float(attributes[name]["noise"]))
        for name, values in filtered.items()
        if instructions.channels[name][0] == "acceleration"
    }
    window = find_rest(clock, judged, end=end, duration=instructions.rest_duration)
    if not window.quiet:
        warnings.append(
            f"Zero was taken from {window.start:.3g} to {window.stop:.3g} s, but {window.reason}. Give the test a "
            '`zero` such as ["0 s", "0.5 s"] where the specimen stood still.'
        )
    return window


def _zero(
    clock: Array,
    values: Array,
    name: str,
    attributes: dict[str, Any],
    window: RestWindow | None,
    instructions: Instructions,
) -> float:
    """Rest value of a channel, noted in its attributes; forces and other quantities keep theirs."""
    if window is None or instructions.channels[name][0] in ("force", "other"):
        return 0.0
    inside = (clock >= window.start) & (clock <= window.stop)
    if not inside.any():
        raise StageError(
            f"zero: no sample lies between {window.start:g} and {window.stop:g} s; the record goes from {clock[0]:.3g} "
            f"to {clock[-1]:.3g} s. Give a stretch inside it."
        )
    attributes["zero"] = float(values[inside].mean())
    attributes["zero_window"] = f"{window.start:.6g} s to {window.stop:.6g} s"
    if window.quiet:
        attributes["noise"] = max(float(values[inside].std()), float(attributes["noise"]))
    return float(attributes["zero"])
