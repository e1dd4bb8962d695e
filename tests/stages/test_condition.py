import re

import numpy as np
import pytest
import xarray as xr

from chain import conditioned, measured
from colonnade.campaign import Channel
from colonnade.errors import StageError
from colonnade.signals.quality import Flag
from colonnade.stages import condition as conditioning
from colonnade.stages.condition import condition
from prism import PRISM

OFFSET = 0.02
"""s, by which the second recorder is late."""


def _shaking(time, frequency=3.0):
    return 2 * np.sin(2 * np.pi * frequency * time) * np.clip(np.minimum(time - 1, 7 - time), 0, 1)


def _two_recorders(first, second, *, noise=1e-3):
    """Accelerations of the table, (values on 500 Hz, values on 400 Hz), as the result of `ingest`."""
    rng = np.random.default_rng(0)
    variables = {}
    for name, dimension, values in (("first", "elapsed", first), ("second", "elapsed_daq2", second)):
        variables[name] = (dimension, values + rng.normal(0, noise, values.size), {"channel": name})
        variables[f"{name}_quality"] = (dimension, np.full(values.size, Flag.GOOD, dtype=np.int8))
    clocks = {"elapsed": ("elapsed", FIRST), "elapsed_daq2": ("elapsed_daq2", SECOND)}
    return xr.Dataset(variables, coords=clocks)


FIRST, SECOND = np.arange(0, 9, 1 / 500), np.arange(0, 9, 1 / 400)


def _delayed(read, delays):
    """The same inputs with other delays of the channels."""
    changed = {name: read.channels[name].model_copy(update={"delay": delay}) for name, delay in delays.items()}
    return read.model_copy(update={"channels": read.channels | changed})


@pytest.fixture
def linked(small_campaign):
    """Inputs for the two recorders above."""
    read = conditioning.ConditionInputs.of(small_campaign, small_campaign.tests["shake-01"])
    recorders = {"first": "main", "second": "daq2"}
    table = {"column": "a", "quantity": "acceleration", "unit": "g", "on": "table", "direction": (1, 0, 0)}
    channels = {name: Channel(recorder=recorder, **table) for name, recorder in recorders.items()}
    return read.model_copy(update={"channels": channels, "links": {"daq2": ("first", "second")}})


@pytest.mark.parametrize(("of_first", "of_second"), [(0.0, 0.0), (0.0, 0.01), (0.004, 0.0), (0.004, 0.01)])
def test_a_delay_and_a_clock_offset_are_each_taken_off_once(linked, of_first, of_second):
    recorded = _two_recorders(_shaking(FIRST - of_first), _shaking(SECOND - OFFSET - of_second))
    result = condition(recorded, _delayed(linked, {"first": of_first, "second": of_second}))
    assert result["second"].attrs["clock_offset"] == pytest.approx(OFFSET + of_second, abs=2e-4)
    assert result["first"].attrs["clock_offset"] == of_first
    for name in ("first", "second"):
        np.testing.assert_allclose(result[name], _shaking(result["elapsed"].to_numpy()), atol=2e-2)


def test_a_channel_of_another_quantity_links_recorders_but_is_not_conditioned(linked):
    pulse = np.where((FIRST > 3) & (FIRST < 3.5), 5.0, 0.0), np.where((SECOND > 3.02) & (SECOND < 3.52), 5.0, 0.0)
    recorded = _two_recorders(*pulse)
    shaken = _two_recorders(_shaking(FIRST), _shaking(SECOND - OFFSET), noise=0.0)
    names = {"first": "base", "second": "late", "first_quality": "base_quality", "second_quality": "late_quality"}
    recorded = recorded.merge(shaken.rename(names))
    unused = {"quantity": "other", "on": None}
    channels = {name: channel.model_copy(update=unused) for name, channel in linked.channels.items()}
    channels |= {"base": linked.channels["first"], "late": linked.channels["second"]}
    result = condition(recorded, linked.model_copy(update={"channels": channels}))
    assert set(result.data_vars) == {"base", "base_quality", "late", "late_quality"}
    assert result["late"].attrs["clock_offset"] == pytest.approx(OFFSET, abs=1e-3)


@pytest.fixture
def zeros(small_campaign, shaken):
    """Findings on the zero with something added to the table's acceleration, g."""

    def found(added=None, **changes):
        shaken[0]["main"].channel("ACC").values[:] += 0.0 if added is None else added(shaken[1])
        test = small_campaign.tests["shake-01"].model_copy(update=changes)
        return [each for each in measured(small_campaign, test, shaken[0])[1].attrs["warnings"] if each.kind == "zero"]

    return found


