"""What a free vibration's prediction starts from, what drives it, and what it is held against."""

import numpy as np
import pytest
import xarray as xr

import chain
from chain import measured
from colonnade.errors import StageError
from colonnade.identification.restitution.arcs import find_impacts
from colonnade.stages.parts.beginning import AT_REST, NOT_RECORDED, RECORDED, base_acceleration, other_axes
from colonnade.stages.parts.reference_motions import load, reference_files
from colonnade.stages.parts.transducers import Transducers, base_motion
from every import every
from prism import PRISM

RELEASE = 1.0
"""s, when a specimen is let go, of 0.5 α."""

E = 0.976
ALPHA = PRISM.critical_angle


@pytest.fixture
def specimen(small_campaign):
    return chain.pooled(small_campaign, {}, given=E)


@pytest.fixture
def predicted(small_campaign, specimen):
    """Predict a free vibration; the e that was identified from it may be given."""
    return lambda rocking, free=None: chain.predicted(small_campaign, "free-01", rocking, specimen, "nonlinear", free)


@pytest.fixture
def compared(small_campaign):
    return lambda rocking, prediction: chain.compared(small_campaign, "free-01", rocking, {"nonlinear": prediction})


@pytest.fixture
def rocking(small_campaign, released):
    """The measured motion after a release at rest."""
    return measured(small_campaign, "free-01", released(E)[0])[1]


def lateness(prediction, time, angle):
    """The times by which the predicted impacts are later than the true ones, s."""
    begins = float(prediction["elapsed"][int(np.argmax(np.isfinite(prediction["rocking_angle"].to_numpy())))])
    true = find_impacts(time[time > begins], angle[time > begins], lowest=0.02 * ALPHA)
    found = prediction["impact_time"].to_numpy()[: true.size]
    return found - true[: found.size]


@every(("offset", "gain"), [(0.002, 1.0), (-0.002, 1.0), (0.0, 1.004)])
def test_a_prediction_from_the_true_zero_by_the_true_gain_keeps_time_better(
    small_campaign, released, predicted, compared, offset, gain
):
    """Of α and the gain it shows the product; predictions start and are compared by the gain for their own α."""
    recordings, time, angle = released(E)
    _, rocking = measured(small_campaign, "free-01", recordings)
    wrong = rocking.assign(rocking_angle=gain * rocking["rocking_angle"] + offset * ALPHA)
    identified = chain.identified(small_campaign, wrong)
    without, prediction = predicted(wrong), predicted(wrong, identified)
    assert float(prediction["zero_offset"]) == float(identified["zero_offset"])
    assert float(prediction["zero_offset"]) == pytest.approx(offset * ALPHA, abs=1e-4 * ALPHA)
    assert float(prediction["angle_gain"]) == pytest.approx(gain, abs=2e-4)  # e is given: the block moves as given
    late, late_without = (np.sqrt(np.mean(lateness(each, time, angle) ** 2)) for each in (prediction, without))
    assert late < 0.25 * late_without

    # The misfit is that of two angles about one zero and of one gain.
    misfits = [compared(wrong, each) for each in (without, prediction)]
    assert float(misfits[1]["nrmse"][0]) < 0.25 * float(misfits[0]["nrmse"][0])
    for name in ("zero_offset", "angle_gain"):
        assert float(misfits[1][name]) == float(prediction[name])
    true_peak = np.abs(angle[time > float(misfits[1]["measured_peak_time"]) - 0.01]).max() / ALPHA
    assert float(misfits[1]["measured_peak_ratio"]) == pytest.approx(true_peak, abs=5e-4)


@pytest.mark.parametrize("every", [5, 8], ids=["100 Hz", "62.5 Hz"])
def test_a_prediction_from_a_peak_between_two_samples_is_not_late(small_campaign, released, predicted, every):
    """Started at rest at the next sample, it would be late by up to a sampling interval, here 10 and 16 ms."""
    recordings, time, angle = released(E)
    _, rocking = measured(small_campaign, "free-01", recordings)
    predictions = (predicted(rocking.isel(elapsed=slice(shift, None, every))) for shift in range(0, every, 2))
    late = [lateness(each, time, angle)[0] for each in predictions]
    assert np.abs(late).max() < 0.15 * every * float(time[1])


def test_a_measured_peak_is_that_of_the_time_that_is_predicted(small_campaign, released, predicted, compared):
    _, rocking = measured(small_campaign, "free-01", released(E, overshoot=0.05)[0])
    prediction = predicted(rocking)
    result = compared(rocking, prediction)
    after_the_first_impact = float(prediction["peak_ratio"])
    assert after_the_first_impact < 0.5
    assert float(result["measured_peak_ratio"]) == pytest.approx(after_the_first_impact, abs=1e-3)
    assert float(result["measured_peak_time"]) > RELEASE
    assert float(rocking["peak_ratio"]) == pytest.approx(0.55, abs=1e-3)
    assert float(result["release_ratio"]) == pytest.approx(0.5, abs=1e-3)
    assert float(result["peak_ratio_error"][0]) == pytest.approx(0.0, abs=1e-3)


