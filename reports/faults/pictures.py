"""The pictures of the atlas: what campaigns without a fault and with it show, read as campaign.toml says."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from colonnade import units
from colonnade.arrays import Array
from colonnade.figures.panels import curve as panel
from colonnade.figures.style import MEASURED, blank_figure, styled
from colonnade.signals.filters import default_lowpass, lowpass, second_derivative
from faults.fault import Curve, Picture, samples
from faults.sound import PRISM, RATE, RELEASE

Draws = Callable[[Path], list[Curve]]

ROTATION, ACCELERATION = "reading over height, mrad", "table's acceleration, m/s²"
STILL = 0.5
"""s at the end of a record, from which its zero is taken."""

SMOOTH = 20.0
"""Hz, cut-off of the table's two accelerations: noise of a displacement grows when it is differentiated."""


def signals(*channels: str) -> Draws:
    """Draw channels in the unit of their gain, those that the test has."""

    def draw(folder: Path) -> list[Curve]:
        known = _channels(folder)
        return [Curve(name, *_recorded(folder, name)) for name in channels if name in known]

    return draw


def rotations(*channels: str) -> Draws:
    """Draw the rotation that each displacement transducer gives alone, reading over height, in mrad."""

    def draw(folder: Path) -> list[Curve]:
        curves = []
        for name in channels:
            time, values = _recorded(folder, name)
            height = float(_channels(folder)[name]["at"][2].removesuffix(" mm"))
            zero = float(np.nanmedian(values[time > time[-1] - STILL]))
            curves.append(Curve(f"{name} over its height", time, 1e3 * (values - zero) / height))
        return curves

    return draw


def pair(window: tuple[float, float], shows: str) -> Picture:
    """Show the rotation that top and bottom give."""
    return Picture(rotations("top", "bottom"), ROTATION, window, shows)


def filtered(folder: Path) -> list[Curve]:
    """Draw the rotation that top gives, as recorded and with the low-pass of the campaign, in mrad."""
    [whole] = rotations("top")(folder)
    asked = _campaign(folder).get("processing", {}).get("lowpass")
    cutoff = default_lowpass(PRISM.p, RATE) if asked is None else float(asked.removesuffix(" Hz"))
    return [
        Curve("as recorded", whole.x, whole.y),
        Curve("low-passed", whole.x, lowpass(whole.y, 1 / RATE, cutoff)),
    ]


def table(folder: Path) -> list[Curve]:
    """Draw the table's acceleration, and that which follows from its displacement, in m/s², each on its own clock."""
    time, acceleration = _recorded(folder, "table_acceleration")
    unit = _channels(folder)["table_acceleration"]["gain"].split()[1].removesuffix("/V")
    own, displacement = _recorded(folder, "table_displacement")
    derived = second_derivative(1e-3 * displacement, float(np.median(np.diff(own))), SMOOTH)
    still = acceleration[time > time[-1] - STILL]
    scaled = units.factor_to_si(unit, "acceleration") * (acceleration - float(np.median(still)))
    scaled = lowpass(scaled, float(np.median(np.diff(time))), SMOOTH)
    return [Curve("accelerometer", time, scaled), Curve("from the displacement", own, derived)]


def tables(window: tuple[float, float], shows: str) -> Picture:
    """Show the table's two accelerations."""
    return Picture(table, ACCELERATION, window, shows)


def delays(folder: Path) -> list[Curve]:
    """Draw how late the accelerometer's recorder is against the displacement's, over windows of a record, in ms."""
    (time, acceleration), (own, derived) = ((curve.x, curve.y) for curve in table(folder))
    shifts = 1e-3 * np.arange(-40, 41)
    middles, found = np.arange(2.5, 9.0, 0.5), []
    for middle in middles:
        window = middle + np.linspace(-1.0, 1.0, 1000)
        expected = np.interp(window, own, derived)
        fits = [float(expected @ np.interp(window - shift, time, acceleration)) for shift in shifts]
        best = int(np.argmax(fits))
        a, b, _ = np.polyfit(shifts[best - 1 : best + 2], fits[best - 1 : best + 2], 2)
        found.append(-1e3 * b / (2 * a))
    return [Curve("delay of the second recorder", middles, np.array(found))]


def steps(file: str) -> Draws:
    """Draw the time from each sample of a file to the next, in ms."""

    def draw(folder: Path) -> list[Curve]:
        time = samples(folder / "raw" / file)[:, 0]
        return [Curve("step of the clock", time[1:], 1e3 * np.diff(time))]

    return draw


def named_motion(folder: Path) -> list[Curve]:
    """Draw the table's acceleration, and the record that the test names, over their peaks."""
    campaign = _campaign(folder)
    [test] = campaign["tests"]
    time, acceleration = _recorded(folder, "table_acceleration")
    own, values = np.loadtxt(folder / campaign["motions"][test["motion"]], delimiter=",", skiprows=1).T
    acceleration = acceleration - float(np.median(acceleration[time < 1.0]))
    return [
        Curve("the table moved", time, acceleration / np.abs(acceleration).max()),
        Curve("the campaign says", own * test["time_scale"] + RELEASE, values / np.abs(values).max()),
    ]


def motions(shows: str) -> Picture:
    """Show the table's motion and the record that the test names."""
    return Picture(named_motion, "acceleration over its peak", (3.0, 7.0), shows)


def _campaign(folder: Path) -> dict[str, Any]:
    with (folder / "campaign.toml").open("rb") as file:
        return tomllib.load(file)


def _channels(folder: Path) -> dict[str, Any]:
    campaign = _campaign(folder)
    [test] = campaign["tests"]
    return dict(campaign["setups"][test["setup"]]["channels"])


def _recorded(folder: Path, name: str) -> tuple[Array, Array]:
    """Time, s, and values in the unit of the gain, of shape (n,); the recorder's own clock."""
    [test] = _campaign(folder)["tests"]
    channel = _channels(folder)[name]
    files = test["file"] if isinstance(test["file"], dict) else {"main": test["file"]}
    path = folder / files[channel.get("recorder", "main")]
    heads = path.read_text(encoding="utf-8").splitlines()[0].split(",")
    table = samples(path)
    return table[:, 0], float(channel["gain"].split()[0]) * table[:, heads.index(channel["column"])]


SECOND: Any = {"color": "#d1490f", "linestyle": (0, (4.0, 1.5)), "linewidth": 1.1}
INTERVALS = 300
"""Of an envelope: the panels are half a page wide."""


@styled()
def draw(picture: Picture, sound: Path, faulty: Path) -> Figure:
    """Draw what a picture shows of two campaigns, side by side on one scale."""
    figure = blank_figure(2.3)
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for axes, folder, title in zip(panels, (sound, faulty), ("without the fault", "with the fault"), strict=True):
        for curve, line in zip(picture.curves(folder), (MEASURED, SECOND), strict=False):
            x, y = _within(curve, picture.window)
            axes.plot(x, y, label=curve.label, **line)
        axes.set_title(title)
        axes.set_xlabel(picture.across)
        axes.locator_params(axis="x", nbins=5)
    panels[0].set_xlim(*picture.window)
    panels[0].set_ylabel(picture.up)
    handles, labels = panels[0].get_legend_handles_labels()
    if len(labels) > 1:
        figure.legend(handles, labels, loc="outside lower center", ncols=2)
    return figure


def _within(curve: Curve, window: tuple[float, float]) -> panel.Curve:
    inside = (curve.x >= window[0]) & (curve.x <= window[1])
    return panel.envelope(panel.Curve(curve.x[inside], np.asarray(curve.y[inside])), intervals=INTERVALS)
