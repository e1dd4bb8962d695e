"""A small virtual campaign with all that a report can meet, and its results from one real run."""

from pathlib import Path

import numpy as np
from scipy.signal import butter, sosfiltfilt

from colonnade.campaign import load
from colonnade.campaign.channel import MAIN
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.plan import Plan, Recorder, Trial
from colonnade.laboratory.runs import write
from colonnade.laboratory.table import ramped_sine, recorded, still
from colonnade.workflow import run
from prism import PRISM

MARKUP = '<img src=x onerror="alert(1)"> & 5 < 6'
STRONG = "sine-3hz-too-strong-for-the-block-1"
LATER = "later"
HEAD = Path(__file__).with_name("small_campaign.toml")
REVIEW = f"""
schema = 1

[[flag]]
test = "span-2.5"
channel = "top"
window = ["6.0 s", "6.1 s"]
as = "suspect"
who = "N. N."
when = 2013-04-26
why = '{MARKUP}'
"""


def _shaking(strength):
    time = np.arange(1200) / 200.0
    noise = np.random.default_rng(7).normal(size=time.size)
    shaking = sosfiltfilt(butter(2, [1, 8], "bandpass", fs=200, output="sos"), noise)
    shaking *= np.clip(time / 1.0, 0, 1) * np.exp(-np.clip(time - 3, 0, None) / 0.6)
    return recorded(Motion(strength * shaking / np.abs(shaking).max(), 1 / 200.0), start=1.0)


def _plan():
    free = [
        Trial(
            name,
            "free-vibration",
            "frame",
            9.0,
            theta0=share * PRISM.critical_angle,
            release=1.0,
            table=table,
        )
        for name, share, table in (("free-01", 0.5, still()), ("free-refused", 0.45, _shaking(0.15)))
    ]
    spans = [
        Trial(
            f"span-{span}",
            "earthquake",
            "frame",
            6.5,
            table=_shaking(1.35 * span),
            spikes=3 if span == 2.0 else 0,
            entry={"span": span, "motion": f"El Centro 1940 NS {MARKUP}", "time_scale": 0.2236},
        )
        for span in (2.0, 2.5, 3.0)
    ]
    sine = ramped_sine(3.0, 7.0, start=1.0, cycles=12, ramp=2)
    sines = [
        Trial(name, "sine", "frame", 6.5, table=sine, entry={"frequency": "3 Hz", **entry})
        for name, entry in ((STRONG, {"notes": MARKUP, "zero": "start"}), ("sine-dead", {}), (LATER, {}))
    ]
    seen = {"observed_outcome": "not-overturned"}
    statue = Trial("watched", "earthquake", "watched", 6.5, table=_shaking(2.0), entry=seen, specimen="statue")
    recorder = {MAIN: Recorder(250.0)}
    return Plan(
        HEAD.read_text(encoding="utf-8"),
        {"prism": 0.93, "statue": 0.9},
        {"frame": recorder, "watched": recorder},
        (*free, *spans, *sines, statue),
    )


def write_small_campaign(folder):
    """Shake the virtual table; one raw file is empty, and in one the accelerometer is the wrong way round."""
    write(_plan(), folder)
    (folder / "review.toml").write_text(REVIEW, encoding="utf-8")
    (folder / "raw" / "sine-dead.csv").write_text("", encoding="utf-8")
    _turn_accelerometer(folder / "raw" / "free-refused.csv")


def _turn_accelerometer(path):
    head, units, *rows = path.read_text(encoding="utf-8").splitlines()
    turned = (f"{others},{-float(value):.6f}" for others, value in (row.rsplit(",", 1) for row in rows))
    path.write_text("\n".join((head, units, *turned, "")), encoding="utf-8")


def run_small_campaign(folder):
    """Run it but for one test: tests are done, refused, overturned, failed, not run, or seen but not measured."""
    write_small_campaign(folder)
    run(folder, only=[name for name in load(folder).tests if name != LATER], until="compare", workers=1)
