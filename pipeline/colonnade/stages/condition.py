"""Condition: recorded channels -> one uniform clock, de-spiked, low-pass filtered without delay, zeroed at rest."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from colonnade.arrays import Array, Dataset, dataset
from colonnade.campaign import Campaign, Channel, Test
from colonnade.campaign.settings import ConditionSettings
from colonnade.campaign.setup import Align
from colonnade.errors import StageError, count
from colonnade.findings import Finding, note, serious, warning
from colonnade.identification.plausibility.scale import as_expected
from colonnade.signals.alignment import Offset, link
from colonnade.signals.filters import default_lowpass
from colonnade.signals.record import Record, even_record, on_clock, smoothed
from colonnade.signals.rest import RestWindow, find_rest
from colonnade.signals.timing import uniform_clock
from colonnade.stages.parts.plausibility import PlausibilityInputs, doubts
from colonnade.stages.parts.reference_motions import reference_files
from colonnade.stages.parts.transducers import outline
from colonnade.store.description import variable_name

TOGETHER = Offset(0.0, np.nan, 0.0)
"""A recorder that starts with the main one."""

FEWEST_SAMPLES = 16
"""That the channels of a test have to share."""

HIGHEST_RATE = 5000.0
"""Hz, of the one clock of a test if no other is asked for: a hundred times what rocking needs."""

MOST_SAMPLES = 20_000_000
"""Of a test on its one clock, if fewer than half as many were recorded."""

SENSES_GRAVITY = 7.0
"""m/s², that gravity's part along an accelerometer has to have before its value at rest is judged."""


class ConditionInputs(PlausibilityInputs):
    """
    What `condition` reads of the campaign.

    Attributes
    ----------
    links : dict
        By recorder: a channel of the main recorder, and its own, which link it to the main one.
    settings : ConditionSettings
    zero : str or (float, float)
        "auto", "start", "end", "none" or a stretch, s.
    """

    links: dict[str, tuple[str, str]]
    settings: ConditionSettings
    free_vibration: bool
    zero: str | tuple[float, float]

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> ConditionInputs:
        """Gather what `condition` reads for one test."""
        specimen, channels = campaign.specimens[test.specimen], campaign.channels(test)
        block, recorders = specimen.block(campaign.gravity), campaign.setups[test.setup].recorders
        aligned = {name: each.clock.align for name, each in recorders.items() if isinstance(each.clock, Align)}
        return cls(
            block=block,
            outline=outline(specimen, block),
            channels=channels,
            motion=test.motion,
            time_scale=test.time_scale,
            references=reference_files(campaign) if test.motion else {},
            links={name: link for name, link in aligned.items() if channels.keys() >= set(link)},
            settings=campaign.processing,
            free_vibration=test.kind == "free-vibration",
            zero=test.zero,
        )


