"""Clocks of a test: its channels on even clocks of their own, and how late and how fast each recorder is."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Channel
from colonnade.campaign.setup import Align, Recorder
from colonnade.errors import StageError, count
from colonnade.findings import Finding, note, serious, warning
from colonnade.signals.alignment import Offset, link
from colonnade.signals.record import Record, even_record
from colonnade.signals.timing import uniform_clock
from colonnade.store.description import variable_name
from colonnade.store.provenance import Inputs

if TYPE_CHECKING:
    import xarray as xr

TOGETHER = Offset(0.0, np.nan, 0.0)
"""A recorder that starts with the main one."""

FEWEST_SAMPLES = 16
"""That the channels of a test have to share."""

HIGHEST_RATE = 5000.0
"""Hz, of the one clock of a test if no other is asked for: a hundred times what rocking needs."""

MOST_SAMPLES = 20_000_000
"""Of a test on its one clock, where fewer than half as many were recorded."""


LEAST_CUT = 0.3
"""s, by which the records of a test may differ in length without a word, and in which a motion at their ends shows."""

MOVES = 6.0
"""Times its noise, from which on a record moves, ..."""

LEAST_MOTION = 0.01
"""... if that is more than this of all that it moves."""


class ChannelOnClock(Inputs):
    """
    What is known of a channel before it is conditioned.

    Attributes
    ----------
    quantity : str
    on : str or None
        "specimen", "table" or "ground".
    recorder : str
    delay : float
        s.
    resting : float
        What it shows at rest on the upright specimen, SI: gravity's part along an accelerometer, 0 for all else.
    """

    quantity: str
    on: str | None
    recorder: str
    delay: float = 0.0
    resting: float = 0.0


Links = Mapping[str, tuple[str, str, float]]
"""
By recorder: its link to the main one, (channel of the main recorder, own channel, sign).

The sign is -1 if the two point against each other. A recorder without a link starts with the main one.
"""


def find_links(recorders: Mapping[str, Recorder], channels: Mapping[str, Channel]) -> dict[str, tuple[str, str, float]]:
    """Find the channels of a test that link its recorders to the main one."""
    links = {}
    for name, recorder in recorders.items():
        if isinstance(recorder.clock, Align) and all(linked in channels for linked in recorder.clock.align):
            main, own = recorder.clock.align
            one, other = channels[main].direction, channels[own].direction
            against = one is not None and other is not None and float(np.dot(one, other)) < 0
            links[name] = main, own, -1.0 if against else 1.0
    return links


def own_records(
    recorded: xr.Dataset, channels: Mapping[str, ChannelOnClock], warnings: list[Finding]
) -> dict[str, Record]:
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
    channels: Mapping[str, ChannelOnClock],
    links: Links,
    longest: float,
    warnings: list[Finding],
) -> dict[str, Offset]:
    """Find the delays of the recorders relative to the main one, if they can be found; none `longest` (s) or more."""
    offsets = {"main": Offset(0.0, 0.0, 1.0)}
    for recorder, (channel, own_channel, sign) in links.items():
        if channel not in records or own_channel not in records:
            reason = f"recorder {recorder} could not be aligned because {channel} or {own_channel} is not usable."
            warnings.append(serious("clock", reason, follows=("dead channel", "channel left out")))
            continue
        try:
            found = link(
                records[channel],
                records[own_channel],
                quantities=(channels[channel].quantity, channels[own_channel].quantity),
                longest=longest,
                sign=sign,
            )
        except ValueError as error:
            raise StageError(
                f"channels {channel} and {own_channel} {error}, but recorders are aligned on what both recorded. "
                "Check the times in their files."
            ) from error
        if found.is_determined:
            offsets[recorder] = found
        if found.doubt:
            state = "aligned" if found.is_determined else "assumed to start with the main one"
            weight = warning if found.is_determined else serious
            doubt = f"recorder {recorder} was {state} with {channel} and {own_channel}: {found.doubt}."
            # Records that agree at a longer delay are of one motion: that they differ here follows from the delay.
            kind, others = ("clock", ("table motion",)) if found.beyond is None else ("late recorder", ())
            warnings.append(weight(kind, doubt, follows=("dead channel", "gain", "sign", *others)))
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
    channels: Mapping[str, ChannelOnClock],
    rate: float | str,
) -> Array:
    """
    Clock of the main recorder's fastest channel, up to `HIGHEST_RATE`, over the stretch that all channels share.

    Records, delays and what is known are by channel; `rate` in Hz or "auto". A rate that gives far more samples than
    were recorded, and would only fill the memory, is refused.
    """
    start = max(_on_main(record.time[0], offsets[name]) for name, record in records.items())
    stop = min(_on_main(record.time[-1], offsets[name]) for name, record in records.items())
    of_main = [name for name in records if channels[name].recorder == "main"]
    shortest = min(records[name].interval for name in of_main or records)
    fastest = [name for name in of_main or records if records[name].interval < 1.01 * shortest]
    leader = records[min(fastest, key=lambda name: abs(channels[name].delay))]
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


def cut_short(
    records: Mapping[str, Record],
    offsets: Mapping[str, Offset],
    channels: Mapping[str, ChannelOnClock],
    smooth: Mapping[str, tuple[Array, float]],
    clock: Array,
) -> list[Finding]:
    """
    Say that a recorder begins late or ends early while something moves that another one shows.

    `records`, `offsets` and `channels` are as of `common_clock`; `smooth` has the values of each on its own clock
    and the standard deviation of their noise, SI; `clock` is what the channels share, s.
    """
    found = []
    for edge, place, sign, words in ((clock[0], 0, -1.0, "begins only at"), (clock[-1], -1, 1.0, "ends already at")):
        reach = {name: sign * (_on_main(record.time[place], offsets[name]) - edge) for name, record in records.items()}
        shortest, longest = min(reach, key=lambda name: reach[name]), max(reach, key=lambda name: reach[name])
        moving = []
        for name, record in records.items():
            beyond = sign * (record.time - edge - float(offsets[name].at(np.asarray(edge))))
            values, noise = smooth[name]
            shown = values[(beyond >= -LEAST_CUT) & (beyond <= max(reach[name], 0.0))]
            if shown.size >= FEWEST_SAMPLES and shown.std() > max(MOVES * noise, LEAST_MOTION * np.ptp(values)):
                moving.append(name)
        if reach[longest] > LEAST_CUT and moving:
            text = (
                f"Recorder {channels[shortest].recorder} {words} {edge:.4g} s, in the motion of {', '.join(moving)}; "
                f"recorder {channels[longest].recorder} has {reach[longest]:.3g} s more, which are not used. The peak "
                f"and the end may be missing: {channels[shortest].recorder}'s file was cut, or it was stopped too "
                "early. Find the whole file, or repeat the test."
            )
            found.append(serious("cut record", text, follows=("table motion",)))
    return found


def _on_main(time: float, offset: Offset) -> float:
    """Time of the main recorder at a recorder's own time, s; the delay changes too little to be solved for."""
    return time - float(offset.at(np.asarray(time - offset.seconds)))
