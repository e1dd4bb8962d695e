import numpy as np
import pytest

from colonnade.errors import StageError
from colonnade.signals.quality import Flag
from colonnade.stages import condition as conditioning
from colonnade.stages.condition import condition, default_lowpass
from colonnade.stages.ingest import ingest, instructions


def _conditioned(campaign, test, recordings, **changes):
    read = conditioning.instructions(campaign, test)
    return condition(ingest(recordings, instructions(campaign, test)), read.model_copy(update=changes))


def test_a_free_vibration_that_starts_tilted_is_zeroed_at_its_end(small_campaign, free_vibration):
    recordings, _, _, _ = free_vibration
    result = _conditioned(small_campaign, small_campaign.tests["free-01"], recordings)
    assert abs(float(result["top"][-100:].mean())) < 2e-6
    assert float(result["top"][100]) > 0.03
    assert result.attrs["warnings"] == []


def test_an_earthquake_is_zeroed_at_its_start(small_campaign, shaken):
    result = _conditioned(small_campaign, small_campaign.tests["shake-01"], shaken[0])
    assert abs(float(result["table_acceleration"][:200].mean())) < 2e-4
    assert result["top"].attrs["zero_window"].startswith("0 s")


def test_zero_can_be_given_or_switched_off(small_campaign, free_vibration):
    test = small_campaign.tests["free-01"]
    tilted = _conditioned(small_campaign, test, free_vibration[0], zero="start")
    assert abs(float(tilted["top"][:200].mean())) < 2e-6
    own = _conditioned(small_campaign, test, free_vibration[0], zero=(10.0, 11.0))
    assert own["top"].attrs["zero_window"] == "10 s to 11 s"
    raw = _conditioned(small_campaign, test, free_vibration[0], zero="none")
    assert float(raw["bottom"][-1]) == pytest.approx(0.7e-3, abs=1e-4)
    with pytest.raises(StageError, match="no sample lies between 90 and 91 s"):
        _conditioned(small_campaign, test, free_vibration[0], zero=(90.0, 91.0))


def test_a_record_that_ends_while_rocking_is_warned_of(small_campaign, free_vibration):
    test = small_campaign.tests["free-01"].model_copy(update={"window": (0.0, 3.0)})
    result = _conditioned(small_campaign, test, free_vibration[0])
    assert "not at rest at the end of the record" in result.attrs["warnings"][0]


def test_spikes_are_bridged_before_the_filter_and_stay_suspect(small_campaign, free_vibration):
    recordings, _, _, _ = free_vibration
    clean = _conditioned(small_campaign, small_campaign.tests["free-01"], recordings)
    recordings["main"].channel("LVDT 1").values[1500] += 5.0
    spiked = _conditioned(small_campaign, small_campaign.tests["free-01"], recordings)
    np.testing.assert_allclose(spiked["top"], clean["top"], atol=1e-4)
    assert spiked["top_quality"][1500] == Flag.SUSPECT


def test_the_noise_that_is_left_is_told(small_campaign, free_vibration):
    recordings, _, _, _ = free_vibration
    result = _conditioned(small_campaign, small_campaign.tests["free-01"], recordings)
    assert float(result["top"][-400:].std()) == pytest.approx(result["top"].attrs["noise"], rel=0.5)
    assert 1e-6 < result["top"].attrs["noise"] < 1e-5


def test_a_delay_is_taken_off(small_campaign, shaken):
    test = small_campaign.tests["shake-01"]
    delays = conditioning.instructions(small_campaign, test).delays | {"table_acceleration": 0.01}
    late = _conditioned(small_campaign, test, shaken[0], delays=delays)
    whole = _conditioned(small_campaign, test, shaken[0])
    onto = late["elapsed"].to_numpy()[100:-100]
    expected = np.interp(onto + 0.01, whole["elapsed"], whole["table_acceleration"])
    np.testing.assert_allclose(np.interp(onto, late["elapsed"], late["table_acceleration"]), expected, atol=5e-3)


def test_the_default_cut_off_follows_the_specimen_and_stays_below_the_sampling_rate():
    assert default_lowpass(5.631, 500.0) == pytest.approx(35.0, abs=0.2)
    assert default_lowpass(5.631, 50.0) == 20.0


def test_a_cut_off_above_half_the_sampling_rate_is_refused_by_its_key(small_campaign, free_vibration):
    with pytest.raises(StageError, match=r"processing\.lowpass is 300 Hz; below 250 Hz"):
        _conditioned(small_campaign, small_campaign.tests["free-01"], free_vibration[0], lowpass=300.0)


def test_a_channel_without_a_value_is_left_out_and_said(small_campaign, free_vibration):
    recordings, _, _, _ = free_vibration
    recordings["main"].channel("LVDT 2").values[:] = np.nan
    result = _conditioned(small_campaign, small_campaign.tests["free-01"], recordings)
    assert "bottom" not in result
    assert any("channel bottom is left out" in warning for warning in result.attrs["warnings"])