def condition(recorded: Dataset, inputs: ConditionInputs) -> Dataset:
    """
    Bring all channels to one clock, filter them and set their zero.

    Parameters
    ----------
    recorded : Dataset
        Result of `ingest`.
    inputs : ConditionInputs

    Returns
    -------
    conditioned : Dataset
        For each channel `<name>` (SI) and `<name>_quality` on `elapsed`. Attributes of `<name>`: `zero` (taken
        off, SI), `zero_window`, `noise` (standard deviation, SI), `cutoff_hz`, `clock_offset` (taken off, s) with its
        standard error, and `clock_rate_ppm` with its own where the clocks drift apart: the offset is then that at
        `clock_offset_at` (s). Channels of the quantity "other" stay in `recorded`. The attribute `restless_zero` gives
        the stretch (s) where the zero was taken though something moves.

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
    values, flags, attributes = {}, {}, {}
    for name, record in records.items():
        values[name], flags[name] = on_clock(record, smooth[name][0], clock + offsets[name].at(clock))
        attributes[name] = recorded[variable_name(name)].attrs | {
            "cutoff_hz": cutoffs[name],
            "noise": smooth[name][1],
            **_clock_attributes(offsets[name], channels[name].delay),
        }
        attributes[name].pop("quality_report", None)

    window = _rest_window(clock, values, {name: attributes[name]["noise"] for name in values}, inputs)
    variables: dict[str, Any] = {}
    for name in records:
        told = attributes[name]
        if window is not None and channels[name].quantity != "force":
            inside = (clock >= window.start) & (clock <= window.stop)
            still = values[name][inside & np.isfinite(values[name])]
            if not still.size:
                text = (
                    f"channel {name} is left out: it has no value from {window.start:.3g} to {window.stop:.3g} s, "
                    "where the zero is taken. Give the test another `zero`."
                )
                warnings.append(serious("channel left out", text))
                continue
            shown, resting = float(still.mean()), _resting(channels[name], inputs.block.gravity)
            warnings += _of_gravity(name, shown, resting)
            told |= {"zero": shown - resting, "zero_window": f"{window.start:.6g} s to {window.stop:.6g} s"}
            if window.quiet:
                told["noise"] = max(float(still.std()), float(told["noise"]))
            values[name] = values[name] - told["zero"]
        variables[variable_name(name)] = ("elapsed", values[name], told)
        variables[f"{variable_name(name)}_quality"] = ("elapsed", flags[name])
    conditioned = dataset(variables, coords={"elapsed": ("elapsed", clock)})
    if window is not None and not window.quiet:
        conditioned.attrs["restless_zero"] = [window.start, window.stop]
    return conditioned.assign_attrs(warnings=warnings + doubts(conditioned, inputs))


def own_records(recorded: Dataset, channels: Mapping[str, Channel], warnings: list[Finding]) -> dict[str, Record]:
    """Put each channel on an even clock of its own, without its delay; unusable ones are left out and reported."""
    records = {}
    for name, channel in channels.items():
        variable = recorded[variable_name(name)]
        stamps = recorded[str(variable.dims[0])].to_numpy() - channel.delay
        flags = recorded[f"{variable_name(name)}_quality"].to_numpy()
        try:
            records[name] = even_record(stamps, variable.to_numpy(), flags)
        except ValueError as error:
            warnings.append(serious("channel left out", f"channel {name} is left out: it {error}."))
    return records


def recorder_offsets(
    records: Mapping[str, Record],
    channels: Mapping[str, Channel],
    links: Mapping[str, tuple[str, str]],
    longest: float,
    warnings: list[Finding],
) -> dict[str, Offset]:
    """Find the delays of the recorders relative to the main one, if they can be found; none `longest` (s) or more."""
    offsets = {"main": Offset(0.0, 0.0, 1.0)}
    for recorder, (channel, own_channel) in links.items():
        found, doubt = TOGETHER, f"{channel} or {own_channel} is not usable"
        if channel in records and own_channel in records:
            one, other = channels[channel], channels[own_channel]
            against = one.direction and other.direction and np.dot(one.direction, other.direction) < 0
            try:
                found = link(
                    records[channel],
                    records[own_channel],
                    quantities=(one.quantity, other.quantity),
                    longest=longest,
                    sign=-1.0 if against else 1.0,
                )
            except ValueError as error:
                raise StageError(
                    f"channels {channel} and {own_channel} {error}, but recorders are aligned on what both recorded. "
                    "Check the times in their files."
                ) from error
            doubt = found.doubt
        if found.is_determined:
            offsets[recorder] = found
        if doubt:
            weight, state = (
                (warning, "aligned") if found.is_determined else (serious, "assumed to start with the main one")
            )
            text = f"recorder {recorder} was {state} with {channel} and {own_channel}: {doubt}."
            # Records that agree at a longer delay are of one motion: that they differ here follows from the delay.
            kind, others = ("clock", ("table motion",)) if found.beyond is None else ("late recorder", ())
            follows = ("dead channel", "channel left out", "gain", "sign", *others)
            warnings.append(weight(kind, text, follows=follows))
        if found.drift is not None:
            text = (
                f"recorder {recorder}: its clock runs {found.drift} against the main recorder's, by {channel} and "
                f"{own_channel}; the delay changes by {1e3 * abs(found.drift.change):.2g} ms over the motion. This was "
                "corrected. A common sampling clock or trigger line avoids this."
            )
            warnings.append(note("clock drift", text))
    return offsets


def common_clock(
    records: Mapping[str, Record],
    offsets: Mapping[str, Offset],
    channels: Mapping[str, Channel],
    rate: float | str,
) -> Array:
    """
    Clock of the main recorder's fastest channel, up to `HIGHEST_RATE`, over the stretch that all channels share.

    Records, delays and what is known are by channel; `rate` in Hz or "auto".
    """
    start = max(_on_main(record.time[0], offsets[name]) for name, record in records.items())
    stop = min(_on_main(record.time[-1], offsets[name]) for name, record in records.items())
    of_main = [record for name, record in records.items() if channels[name].recorder == "main"]
    leader = min(of_main or records.values(), key=lambda record: record.interval)
    # A rate that was recorded comes through its interval a little off.
    is_faster = leader.interval < 0.999 / HIGHEST_RATE
    interval = 1 / rate if not isinstance(rate, str) else 1 / HIGHEST_RATE if is_faster else leader.interval
    samples, most = (stop - start) / interval, max(MOST_SAMPLES, 2 * leader.time.size)
    if samples > most:
        raise StageError(
            f"At {1 / interval:.4g} Hz the {stop - start:.4g} s of this test are {samples:.3g} samples; at most "
            f"{most:.3g} were expected. It was recorded at {1 / leader.interval:.4g} Hz: see `sampling_rate`."
        )
    steps = np.ceil((start - leader.time[0]) / interval - 1e-6)
    clock = uniform_clock(leader.time[0] + steps * interval, stop, interval)
    if clock.size < FEWEST_SAMPLES:
        raise StageError(
            f"The channels share {max(stop - start, 0.0):.3g} s, {count(clock.size, 'sample')}; at least "
            f"{FEWEST_SAMPLES} were expected. Check the start times of the recorders and the test's `window`."
        )
    return clock


def _on_main(time: float, offset: Offset) -> float:
    """Time of the main recorder at a recorder's own time, s; the delay changes too little to be solved for."""
    return time - float(offset.at(np.asarray(time - offset.seconds)))


