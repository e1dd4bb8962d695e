from dataclasses import replace

import numpy as np
import pytest

from chain import changed, conditioned
from colonnade.errors import StageError
from colonnade.stages import rocking as rocking_stage
from colonnade.stages.rocking import rocking
from prism import PRISM


def _rocking(campaign, name, recordings, **changes):
    test = campaign.tests[name]
    read = _with_channels(rocking_stage.RockingInputs.of(campaign, test), **changes)
    return rocking(conditioned(campaign, test, recordings), read)


def _with_channels(read, **changes):
    return read.model_copy(update={"transducers": read.transducers.model_copy(update=changes)})


def test_the_angle_of_a_free_vibration_is_the_true_one(small_campaign, free_vibration):
    recordings, time, angle, _ = free_vibration
    result = _rocking(small_campaign, "free-01", recordings)
    away = np.abs(time - 1.0) > 0.05  # the release is a step that the filter rounds
    error = (result["rocking_angle"].to_numpy() - np.interp(result["elapsed"], time, angle))[away]
    assert np.sqrt(np.mean(error**2)) < 5e-4 * PRISM.critical_angle
    assert result.attrs["outcome"] == "rocking"
    assert float(result["peak_ratio"]) == pytest.approx(0.5, abs=2e-3)
    assert "angle and slide" in result.attrs["separation"]
    rest = result["rocking_angle"].to_numpy()[time[: result.sizes["elapsed"]] > 11]
    assert rest.std() < 2 * float(result["rocking_angle_standard_error"])
    assert float(result["rocking_angle_standard_error"]) < 5e-5


def test_the_base_motion_and_its_peak_are_those_of_the_table(small_campaign, shaken):
    recordings, time, angle, base = shaken
    result = _rocking(small_campaign, "shake-01", recordings)
    expected = np.interp(result["elapsed"], time, base)
    np.testing.assert_allclose(result["base_acceleration"], expected, atol=0.01)
    assert float(result["peak_ground_acceleration"]) == pytest.approx(np.abs(base).max(), rel=5e-3)
    assert float(result["peak_time"]) == pytest.approx(time[np.argmax(np.abs(angle))], abs=0.01)


def test_ground_relative_transducers_need_the_tables_displacement(small_campaign, shaken):
    test = small_campaign.tests["shake-01"]
    read = rocking_stage.RockingInputs.of(small_campaign, test)
    positions = {name: replace(each, on_ground=True) for name, each in read.transducers.positions.items()}
    with pytest.raises(StageError, match="relative to the ground"):
        rocking(conditioned(small_campaign, test, shaken[0]), _with_channels(read, positions=positions))


def test_a_specimen_without_transducers_still_has_its_base_motion_and_nothing_at_all_is_refused(small_campaign, shaken):
    result = _rocking(small_campaign, "shake-01", shaken[0], positions={})
    assert "rocking_angle" not in result
    assert result.attrs["outcome"] == ""
    assert float(result["peak_ground_acceleration"]) > 1
    with pytest.raises(StageError, match="at least one of the two is needed"):
        _rocking(small_campaign, "shake-01", shaken[0], positions={}, accelerations={})


def test_a_lost_transducer_leaves_the_angle_to_the_other(small_campaign, free_vibration):
    recordings, _time, _angle, _ = free_vibration
    recordings["main"].channel("LVDT 2").values[:] = np.nan
    result = _rocking(small_campaign, "free-01", recordings)
    assert "slide cannot be separated" in result.attrs["separation"]
    assert float(result["peak_ratio"]) == pytest.approx(0.5, abs=2e-3)


@pytest.mark.parametrize("share", [0.06, 0.12, 0.4])
def test_a_block_that_walks_under_its_only_transducer_is_told(share, small_campaign, shaken):
    recordings, time, _, _ = shaken
    walk = share * PRISM.critical_angle * 400 / 12 * np.clip((time - 1) / 6, 0, 1)
    recordings["main"].channel("LVDT 1").values[:] += walk
    motion = _rocking(changed(small_campaign, ("\nbottom = ", "\n# bottom = ")), "shake-01", recordings)
    (told,) = [str(each) for each in motion.attrs["warnings"] if each.kind == "rest"]
    assert f"is at {share:.2g} α" in told
    assert "the block walked under it" in told
