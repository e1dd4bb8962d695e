"""Condition: recorded channels -> one uniform clock, de-spiked, low-passed without delay, zeroed at rest."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from colonnade.campaign import Campaign, Test
from colonnade.errors import StageError
from colonnade.findings import Finding
from colonnade.signals.alignment import Offset
from colonnade.signals.filters import default_lowpass
from colonnade.signals.record import on_clock, smoothed
from colonnade.stages.clocks import TOGETHER, ClockInstructions, common_clock, links, own_records, recorder_offsets
from colonnade.stages.plausibility import PlausibilityInstructions, doubts, zero_effects
from colonnade.stages.plausibility import instructions as plausibility_instructions
from colonnade.stages.zeroing import rest_window, zeroed
from colonnade.store.description import variable_name

Array = NDArray[np.float64]


class Instructions(BaseModel):
    """
    What this stage reads of the campaign.

    Attributes
    ----------
    channels : dict of str to (quantity, on, recorder)
        By channel id.
    clocks : ClockInstructions
        Delays of channels and recorders.
    sampling_rate, lowpass, base_lowpass : float or "auto"
        Hz.
    p : float
        Of the specimen, rad/s.
    zero : str or (float, float)
        "auto", "start", "end", "none" or a stretch, s.
    resting : dict of str to float
        By channel id, what accelerometers on the upright specimen show at rest: gravity's part along them, m/s².
    plausibility : PlausibilityInstructions
        What the conditioned channels are held against.
    """

    model_config = ConfigDict(frozen=True)

    channels: dict[str, tuple[str, str | None, str]]
    clocks: ClockInstructions
    sampling_rate: float | str
    lowpass: float | str
    base_lowpass: float | str
    filter_order: int
    p: float
    kind: str
    zero: str | tuple[float, float]
    rest_duration: float
    resting: dict[str, float]
    plausibility: PlausibilityInstructions


def instructions(campaign: Campaign, test: Test) -> Instructions:
    """Gather what `condition` reads for one test."""
    setup, settings, channels = campaign.setups[test.setup], campaign.processing, campaign.channels(test)
    return Instructions(
        channels={name: (channel.quantity, channel.on, channel.recorder) for name, channel in channels.items()},
        clocks=ClockInstructions(
            delays={name: channel.delay for name, channel in channels.items()},
            links=links(setup.recorders, channels),
            longest_offset=settings.longest_offset,
        ),
        sampling_rate=settings.sampling_rate,
        lowpass=settings.lowpass,
        base_lowpass=settings.base_lowpass,
        filter_order=settings.filter_order,
        p=campaign.specimens[test.specimen].block(campaign.gravity).p,
        kind=test.kind,
        zero=test.zero,
        rest_duration=settings.rest_duration,
        resting={
            name: campaign.gravity * channel.direction[2]
            for name, channel in channels.items()
            if channel.quantity == "acceleration" and channel.on == "specimen" and channel.direction
        },
        plausibility=plausibility_instructions(campaign, test),
    )


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
    warnings: list[Finding] = []
    records = own_records(recorded, instructions.clocks, warnings)
    quantities = {name: quantity for name, (quantity, _, _) in instructions.channels.items()}
    recorders = {name: recorder for name, (_, _, recorder) in instructions.channels.items()}
    known = recorder_offsets(records, quantities, instructions.clocks, warnings)
    records = {name: record for name, record in records.items() if quantities[name] != "other"}
    if not records:
        raise StageError("No channel of this test has a usable sample; see the warnings of its ingest.")
    offsets = {name: known.get(recorders[name], TOGETHER) for name in records}
    clock = common_clock(records, offsets, recorders, instructions.clocks.delays, instructions.sampling_rate)

    values, flags, attributes = {}, {}, {}
    for name, record in records.items():
        cutoff = _cutoff(name, float(clock[1] - clock[0]), record.interval, instructions)
        smooth, noise = smoothed(record, cutoff, instructions.filter_order)
        values[name], flags[name] = on_clock(record, smooth, clock + offsets[name].at(clock))
        attributes[name] = recorded[variable_name(name)].attrs | {
            "cutoff_hz": cutoff,
            "noise": noise,
            **_clock_attributes(offsets[name], instructions.clocks.delays[name]),
        }
        attributes[name].pop("quality_report", None)

    effects = zero_effects(instructions.plausibility)
    window = rest_window(
        clock,
        values,
        attributes,
        instructions.channels,
        zero=instructions.zero,
        free_vibration=instructions.kind == "free-vibration",
        duration=instructions.rest_duration,
        effects={
            name: effects[variable_name(name)] for name in instructions.channels if variable_name(name) in effects
        },
        warnings=warnings,
    )
    variables: dict[str, Any] = {}
    for name in records:
        true: Array | None = values[name]
        if window is not None and quantities[name] != "force":
            resting = instructions.resting.get(name, 0.0)
            true = zeroed(clock, values[name], name, attributes[name], window, resting, warnings)
        if true is not None:
            variables[variable_name(name)] = ("elapsed", true, attributes[name])
            variables[f"{variable_name(name)}_quality"] = ("elapsed", flags[name])
    conditioned = xr.Dataset(variables, coords={"elapsed": ("elapsed", clock)})
    return conditioned.assign_attrs(warnings=warnings + doubts(conditioned, instructions.plausibility))


def _clock_attributes(offset: Offset, delay: float) -> dict[str, float]:
    """What was taken off a channel's times, and how well it is known."""
    told = {"clock_offset": offset.seconds + delay}
    if offset.rival is None and np.isfinite(offset.standard_error):
        told["clock_offset_standard_error"] = offset.standard_error
    if offset.drift is not None:
        told |= {
            "clock_offset_at": offset.drift.middle,
            "clock_rate_ppm": 1e6 * offset.drift.rate,
            "clock_rate_standard_error_ppm": 1e6 * offset.drift.standard_error,
        }
    return told


def _cutoff(name: str, interval: float, own_interval: float, instructions: Instructions) -> float:
    rate, on = 1 / max(interval, own_interval), instructions.channels[name][1]
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
