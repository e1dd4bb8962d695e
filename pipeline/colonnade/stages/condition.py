"""Condition: recorded channels -> one uniform clock, de-spiked, low-pass filtered without delay, zeroed at rest."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Channel, Test
from colonnade.campaign.settings import ConditionSettings
from colonnade.errors import StageError
from colonnade.findings import Finding
from colonnade.signals.alignment import Offset
from colonnade.signals.filters import default_lowpass
from colonnade.signals.record import on_clock, smoothed
from colonnade.signals.rest import RestWindow, find_rest
from colonnade.stages.parts.clocks import (
    TOGETHER,
    ChannelOnClock,
    common_clock,
    cut_short,
    find_links,
    own_records,
    recorder_offsets,
)
from colonnade.stages.parts.plausibility import PlausibilityInputs, doubts, zero_effects
from colonnade.stages.parts.zeroing import find_zero_error, zeroed
from colonnade.store.description import variable_name
from colonnade.store.provenance import Inputs

if TYPE_CHECKING:
    import xarray as xr


class ConditionInputs(Inputs):
    """
    What `condition` reads of the campaign.

    Attributes
    ----------
    channels : dict of str to ChannelOnClock
        By channel id.
    links : dict
        Channels that link recorders to the main one, by recorder.
    settings : ConditionSettings
    p : float
        Of the specimen, rad/s.
    zero : str or (float, float)
        "auto", "start", "end", "none" or a stretch, s.
    plausibility : PlausibilityInputs
        What the conditioned channels are compared with.
    """

    channels: dict[str, ChannelOnClock]
    links: dict[str, tuple[str, str, float]]
    settings: ConditionSettings
    p: float
    free_vibration: bool
    zero: str | tuple[float, float]
    plausibility: PlausibilityInputs

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> ConditionInputs:
        """Gather what `condition` reads for one test."""
        setup, channels = campaign.setups[test.setup], campaign.channels(test)
        return cls(
            channels={
                name: ChannelOnClock.model_validate(channel, from_attributes=True).model_copy(
                    update={"resting": _resting(channel, campaign.gravity)}
                )
                for name, channel in channels.items()
            },
            links=find_links(setup.recorders, channels),
            settings=campaign.processing,
            p=campaign.block(test.specimen).p,
            free_vibration=test.kind == "free-vibration",
            zero=test.zero,
            plausibility=PlausibilityInputs.of(campaign, test),
        )


def condition(recorded: xr.Dataset, inputs: ConditionInputs) -> xr.Dataset:
    """
    Bring all channels to one clock, filter them and set their zero.

    Parameters
    ----------
    recorded : xr.Dataset
        Result of `ingest`.
    inputs : ConditionInputs

    Returns
    -------
    conditioned : xr.Dataset
        For each channel `<name>` (SI) and `<name>_quality` on `elapsed`. Attributes of `<name>`: `zero` (taken
        off, SI), `zero_window`, `noise` (standard deviation, SI), `cutoff_hz`, `clock_offset` (taken off, s) with its
        standard error, and `clock_rate_ppm` with its own where the clocks drift apart: the offset is then that at
        `clock_offset_at` (s). Channels of the quantity "other" stay in `recorded`.

    Notes
    -----
    At rest the upright specimen neither moves nor turns, so that there all channels become zero (a gyroscope's value is
    its bias), but for accelerometers on the specimen: they sense gravity and become its part along their axis.

    Raises
    ------
    StageError
        If no channel has a good sample, or the channels share no time.
    """
    import xarray as xr

    warnings: list[Finding] = []
    channels = inputs.channels
    records = own_records(recorded, channels, warnings)
    known = recorder_offsets(records, channels, inputs.links, inputs.settings.longest_offset, warnings)
    records = {name: record for name, record in records.items() if channels[name].quantity != "other"}
    if not records:
        raise StageError("No channel of this test has a usable sample; see the warnings of the stage ingest.")
    offsets = {name: known.get(channels[name].recorder, TOGETHER) for name in records}
    clock = common_clock(records, offsets, channels, inputs.settings.sampling_rate)

    cutoffs = {name: _cutoff(name, float(clock[1] - clock[0]), records[name].interval, inputs) for name in records}
    smooth = {name: smoothed(records[name], cutoffs[name], inputs.settings.filter_order) for name in records}
    warnings += cut_short(records, offsets, channels, smooth, clock)
    values, flags, attributes = {}, {}, {}
    for name, record in records.items():
        values[name], flags[name] = on_clock(record, smooth[name][0], clock + offsets[name].at(clock))
        attributes[name] = recorded[variable_name(name)].attrs | {
            "cutoff_hz": cutoffs[name],
            "noise": smooth[name][1],
            **_clock_attributes(offsets[name], channels[name].delay),
        }
        attributes[name].pop("quality_report", None)

    window = _rest_window(clock, values, {name: attributes[name]["noise"] for name in values}, inputs, warnings)
    variables: dict[str, Any] = {}
    for name in records:
        true: Array | None = values[name]
        if window is not None and channels[name].quantity != "force":
            true = zeroed(clock, values[name], name, attributes[name], window, channels[name].resting, warnings)
        if true is not None:
            variables[variable_name(name)] = ("elapsed", true, attributes[name])
            variables[f"{variable_name(name)}_quality"] = ("elapsed", flags[name])
    conditioned = xr.Dataset(variables, coords={"elapsed": ("elapsed", clock)})
    return conditioned.assign_attrs(warnings=warnings + doubts(conditioned, inputs.plausibility))


def _rest_window(
    clock: Array,
    values: Mapping[str, Array],
    noises: Mapping[str, float],
    inputs: ConditionInputs,
    warnings: list[Finding],
) -> RestWindow | None:
    """
    Find where the specimen is at its true rest: of a free vibration at the end, of all others at the start.

    None if no zero is wanted. How far the zero may be off is added to the warnings, where that matters.
    """
    if inputs.zero == "none":
        return None
    if not isinstance(inputs.zero, str):
        return RestWindow(*inputs.zero, quiet=True)
    is_free = inputs.free_vibration
    end = inputs.zero == "end" or (inputs.zero == "auto" and is_free)
    # Positions and the table show whether all stands still, or else the transducers on the specimen.
    own = {name: inputs.channels[name] for name in values}
    steady = [
        name
        for name, channel in own.items()
        if channel.quantity in ("displacement", "angle")
        or (channel.quantity == "acceleration" and channel.on == "table" and not is_free)
    ]
    moving = [name for name, channel in own.items() if channel.quantity in ("acceleration", "angular_velocity")]
    shown = {name: (values[name], float(noises[name])) for name in steady or moving}
    window = find_rest(clock, shown, end=end, duration=inputs.settings.rest_duration)
    if not window.quiet:
        effects = zero_effects(inputs.plausibility)
        known = {name: effects[variable_name(name)] for name in values if variable_name(name) in effects}
        warnings += find_zero_error(clock, values, known, window)
    return window


def _resting(channel: Channel, gravity: float) -> float:
    """What a channel shows at rest on the upright specimen, SI."""
    senses_gravity = channel.quantity == "acceleration" and channel.on == "specimen" and channel.direction is not None
    return gravity * channel.direction[2] if senses_gravity and channel.direction else 0.0


def _clock_attributes(offset: Offset, delay: float) -> dict[str, float]:
    """What was subtracted from a channel's times, and how well it is known."""
    known = {"clock_offset": offset.seconds + delay}
    if np.isfinite(offset.standard_error):
        known["clock_offset_standard_error"] = offset.standard_error
    if offset.drift is not None:
        known |= {
            "clock_offset_at": offset.drift.middle,
            "clock_rate_ppm": 1e6 * offset.drift.rate,
            "clock_rate_standard_error_ppm": 1e6 * offset.drift.standard_error,
        }
    return known


def _cutoff(name: str, interval: float, own_interval: float, inputs: ConditionInputs) -> float:
    rate, on = 1 / max(interval, own_interval), inputs.channels[name].on
    wanted = inputs.settings.lowpass if on == "specimen" else inputs.settings.base_lowpass
    if isinstance(wanted, str):
        return default_lowpass(inputs.p, rate) if on == "specimen" else 0.2 * rate
    if wanted >= 0.5 * rate:
        key = "lowpass" if on == "specimen" else "base_lowpass"
        raise StageError(
            f"processing.{key} is {wanted:g} Hz; below {0.5 * rate:g} Hz, half the sampling rate of "
            f'channel {name}, was expected. Choose a lower one, or "auto".'
        )
    return wanted
