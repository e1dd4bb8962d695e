"""Faults of time: clocks, recorders and lost samples."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array
from faults.curves import ACCELERATION, ROTATION, delays, rotations, steps, table
from faults.fault import Fault, Group, Picture
from faults.planting import TIME, both, in_file, processing, times
from faults.sound import RATE, SECOND_RATE


def _jitter(samples: Array) -> Array:
    samples[:, TIME] += np.random.default_rng(0).uniform(-4e-4, 4e-4, samples.shape[0])
    return samples


def _started_late(samples: Array) -> Array:
    late = samples[int(1.3 * SECOND_RATE) :].copy()
    late[:, TIME] -= late[0, TIME]
    return late


def _lost(samples: Array) -> Array:
    return np.delete(samples, slice(int(6.0 * RATE), int(6.4 * RATE)), axis=0)


ACROSS, STEP = "time in the file, s", "step of the clock, ms"

CLOCKS = Group(
    "clocks",
    "Clocks and recorders",
    "Rocking has a time of its own: how long an arc lasts follows from p and its height. A wrong clock is therefore "
    "seen without a second one, and two recorders are put together by what both recorded.",
    (
        Fault(
            name="Clock jitter",
            test="sine",
            happens="The time stamps are those of a computer that was busy with other things.",
            plant=in_file("sine.csv", _jitter),
            message=r"samples up to 0\.\d+ ms off an even clock of (2|1\.9999\d*|2\.0000\d*) ms",
            picture=Picture(steps("sine.csv"), STEP, (4.0, 4.2), "With the fault, no two steps are equal.", ACROSS),
            mend="Nothing has to be written: samples are used at the times that the file gives. If the recorder's own "
            "clock is even, leave its time column out and give the `sampling_rate`.",
        ),
        Fault(
            name="Clock that runs fast",
            test="quake",
            happens="Two recorders without a common clock: one of them runs 600 ppm fast.",
            plant=in_file("quake-daq2.csv", times(TIME, 1 + 600e-6)),
            message=r"recorder daq2: its clock runs \d+ ± \d+ ppm fast against the main recorder's",
            picture=Picture(
                delays,
                "delay of the second recorder, ms",
                (2.0, 9.0),
                "Without the fault, the delay stays near 20 ms; with it, it changes by 0.6 ms every second.",
                ACROSS,
            ),
            mend="Nothing has to be written: it was corrected. A common sampling clock or trigger line avoids it.",
        ),
        Fault(
            name="Late recorder",
            test="quake",
            happens="The second recorder was started by hand, more than a second after the first.",
            plant=in_file("quake-daq2.csv", _started_late),
            message=r"agree better at -1[23]\d\d ms, beyond the range searched; .* processing.longest_offset",
            picture=Picture(
                table, ACCELERATION, (4.0, 6.0), "With the fault, the accelerometer is 1.3 s early.", ACROSS
            ),
            mend="Allow a longer delay.",
            mending=processing('longest_offset = "2 s"'),
        ),
        Fault(
            name="Lost samples",
            test="sine",
            happens="The recorder's buffer ran over, and 200 samples were not written.",
            plant=in_file("sine.csv", _lost),
            message="1 gap in time, about 200 samples lost",
            picture=Picture(steps("sine.csv"), STEP, (5.8, 6.6), "With the fault, one step is 0.4 s long.", ACROSS),
            mend="What was not recorded cannot be mended. Results bridge the gap and say where it is. If it is at the "
            "end of the test, a `[[trim]]` in review.toml keeps what is before it; next to strong motion the peak "
            "may be lost, and the test has to be repeated.",
        ),
        Fault(
            name="Wrong sampling rate",
            test="quake",
            happens="The clock of the file was made with 250 Hz, but the recorder ran at 500 Hz.",
            plant=both(in_file("quake.csv", times(TIME, 2.0)), in_file("quake-daq2.csv", times(TIME, 2.0))),
            message=r"channels top and bottom all show 0\.\d+ times the rotation .*: a sampling rate × 2 \(",
            picture=Picture(
                rotations("top", "bottom"),
                ROTATION,
                (5.0, 9.0),
                "With the fault, the block seems to rock half as fast as its size allows.",
                ACROSS,
            ),
            mend="Correct the clock where the file was made. If the file has no time column, correct `sampling_rate` "
            "of the set-up.",
        ),
    ),
)
