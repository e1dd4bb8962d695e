"""Plausibility of a test's channels, from recordings to warnings."""

from dataclasses import replace

import numpy as np
import pytest

from chain import changed, conditioned
from colonnade.readers.recording import RecordedChannel
from colonnade.stages.condition import ConditionInputs

ON_TOP = 'on = "specimen", at = ["0 mm", "0 mm", "456 mm"], direction = [0, 0, 1]'


def _with_channel(campaign, recordings, written, channel, *changes):
    """The campaign with a further channel, and the recordings with its column."""
    main = recordings["main"]
    recordings["main"] = replace(main, channels=(*main.channels, channel))
    written = f'further = {{column = "{channel.name}", unit = "{channel.unit}", {written}}}'
    return changed(campaign, ("\n[[tests]]", f"{written}\n\n[[tests]]"), *changes)


def _doubts(campaign, name, recordings):
    return list(map(str, conditioned(campaign, name, recordings).attrs["warnings"]))


def test_nothing_is_said_of_sound_channels(small_campaign, free_vibration, shaken):
    assert _doubts(small_campaign, "free-01", free_vibration[0]) == []
    assert _doubts(small_campaign, "shake-01", shaken[0]) == []


def _with_displacement(campaign, shaken, *changes, on_ground=False):
    """The table's displacement as a further channel; it moves the specimen's transducers if they are on the ground."""
    recordings, time, _, base = shaken
    interval = time[1] - time[0]
    moved = np.cumsum(np.cumsum(base - base.mean()) * interval) * interval
    moved -= np.polyval(np.polyfit(time, moved, 2), time)
    for name, scale in (("LVDT 1", 12), ("LVDT 2", 1)):
        recordings["main"].channel(name).values[:] += on_ground * 1e3 * moved / scale
    written = 'quantity = "displacement", on = "table", direction = [1, 0, 0]'
    return _with_channel(campaign, recordings, written, RecordedChannel("ACT", "mm", 1e3 * moved, time), *changes)


@pytest.mark.parametrize("beside", [False, True], ids=["alone", "displacement beside it"])
def test_an_accelerometer_that_is_known_to_saturate_has_no_wrong_gain(beside, small_campaign, shaken):
    values, limit = shaken[0]["main"].channel("ACC").values, 0.1
    values[:] = np.clip(values, -limit, limit)
    campaign = changed(small_campaign, ('unit = "g"', f'unit = "g", range = "{limit} g"'))
    told = _doubts(_with_displacement(campaign, shaken) if beside else campaign, "shake-01", shaken[0])
    assert [each for each in told if "times" in each] == []


def test_a_late_accelerometer_is_told_and_no_transducer_judged_by_it(small_campaign, shaken):
    values = shaken[0]["main"].channel("ACC").values
    values[:] = np.roll(values, 30)
    (told,) = _doubts(_with_displacement(small_campaign, shaken), "shake-01", shaken[0])
    assert "ms late against" in told


def test_transducers_on_the_ground_are_judged_less_the_tables_displacement(small_campaign, shaken):
    on_ground = [('relative_to = "table"', 'relative_to = "ground"')] * 2
    campaign = _with_displacement(small_campaign, shaken, *on_ground, on_ground=True)
    assert [warning for warning in _doubts(campaign, "shake-01", shaken[0]) if "Zero was" not in warning] == []
    shaken[0]["main"].channel("LVDT 1").values[:] *= 10
    told = _doubts(campaign, "shake-01", shaken[0])
    assert any("Channel top shows" in warning for warning in told), told


@pytest.mark.parametrize(
    ("named", "polarity", "said"),
    [
        ("valley", 1.0, ""),
        ("Valley", -1.0, "with the other polarity"),
        ("Lost", 1.0, 'reference motion "Lost" cannot be used'),
    ],
    ids=["whatever its case", "polarity", "without file"],
)
def test_the_motion_named_is_held_against_its_reference(named, polarity, said, small_campaign, shaken):
    recordings, time, _, base = shaken
    rows = "".join(f"{instant:.3f},{polarity * value:.6f}\n" for instant, value in zip(time, base, strict=True))
    (small_campaign.folder / "valley.csv").write_text("time (s),acceleration (m/s^2)\n" + rows)
    campaign = changed(
        small_campaign,
        ("[setups.frame]", '[motions]\nValley = "valley.csv"\nLost = "lost.csv"\n\n[setups.frame]'),
        ('kind = "earthquake"', f'kind = "earthquake"\nmotion = "{named}"\ntime_scale = 1.0'),
    )
    told = " ".join(_doubts(campaign, "shake-01", recordings))
    assert said in told
    assert bool(told) == bool(said)


def test_a_changed_reference_makes_another_result(small_campaign):
    path = small_campaign.folder / "valley.csv"
    campaign = changed(
        small_campaign,
        ("[setups.frame]", '[motions]\nValley = "valley.csv"\n\n[setups.frame]'),
        ('kind = "earthquake"', 'kind = "earthquake"\nmotion = "Valley"'),
    )
    keys = []
    for text in ("time (s),a (g)\n0,0\n0.1,1\n", "time (s),a (g)\n0,0\n0.1,2\n\n"):
        path.write_text(text)
        keys.append(ConditionInputs.of(campaign, campaign.tests["shake-01"]).model_dump_json())
    assert keys[0] != keys[1]
    assert str(small_campaign.folder) not in keys[0]


@pytest.mark.parametrize("at_rest", [1.02, -1.0, 9.81, 0.001], ids=["right", "sign", "unit", "AC"])
def test_an_accelerometer_on_the_specimen_shows_gravity_at_rest(at_rest, small_campaign, free_vibration):
    recordings, time, _, _ = free_vibration
    head = at_rest + np.random.default_rng(0).normal(0, 1e-3, time.size)
    channel = RecordedChannel("HEAD", "g", head, time)
    campaign = _with_channel(small_campaign, recordings, f'quantity = "acceleration", {ON_TOP}', channel)
    ready = conditioned(campaign, "free-01", recordings)
    assert [each.kind for each in ready.attrs["warnings"]] == ["gravity"] * (at_rest != 1.02)
    assert float(ready["further"][-200:].mean()) == pytest.approx(9.81, abs=1e-3)
    assert ready["further"].attrs["zero"] == pytest.approx(at_rest * 9.80665 - 9.81, abs=5e-3)


def test_a_gyroscopes_value_at_rest_is_its_bias(small_campaign, free_vibration):
    recordings, time, angle, _ = free_vibration
    channel = RecordedChannel("GYRO", "rad/s", np.gradient(angle, time) + 0.03, time)
    campaign = _with_channel(small_campaign, recordings, f'quantity = "angular_velocity", {ON_TOP}', channel)
    ready = conditioned(campaign, "free-01", recordings)
    assert ready["further"].attrs["zero"] == pytest.approx(0.03, abs=1e-4)
    assert float(np.abs(ready["further"][-200:]).max()) < 1e-3