def test_shaking_before_the_table_is_at_rest_is_warned_of(zeros):
    (told,) = zeros(lambda time: np.where(time > 0.1, 0.05 * np.sin(20 * time), 0.0))
    assert told.severity == "warning"
    share = float(re.search(r"The zero of the base acceleration is uncertain by ([\d.]+) of the acce", told.text)[1])
    # The mean of a sine over half a second less that over a part of it, of 0.49 m/s²: at most its amplitude.
    assert 0.05 < share * PRISM.uplift_acceleration < 0.49
    assert "that uplifts the specimen: it moves from 0 to 0.5 s" in told.text


def test_a_zero_that_moves_too_little_to_matter_is_not_told(zeros):
    assert zeros(lambda time: 0.002 * np.sin(20 * time)) == []  # 16 times its noise


def test_a_given_zero_is_taken(zeros):
    (told,) = zeros(lambda time: np.where(time < 0.6, 0.05 * np.sin(20 * time), 0.0))
    assert "Start recording before the motion, or give the test a `zero`" in told.text
    assert zeros(zero=(0.6, 1.1)) == []


@pytest.fixture
def free(small_campaign, free_vibration):
    """Condition a free vibration."""
    return lambda test="free-01", **changes: conditioned(small_campaign, test, free_vibration[0], **changes)


@pytest.fixture
def top(free_vibration):
    """Values of its upper transducer, V."""
    return free_vibration[0]["main"].channel("LVDT 1").values


def test_a_channel_without_values_where_zero_is_taken_is_left_out(free, top):
    top[-300:] = np.nan
    result = free()
    assert "top" not in result
    assert any("channel top is left out: it has no value from" in warning.text for warning in result.attrs["warnings"])
    assert result["elapsed"][-1] == pytest.approx(11.998)


def test_a_free_vibration_that_starts_tilted_is_zeroed_at_its_end_where_its_noise_is_left(free):
    result = free()
    top = result["top"]
    assert abs(float(top[-100:].mean())) < 2e-6
    assert float(top[100]) > 0.03
    assert float(top[-400:].std()) == pytest.approx(top.attrs["noise"], rel=0.5)
    assert 1e-6 < top.attrs["noise"] < 1e-5
    assert result.attrs["warnings"] == []


def test_an_earthquake_is_zeroed_at_its_start(small_campaign, shaken):
    result = conditioned(small_campaign, "shake-01", shaken[0])
    assert abs(float(result["table_acceleration"][:200].mean())) < 2e-4
    assert result["top"].attrs["zero_window"].startswith("0 s")


def test_zero_can_be_given_or_switched_off(free):
    assert abs(float(free(zero="start")["top"][:200].mean())) < 2e-6
    assert free(zero=(10.0, 11.0))["top"].attrs["zero_window"] == "10 s to 11 s"
    assert float(free(zero="none")["bottom"][-1]) == pytest.approx(0.7e-3, abs=1e-4)
    told = " ".join(map(str, free(zero=(90.0, 91.0)).attrs["warnings"]))
    assert "channel top is left out: it has no value from 90 to 91 s, where the zero is taken" in told


def test_a_record_that_ends_while_rocking_is_warned_of(small_campaign, free_vibration):
    test = small_campaign.tests["free-01"].model_copy(update={"window": (0.0, 3.0)})
    told = measured(small_campaign, test, free_vibration[0])[1].attrs["warnings"][0]
    assert (told.kind, told.severity) == ("zero", "serious")
    assert "The zero of the rocking angle is uncertain by 0.18 of the critical angle" in told.text
    assert "Record until the specimen is still" in told.text


def test_spikes_are_bridged_before_the_filter_and_stay_suspect(free, top):
    clean = free()
    top[1500] += 5.0
    spiked = free()
    np.testing.assert_allclose(spiked["top"], clean["top"], atol=1e-4)
    assert spiked["top_quality"][1500] == Flag.SUSPECT


def test_a_cut_off_above_half_the_sampling_rate_is_refused_by_its_key(small_campaign, free):
    too_high = small_campaign.processing.model_copy(update={"lowpass": 300.0})
    with pytest.raises(StageError, match=r"processing\.lowpass is 300 Hz; below 250 Hz.*channel top"):
        free(settings=too_high)
