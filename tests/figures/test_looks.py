"""
How figures look, against pictures that were looked at: one of each family, drawn with matplotlib's own font.

`pytest tests/figures/test_looks.py --mpl-generate-path=tests/figures/baseline` draws the pictures anew; look at them.
"""

import numpy as np
import pytest

from colonnade.figures.base_motion import BaseSpectra, base_motion
from colonnade.figures.channels import Channel, Scale, channels_as_recorded
from colonnade.figures.closer import Enlarged, Phase, closer_look, separatrix
from colonnade.figures.histories import Panel, Spread, bands_over_time
from colonnade.figures.panels.curve import Curve
from colonnade.figures.restitution.decay import EstimateRow, ImpactSeries, PeakSeries, impact_restitution, peak_decay
from colonnade.figures.stored.record import whole_record
from colonnade.figures.style import STYLE_FILE
from colonnade.identification.restitution.peaks import angle_of_energy
from colonnade.signals.metrics import Density
from colonnade.signals.quality import Flag
from prism import PRISM

TIME = np.arange(0, 8, 0.01)
SWING = Curve(TIME, 0.6 * np.exp(-TIME / 4) * np.sin(2 * np.pi * TIME))
MODEL = Curve(TIME, 0.6 * np.exp(-TIME / 4) * np.sin(2.02 * np.pi * TIME))
SHAKING = Curve(TIME, 3 * np.exp(-(((TIME - 3) / 1.5) ** 2)) * np.sin(9 * TIME))
SPREAD = Spread(
    TIME,
    np.array([0.025, 0.25, 0.5, 0.75, 0.975]),
    SWING.values + np.linspace(-0.1, 0.1, 5)[:, None] * np.clip(TIME, 0, 3),
    0.04,
    5.5,
)

looks = pytest.mark.mpl_image_compare(
    style=str(STYLE_FILE), savefig_kwargs={"dpi": 60, "facecolor": "white"}, tolerance=4
)
"""Tolerance: root of the mean squared difference of the pixels, of 255; a label that is gone gives more."""


@looks
def test_record():
    return whole_record(
        {"measured": SWING, "linear": MODEL},
        [
            Panel("Misfit", "predicted −\nmeasured, / α", "", {"linear": Curve(TIME, MODEL.values - SWING.values)}),
            Panel("Base", "base", "m/s²", {"": SHAKING}, 1.85, "g tan α"),
        ],
        impacts=np.arange(0.5, 8, 0.5),
        peak=(0.25, 0.56),
        spreads={"linear": SPREAD},
    )


@looks
def test_bands():
    return bands_over_time({"measured": SWING}, {"linear": SPREAD})


@looks
def test_channels():
    frequency, values, flags = np.geomspace(0.5, 50, 60), 30 * SWING.values, np.full(TIME.size, Flag.GOOD)
    values[300:302], flags[300:302], flags[500:540] = 25.0, Flag.FAIL, Flag.SUSPECT
    channel = Channel(
        "top",
        "mm",
        Curve(TIME, values),
        flags,
        Scale("V", 10.0, -0.2),
        Density(frequency, 1e-3 + 1 / frequency**2),
        Density(frequency, 1 / frequency**2 / (1 + (frequency / 25) ** 8)),
        25.0,
    )
    return channels_as_recorded([channel, channel._replace(name="bottom", flags=np.full(TIME.size, Flag.GOOD))])


@looks
def test_base_motion():
    period = np.geomspace(0.03, 3, 50)
    response = 8 * np.exp(-(np.log(period / 0.4) ** 2))
    return base_motion(
        SHAKING, Curve(TIME, 1.05 * SHAKING.values), BaseSpectra(period, response, 1.1 * response), uplift=1.85
    )


@looks
def test_closer_look():
    turn = np.linspace(0, 2 * np.pi, 100)
    once = Curve(turn / 2 / np.pi, 0.4 * np.sin(turn))
    cycles = Curve(
        np.append(np.append(once.time, np.nan), once.time), np.append(once.values, [np.nan, *1.05 * once.values])
    )
    phases = {
        "measured": Phase(0.41 * np.sin(turn), 0.5 * np.cos(turn)),
        "nonlinear": Phase(0.44 * np.sin(turn), 0.52 * np.cos(turn)),
    }
    curves = {"measured": cycles, "nonlinear": once}
    enlarged = Enlarged("phase of the base (periods)", curves, "last 2 periods of the steady part", (0.0, 1.0))
    return closer_look(phases, separatrix(PRISM), enlarged)


@looks
def test_impacts():
    random = np.random.default_rng(5)
    speed = np.geomspace(1.0, 0.1, 30)
    error = 2e-3 / speed
    return impact_restitution(
        [ImpactSeries("free-01", speed, 0.95 + error * random.standard_normal(30), error, speed > 0.15)],
        level=EstimateRow("e identified", 0.95, 0.948, 0.952),
        rigid=0.9485,
    )


@looks
def test_peaks():
    number = np.arange(1, 31)
    angle = np.asarray(angle_of_energy(0.8 * 0.95 ** (2 * number), PRISM.critical_angle))
    used = number < 25
    return peak_decay([PeakSeries("free-01", angle, np.full(30, 3e-4), np.where(used, angle, np.nan), used)], PRISM)