def _rest_window(
    clock: Array,
    values: Mapping[str, Array],
    noises: Mapping[str, float],
    inputs: ConditionInputs,
) -> RestWindow | None:
    """
    Find where the specimen is at its true rest: of a free vibration at the end, of all others at the start.

    None if no zero is wanted.
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
    return find_rest(clock, shown, end=end, duration=inputs.settings.rest_duration)


def _of_gravity(name: str, shown: float, resting: float) -> list[Finding]:
    """Doubt an accelerometer on the specimen by what it shows of gravity at rest, m/s²."""
    if abs(resting) < SENSES_GRAVITY or (shown / resting > 0 and as_expected(shown / resting)):
        return []
    text = (
        f"Channel {name} shows {shown:.3g} m/s² at rest, but gravity's part along it is {resting:.3g} m/s², which it "
        "is given: its sign, gain or unit is wrong, it was zeroed in the recorder, or sensor or amplifier block "
        "constant values (AC)."
    )
    return [warning("gravity", text)]


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
        return default_lowpass(inputs.block.p, rate) if on == "specimen" else 0.2 * rate
    if wanted >= 0.5 * rate:
        key = "lowpass" if on == "specimen" else "base_lowpass"
        raise StageError(
            f"processing.{key} is {wanted:g} Hz; below {0.5 * rate:g} Hz, half the sampling rate of "
            f'channel {name}, was expected. Choose a lower one, or "auto".'
        )
    return wanted