def test_a_table_that_moves_drives_the_prediction_of_a_free_vibration(small_campaign, released, predicted, compared):
    _, rocking = measured(small_campaign, "free-01", released(E, 0.05)[0])
    prediction, unmoved = predicted(rocking), predicted(rocking.drop_vars("base_acceleration"))
    assert (prediction.attrs["driven_by"], unmoved.attrs["driven_by"]) == (RECORDED, NOT_RECORDED)
    np.testing.assert_array_equal(prediction["base_acceleration"], rocking["base_acceleration"])
    driven, free = (float(compared(rocking, each)["nrmse"][0]) for each in (prediction, unmoved))
    assert driven < 0.02
    assert free > 5 * driven


def test_it_is_driven_as_its_restitution_is(small_campaign, rocking, predicted):
    base = rocking["base_acceleration"]
    noisy = rocking.assign(base_acceleration=base.copy(data=np.random.default_rng(1).normal(0.0, 0.2, base.size)))
    identified = chain.identified(small_campaign, noisy)
    assert np.isfinite(float(identified["restitution"]))
    assert predicted(noisy, identified).attrs["driven_by"] == AT_REST
    assert predicted(noisy).attrs["driven_by"] == RECORDED


TIME = np.arange(0.0, 2.0, 0.01)
WAVE = np.sin(2 * np.pi * 3.0 * TIME)


def _rocking(**variables):
    named = {name: ("elapsed", values) for name, values in variables.items()}
    return xr.Dataset(named, coords={"elapsed": ("elapsed", TIME)})


def _gap(values):
    holed = values.copy()
    holed[50:53] = np.nan
    return holed


def test_a_record_that_is_missing_is_refused_with_what_to_add_and_missing_samples_with_the_first():
    with pytest.raises(StageError, match=r'was not recorded in this test.*on = "table"'):
        base_acceleration(_rocking())
    with pytest.raises(StageError, match=r"missing 3 of 200 samples, the first at 0\.500 s"):
        base_acceleration(_rocking(base_acceleration=_gap(WAVE)))


@every(("values", "kinds"), [(WAVE, []), (_gap(WAVE), ["motion left out"])])
def test_a_model_in_space_takes_the_motion_across_if_it_is_whole(values, kinds):
    recorded = _rocking(transverse_base_acceleration=values)
    across, vertical, warnings = other_axes(recorded, WAVE, gravity=9.81, is_in_space=True)
    assert (across is None, vertical) == (bool(kinds), None)
    assert [each.kind for each in warnings] == kinds


LONGER = np.arange(0.0, 4.0, 0.005)
OMEGA = 2 * np.pi * 1.5
SWELL = np.sin(OMEGA * LONGER)


def _conditioned(**channels):
    named = {name: ("elapsed", values, {"cutoff_hz": 40.0, "channel": name}) for name, values in channels.items()}
    return xr.Dataset(named, coords={"elapsed": ("elapsed", LONGER)})


def _table(accelerations=(), displacements=()):
    along, across = (dict.fromkeys(names, (1.0, 0.0, 0.0)) for names in (accelerations, displacements))
    on_specimen = {name: {} for name in ("positions", "gyroscopes")}
    return Transducers(**on_specimen, accelerations=along, displacements=across)


@every(("factor", "kinds"), [(1.02, []), (2.0, ["several table channels"])])
def test_several_accelerometers_are_averaged_and_compared(factor, kinds):
    warnings = []
    base = base_motion(_conditioned(a=SWELL, b=factor * SWELL), _table(("a", "b")), warnings)
    np.testing.assert_allclose(base["base_acceleration"], (1 + factor) / 2 * SWELL)
    assert [each.kind for each in warnings] == kinds


def test_without_a_usable_accelerometer_the_displacement_is_differentiated():
    warnings = []
    base = base_motion(_conditioned(stroke=SWELL), _table(("dead",), ("stroke",)), warnings)
    middle = slice(100, -100)
    np.testing.assert_allclose(base["base_acceleration"][middle], -(OMEGA**2) * SWELL[middle], atol=0.02 * OMEGA**2)
    assert [(warning.kind, warning.severity) for warning in warnings] == [("derived base motion", "note")]


def test_one_of_three_components_has_to_be_named(small_campaign):
    series = np.cumsum(np.random.default_rng(5).standard_normal((266, 3)), axis=0) / 40
    rows = "".join("".join(f"{number:10.4f}" for number in row) + "\n" for row in series)
    (small_campaign.folder / "valley.dat").write_text(f"3F10.4\n        NS        EW        UD\n{rows}")
    valley = 'file = "valley.dat", interval = "0.02 s"'
    written = f'[motions]\nValley = {{{valley}}}\nNorth = {{{valley}, column = "NS"}}\n\n[setups.frame]'
    campaign, warnings = chain.changed(small_campaign, ("[setups.frame]", written)), []
    loaded = load(reference_files(campaign), warnings)
    (told,) = [str(warning) for warning in warnings]
    assert '"Valley" cannot be used' in told
    assert "3 columns may be the acceleration" in told
    assert loaded["North"].acceleration.size == 266
