"""Faults of single samples and of whole channels."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from colonnade.arrays import Array
from faults.curves import pair, signals
from faults.fault import Fault, Group, Picture
from faults.planting import BOTTOM, TOP, both, channel_line, in_campaign, in_file, processing, review
from faults.sound import RATE

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
    struck = rng.choice(np.arange(600, samples.shape[0] - 100), 40, replace=False)
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
