"""What drives a prediction: base motions from their channels, and reference motions."""

import numpy as np
import pytest
import xarray as xr

import chain
from colonnade.errors import StageError
from colonnade.identification.fusion.sensors import Accelerometer
from colonnade.stages.parts import beginning as driving
from colonnade.stages.parts.beginning import base_acceleration, vertical_acceleration, weakened
from colonnade.stages.parts.reference_motions import load, reference_files
from colonnade.stages.parts.transducers import Transducers, axes, base_motion, group
from colonnade.units.text import format_percent
from every import every

TIME = np.arange(0.0, 2.0, 0.01)
WAVE = np.sin(2 * np.pi * 3.0 * TIME)


def _rocking(**variables):
    named = {name: ("elapsed", values) for name, values in variables.items()}
    return xr.Dataset(named, coords={"elapsed": ("elapsed", TIME)})


def _gap(values):
    holed = values.copy()
    holed[50:53] = np.nan
    return holed


def test_a_whole_record_is_returned_as_it_is():
    np.testing.assert_array_equal(base_acceleration(_rocking(base_acceleration=WAVE)), WAVE)


def test_a_record_that_is_missing_is_refused_with_what_to_add():
    with pytest.raises(StageError, match=r'was not recorded in this test.*on = "table"'):
        base_acceleration(_rocking())


def test_missing_samples_are_refused_with_the_first():
    with pytest.raises(StageError, match=r"missing 3 of 200 samples, the first at 0\.500 s"):
        base_acceleration(_rocking(base_acceleration=_gap(WAVE)))


def test_a_vertical_motion_is_only_missed_if_the_set_up_has_its_channel():
    assert vertical_acceleration(_rocking(), gravity=9.81, expected=False) == (None, [])
    assert len(vertical_acceleration(_rocking(), gravity=9.81, expected=True)[1]) == 1


def test_a_model_in_space_takes_the_motion_across_if_it_is_whole():
    across, holed = (_rocking(transverse_base_acceleration=values) for values in (WAVE, _gap(WAVE)))
    assert driving.transverse_acceleration(holed) is None
    np.testing.assert_array_equal(driving.transverse_acceleration(across), WAVE)


@pytest.mark.parametrize(("frequency", "loss"), [(3.0, None), (8.0, 0.021), (20.0, 0.125)])
def test_content_too_fast_for_straight_lines_is_said_with_its_loss(frequency, loss):
    # sinc²(f / 100 Hz): 0.997, 0.979, 0.875
    found = weakened(np.sin(2 * np.pi * frequency * TIME))
    assert [format_percent(loss) in each.text for each in found] == [True] if loss else not found


def test_the_loss_is_that_of_a_sine_drawn_with_straight_lines():
    fine = np.arange(0.0, 2.0, 0.0005)
    drawn = np.interp(fine, np.append(TIME, 2.0), np.sin(2 * np.pi * 10.0 * np.append(TIME, 2.0)))
    kept = 2.0 * np.mean(drawn * np.sin(2 * np.pi * 10.0 * fine))
    (finding,) = weakened(np.sin(2 * np.pi * 10.0 * TIME))
    assert f"by {format_percent(1 - kept)} " in finding.text


def test_a_table_at_rest_loses_nothing():
    assert weakened(np.zeros(100)) == []


LONGER = np.arange(0.0, 4.0, 0.005)
OMEGA = 2 * np.pi * 1.5
SWELL = np.sin(OMEGA * LONGER)


def _conditioned(**channels):
    named = {name: ("elapsed", values, {"cutoff_hz": 40.0, "channel": name}) for name, values in channels.items()}
    return xr.Dataset(named, coords={"elapsed": ("elapsed", LONGER)})


def _table(accelerations=(), displacements=()):
    along, across = (dict.fromkeys(names, (1.0, 0.0, 0.0)) for names in (accelerations, displacements))
    on_specimen = {name: {} for name in ("positions", "gyroscopes", "accelerometers")}
    return Transducers(**on_specimen, accelerations=along, displacements=across)


@every(
    ("factor", "severity", "said"), [(1.02, "note", "they agree to 1.0\u00a0%"), (2.0, "warning", "but they differ")]
)
def test_several_accelerometers_are_averaged_and_compared(factor, severity, said):
    warnings = []
    base = base_motion(_conditioned(a=SWELL, b=factor * SWELL), _table(("a", "b")), warnings)
    np.testing.assert_allclose(base["base_acceleration"], (1 + factor) / 2 * SWELL)
    assert (warnings[0].severity, said in warnings[0].text) == (severity, True)


@pytest.mark.parametrize(("accelerometers", "severity"), [((), "note"), (("dead",), "warning")], ids=["meant", "not"])
def test_without_a_usable_accelerometer_the_displacement_is_differentiated(accelerometers, severity):
    warnings = []
    base = base_motion(_conditioned(stroke=SWELL), _table(accelerometers, ("stroke",)), warnings)
    middle = slice(100, -100)
    np.testing.assert_allclose(base["base_acceleration"][middle], -(OMEGA**2) * SWELL[middle], atol=0.02 * OMEGA**2)
    assert [(warning.kind, warning.severity) for warning in warnings] == [("derived base motion", severity)]


def test_an_axis_that_was_not_recorded_does_not_move():
    moved = axes({"vertical_base_acceleration": SWELL}, "acceleration", LONGER)
    np.testing.assert_array_equal(moved, [0 * LONGER, 0 * LONGER, SWELL])


def test_gravity_is_subtracted_unless_the_zero_was():
    upright = {"block": Accelerometer((0.0, 0.0, 1.0), (0.0, 0.0, 0.4))}
    whole = _conditioned(block=SWELL + 9.81)
    np.testing.assert_allclose(group(whole, upright, 9.81).values[0], SWELL, atol=1e-12)
    whole["block"].attrs |= {"zero": 0.1, "rest_value": 9.81}
    np.testing.assert_allclose(group(whole, upright, 9.81).values[0], SWELL, atol=1e-12)


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
