"""A small campaign whose recordings are made in memory, with every number of the truth in sight."""

from pathlib import Path

import numpy as np
import pytest

import chain
from colonnade import campaign as campaigns
from colonnade.dynamics.kinematics import point_displacement
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.readers.recording import RecordedChannel, Recording
from prism import PRISM, campaign_of, entry

ON_SPECIMEN = 'quantity = "displacement", on = "specimen", direction = [1, 0, 0], relative_to = "table"'
TEXT = campaign_of(
    'top = {column = "LVDT 1", unit = "V", gain = "12 mm/V", offset = "3 mm", range = "10 V", '
    f'at = ["43 mm", "0 mm", "400 mm"], {ON_SPECIMEN}}}',
    f'bottom = {{column = "LVDT 2", unit = "mm", at = ["43 mm", "0 mm", "20 mm"], {ON_SPECIMEN}}}',
    'table_acceleration = {column = "ACC", quantity = "acceleration", on = "table", direction = [1, 0, 0], unit = "g"}',
    before='[setups.frame]\ncatch = "0.28 rad"\n',
    tests=entry("free-01", "free-vibration") + entry("shake-01", "earthquake", 'observed_outcome = "not-overturned"'),
)

RATE = 500.0
POINTS = [[0.043, 0.0, 0.400], [0.043, 0.0, 0.020]]


def _load(folder):
    path = folder / "campaign.toml"
    path.write_text(TEXT, encoding="utf-8")
    return campaigns.load(path)


@pytest.fixture
def small_campaign(tmp_path):
    return _load(tmp_path)


def recorded(time, angle, acceleration, *, noise=1e-5, seed=0, slide=0.0):
    """A recording of the true angle (rad) and base acceleration (m/s²), in the units of the campaign above."""
    rng = np.random.default_rng(seed)
    top, bottom = point_displacement(angle, POINTS, PRISM, slide)[..., 0] + rng.normal(0, noise, (2, time.size))
    columns = {
        "LVDT 1": ("V", (1e3 * top - 3.0) / 12.0),
        "LVDT 2": ("mm", 1e3 * bottom + 0.7),
        "ACC": ("g", acceleration / 9.80665 + 0.01 + rng.normal(0, 1e-4, time.size)),
    }
    channels = tuple(RecordedChannel(name, unit, values, time) for name, (unit, values) in columns.items())
    return {"main": Recording(Path("small.csv"), "delimited", channels)}


@pytest.fixture
def free_vibration():
    return _free_vibration()


def _free_vibration():
    """Held tilted for one second, released, at rest in the end: recordings, times, true angles, true e."""
    decay = rock(PRISM, restitution=0.93, theta0=0.5 * PRISM.critical_angle, duration=9.0, model="nonlinear")
    time = np.arange(0, 12, 1 / RATE)
    angle = np.interp(time - 1.0, decay.time, decay.angle)
    return recorded(time, angle, np.zeros(time.size)), time, angle, 0.93


@pytest.fixture
def released():
    """Release after one second from 0.5 α, the hand having tilted it further by `overshoot`, on a table that moves."""

    def release(restitution, base_share=0.0, *, overshoot=0.0):
        time, first = np.arange(0.0, 20.0, 1 / RATE), int(RATE)
        base = base_share * PRISM.critical_angle * PRISM.gravity * np.sin(2 * np.pi * 2.0 * time)
        start = 0.5 * PRISM.critical_angle
        free = rock(PRISM, Motion(base[first:], 1 / RATE), restitution=restitution, theta0=start, model="nonlinear")
        held = start + overshoot * PRISM.critical_angle * np.interp(time[:first], [0.3, 0.6], [1.0, 0.0])
        angle = np.concatenate((held, free.angle))
        return recorded(time, angle, base), time, angle

    return release


@pytest.fixture
def shaken():
    return _shaken()


def _shaken():
    """A base motion under which the prism rocks and comes to rest: recordings, times, true angles, base motion."""
    time = np.arange(0, 12, 1 / RATE)
    envelope = np.clip(np.minimum(time - 1, 7 - time), 0, 1)
    base = 1.7 * PRISM.uplift_acceleration * envelope * np.sin(2 * np.pi * 4 * time)
    angle = rock(PRISM, Motion(base, 1 / RATE), restitution=0.93).angle
    return recorded(time, angle, base), time, angle, base


@pytest.fixture
def shaken_upwards(small_campaign, shaken):
    """The small campaign with a vertical table accelerometer, and its test shaken along z as well: truth and record."""
    vertical = 'vertical = {column = "ACZ", quantity = "acceleration", on = "table", direction = [0, 0, 1], unit = "g"}'
    campaign = chain.changed(small_campaign, ("\n[[tests]]", f"{vertical}\n\n[[tests]]"))
    _, time, _, base = shaken
    vertical = 0.35 * 9.81 * np.sin(2 * np.pi * 5.3 * time) * np.clip(np.minimum(time - 1, 7 - time), 0, 1)
    angle = rock(PRISM, Motion(base, 1 / RATE, vertical), restitution=0.93).angle
    recordings = recorded(time, angle, base)["main"]
    noisy = vertical / 9.80665 + np.random.default_rng(5).normal(0, 1e-4, time.size)
    channel = RecordedChannel("ACZ", "g", noisy, time)
    return campaign, Recording(recordings.path, recordings.format, (*recordings.channels, channel)), angle


@pytest.fixture(scope="session")
def conditioned_and_measured(tmp_path_factory):
    """Both tests of the small campaign up to the rocking angle: conditioned, measured; look only."""
    campaign, found = _load(tmp_path_factory.mktemp("small")), {}
    for name, recordings in (("free-01", _free_vibration()[0]), ("shake-01", _shaken()[0])):
        found[name] = chain.measured(campaign, name, recordings)
    return found
