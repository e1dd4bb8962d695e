"""Faults of what was recorded: clocks, lost samples, single samples and whole channels."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from faults.fault import (
    BOTTOM,
    TIME,
    TOP,
    Fault,
    Group,
    Picture,
    both,
    channel_line,
    in_campaign,
    in_file,
    processing,
    review,
    times,
)
from faults.pictures import ACCELERATION, ROTATION, delays, pair, rotations, signals, steps, table
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


READING = "reading of top, mm"
WINDOW = (4.0, 6.5)
STRETCH = slice(int(5.0 * RATE), int(5.8 * RATE))


def _dead(samples: Array) -> Array:
    samples[:, BOTTOM] = np.random.default_rng(0).normal(0, 0.005, samples.shape[0])
    return samples


def _clipped(samples: Array) -> Array:
    samples[:, TOP] = np.clip(samples[:, TOP], -0.9, 0.9)
    return samples


def _spikes(samples: Array) -> Array:
    rng = np.random.default_rng(0)
    struck = rng.choice(np.arange(600, samples.shape[0] - 100, 4), 40, replace=False)
    samples[struck, TOP] += rng.choice([-1, 1], struck.size) * rng.uniform(2.0, 5.0, struck.size)
    return samples


def _flat(samples: Array) -> Array:
    samples[STRETCH, TOP] = samples[STRETCH.start, TOP]
    return samples


def _empty(samples: Array) -> Array:
    samples[STRETCH, TOP] = np.nan
    return samples


def _renamed(folder: Path) -> None:
    path = folder / "raw" / "sine.csv"
    path.write_text(path.read_text(encoding="utf-8").replace("LVDT 1", "WA-50 left", 1), encoding="utf-8")


SAMPLES = Group(
    "samples",
    "Samples and channels",
    "Samples that cannot be are flagged, never changed: the recording stays as it was in `recorded.nc`, with a flag a "
    "sample. Spikes and missing samples are bridged by what is next to them; what is only doubtful is used.",
    (
        Fault(
            name="Dead channel",
            test="sine",
            happens="The core came off its rod, or a cable broke: the channel shows noise alone.",
            plant=in_file("sine.csv", _dead),
            message=r"channel bottom hardly moves \(.*\), although the rotation measured by top",
            picture=pair((2.5, 4.0), "With the fault, bottom stays at zero while top turns."),
            mend="Leave the channel out of this test. The angle then comes from the other one alone, and the report "
            "says so.",
            mending=review('[[exclude]]\ntest = "sine"\nchannel = "bottom"'),
        ),
        Fault(
            name="Clipped channel",
            test="sine",
            happens="The range of the recorder was too small for this test.",
            plant=both(in_file("sine.csv", _clipped), channel_line("rig", "top", 'range = "10 V"', 'range = "0.9 V"')),
            message=r"channel top: \d+ samples at the end of the range",
            picture=Picture(signals("top"), READING, (2.5, 4.0), "With the fault, the peaks are cut off."),
            mend="The peaks are lost on this channel. Leave it out if another one shows the rotation.",
            mending=review('[[exclude]]\ntest = "sine"\nchannel = "top"'),
            stays=True,
        ),
        Fault(
            name="Spikes",
            test="sine",
            happens="A loose contact, or a drive that switches next to the cable.",
            plant=in_file("sine.csv", _spikes),
            message="channel top: spikes on 40 samples, the first at",
            picture=Picture(signals("top"), READING, (4.0, 6.0), "With the fault, single samples stand out."),
            mend="Nothing has to be written: flagged samples are bridged. If a peak was taken for a spike, raise the "
            "threshold, here until none is flagged.",
            mending=processing("spike_threshold = 900"),
        ),
        Fault(
            name="Channel that hangs",
            test="sine",
            happens="The recorder repeated the last value for a while.",
            plant=in_file("sine.csv", _flat),
            message="channel top: 400 samples flat for more than 0.5 s, the first at 5 s",
            picture=Picture(signals("top"), READING, WINDOW, "With the fault, the reading stays the same."),
            mend="Flag the stretch as failed; it is then bridged, and the angle in it comes from the other transducer.",
            mending=review('[[flag]]\ntest = "sine"\nchannel = "top"\nwindow = ["4.99 s", "5.81 s"]\nas = "fail"'),
            stays=True,
        ),
        Fault(
            name="Cells without a number",
            test="sine",
            happens="The recorder wrote NaN where it had no value.",
            plant=in_file("sine.csv", _empty),
            message="channel top: 400 samples without a value, the first at 5 s",
            picture=Picture(signals("top"), READING, WINDOW, "With the fault, a stretch is empty."),
            mend="Nothing has to be written: NaN is the right way to say that a value is missing. But next to "
            "strong motion the peak may be among what is missing: read the samples from the recorder again, or repeat "
            "the test.",
        ),
        Fault(
            name="Misnamed column",
            test="sine",
            happens="The recorder's software was set up again, and a column got another name.",
            plant=_renamed,
            message=r'channel top: .*"LVDT 1"',
            picture=Picture(signals("bottom"), "reading of bottom, mm", WINDOW, "The recording is the same."),
            mend="Write the name as the file has it.",
            mending=in_campaign(r'(?s)(\[setups\.rig\.channels\].*?)"LVDT 1"', r'\g<1>"WA-50 left"'),
        ),
    ),
)
