"""Condition: recorded channels -> one uniform clock, de-spiked, low-passed without delay, zeroed at rest."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from colonnade.campaign import Campaign, Channel, Test
from colonnade.campaign.setup import Align
from colonnade.errors import StageError
from colonnade.signals.alignment import Offset, link
from colonnade.signals.clock import uniform_clock
from colonnade.signals.filters import default_lowpass
from colonnade.signals.record import Record, even_record, on_clock, smoothed
from colonnade.signals.rest import RestWindow, find_rest
from colonnade.store.variables import variable_name

Array = NDArray[np.float64]


class Instructions(BaseModel):
    """
    What this stage reads of the campaign.

    Attributes
    ----------
    channels : dict of str to (quantity, on, recorder)
        By channel id.
    delays : dict of str to float
        s, by channel id.
    links : dict of str to (channel of the main recorder, own channel, sign)
        By recorder; the sign is -1 where the two point against each other. One that is not in it starts with the main
        recorder.
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
    links: dict[str, tuple[str, str, float]]
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
    aligned = {name: recorder.clock for name, recorder in setup.recorders.items() if isinstance(recorder.clock, Align)}
    return Instructions(
        channels={name: (channel.quantity, channel.on, channel.recorder) for name, channel in setup.channels.items()},
        delays={name: channel.delay for name, channel in setup.channels.items()},
        links={name: _link(setup.channels, clock) for name, clock in aligned.items()},
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


def _link(channels: Mapping[str, Channel], clock: Align) -> tuple[str, str, float]:
    one, other = channels[clock.channel].direction, channels[clock.own_channel].direction
    against = one is not None and other is not None and float(np.dot(one, other)) < 0
    return clock.channel, clock.own_channel, -1.0 if against else 1.0


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
        off, SI), `zero_window`, `noise` (standard deviation, SI), `cutoff_hz`, `clock_offset` (taken off, s) and its
        standard error where the alignment tells it. Channels of the quantity "other" stay in `recorded`.

    Raises
    ------
    StageError
        If no channel has a good sample, or the channels share no time.
    """
    warnings: list[str] = []
    records = _records(recorded, instructions, warnings)
    offsets = _offsets(records, instructions, warnings)
    records = {name: record for name, record in records.items() if instructions.channels[name][0] != "other"}
    if not records:
        raise StageError("No channel of this test has a usable sample; see the warnings of its ingest.")
    shifts = {name: offsets.get(instructions.channels[name][2], Offset(0.0, np.nan, 0.0)).seconds for name in records}
    clock = _common_clock(records, shifts, instructions)

    values, flags, attributes = {}, {}, {}
    for name, record in records.items():
        _, on, recorder = instructions.channels[name]
        cutoff = _cutoff(name, on, float(clock[1] - clock[0]), record.interval, instructions)
        smooth, noise = smoothed(record, cutoff, instructions.filter_order)
        values[name], flags[name] = on_clock(record, smooth, clock + shifts[name])
        attributes[name] = recorded[variable_name(name)].attrs | {
            "cutoff_hz": cutoff,
            "noise": noise,
            "clock_offset": shifts[name] + instructions.delays[name],
        }
        if recorder in offsets and offsets[recorder].rival is None:
            attributes[name]["clock_offset_standard_error"] = offsets[recorder].standard_error
        attributes[name].pop("quality_report", None)

    window = _rest(clock, values, attributes, instructions, warnings)
    variables: dict[str, Any] = {}
    for name in records:
        zeroed = _zeroed(clock, values[name], name, attributes[name], window, instructions, warnings)
        if zeroed is not None:
            variables[variable_name(name)] = ("elapsed", zeroed, attributes[name])
            variables[f"{variable_name(name)}_quality"] = ("elapsed", flags[name])
    return xr.Dataset(variables, coords={"elapsed": ("elapsed", clock)}, attrs={"warnings": warnings})


def _records(recorded: xr.Dataset, instructions: Instructions, warnings: list[str]) -> dict[str, Record]:
    """Channels on even clocks of their own, their delays taken off."""
    records = {}
    for name in instructions.channels:
        variable = recorded[variable_name(name)]
        stamps = recorded[str(variable.dims[0])].to_numpy() - instructions.delays[name]
        flags = recorded[f"{variable_name(name)}_quality"].to_numpy()
        try:
            records[name] = even_record(stamps, variable.to_numpy(), flags)
        except ValueError as error:
            warnings.append(f"channel {name} is left out: it {error}.")
    return records


def _offsets(records: dict[str, Record], instructions: Instructions, warnings: list[str]) -> dict[str, Offset]:
    """Delays of the recorders against the main one, where they are known."""
    offsets = {"main": Offset(0.0, 0.0, 1.0)}
    for recorder, (channel, own_channel, sign) in instructions.links.items():
        if channel not in records or own_channel not in records:
            warnings.append(f"recorder {recorder} could not be aligned, as {channel} or {own_channel} is not usable.")
            continue
        try:
            found = link(
                records[channel],
                records[own_channel],
                quantities=(instructions.channels[channel][0], instructions.channels[own_channel][0]),
                longest=instructions.longest_offset,
                sign=sign,
            )
        except ValueError as error:
            raise StageError(
                f"channels {channel} and {own_channel} {error}, as recorders are aligned on what both saw. "
                "Look at the times in their files."
            ) from error
        if found.is_determined:
            offsets[recorder] = found
        if found.doubt:
            state = "aligned" if found.is_determined else "taken to start with the main one"
            warnings.append(f"recorder {recorder} was {state} by {channel} and {own_channel}: {found.doubt}.")
    return offsets


def _common_clock(records: dict[str, Record], shifts: dict[str, float], instructions: Instructions) -> Array:
    """Clock of the main recorder over the stretch that all channels share."""
    start = max(record.time[0] - shifts[name] for name, record in records.items())
    stop = min(record.time[-1] - shifts[name] for name, record in records.items())
    of_main = [name for name in records if instructions.channels[name][2] == "main"]
    leading = min(of_main or records, key=lambda name: abs(instructions.delays[name]))
    rate = instructions.sampling_rate
    interval = records[leading].interval if isinstance(rate, str) else 1 / rate
    steps = np.ceil((start - records[leading].time[0]) / interval - 1e-6)
    clock = uniform_clock(records[leading].time[0] + steps * interval, stop, interval)
    if clock.size < 16:
        raise StageError(
            f"The channels share {max(stop - start, 0.0):.3g} s, {clock.size} samples; at least 16 were expected. "
            "Look at the start times of the recorders and at the test's `window`."
        )
    return clock


def _cutoff(name: str, on: str | None, interval: float, own_interval: float, instructions: Instructions) -> float:
    rate = 1 / max(interval, own_interval)
    wanted = instructions.lowpass if on == "specimen" else instructions.base_lowpass
    if isinstance(wanted, str):
        return default_lowpass(instructions.p, rate) if on == "specimen" else 0.2 * rate
    if wanted >= 0.5 * rate:
        key = "lowpass" if on == "specimen" else "base_lowpass"
        raise StageError(
            f"processing.{key} is {wanted:g} Hz; below {0.5 * rate:g} Hz, half the sampling rate of "
            f'channel {name}, was expected. Choose a lower one, or "auto".'
        )
    return wanted


def _rest(
    clock: Array,
    values: dict[str, Array],
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
    free = instructions.kind == "free-vibration"
    end = instructions.zero == "end" or (instructions.zero == "auto" and free)
    quantities = {name: instructions.channels[name][:2] for name in values}
    judged = [
        name
        for name, (quantity, on) in quantities.items()
        if quantity in ("displacement", "angle") or (quantity == "acceleration" and on == "table" and not free)
    ] or [name for name, (quantity, _) in quantities.items() if quantity == "acceleration"]
    noises = {name: (values[name], float(attributes[name]["noise"])) for name in judged}
    window = find_rest(clock, noises, end=end, duration=instructions.rest_duration)
    if not window.quiet:
        warnings.append(
            f"Zero was taken from {window.start:.3g} to {window.stop:.3g} s, but {window.reason}. Give the test a "
            '`zero` such as ["0 s", "0.5 s"] where specimen and table stood still.'
        )
    return window


def _zeroed(
    clock: Array,
    values: Array,
    name: str,
    attributes: dict[str, Any],
    window: RestWindow | None,
    instructions: Instructions,
    warnings: list[str],
) -> Array | None:
    """Take off a channel's rest value, noted in its attributes; forces keep theirs."""
    if window is None or instructions.channels[name][0] == "force":
        return values
    inside = (clock >= window.start) & (clock <= window.stop)
    if not inside.any():
        raise StageError(
            f"zero: no sample lies between {window.start:g} and {window.stop:g} s; the record goes from {clock[0]:.3g} "
            f"to {clock[-1]:.3g} s. Give a stretch inside it."
        )
    resting = values[inside][np.isfinite(values[inside])]
    if resting.size == 0:
        warnings.append(
            f"channel {name} is left out: it has no value from {window.start:.3g} to {window.stop:.3g} s, where its "
            "zero is taken. Give the test another `zero`."
        )
        return None
    attributes["zero"] = float(resting.mean())
    attributes["zero_window"] = f"{window.start:.6g} s to {window.stop:.6g} s"
    if window.quiet:
        attributes["noise"] = max(float(resting.std()), float(attributes["noise"]))
    return values - float(attributes["zero"])
