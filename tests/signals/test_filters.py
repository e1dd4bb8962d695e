import numpy as np
import pytest

from colonnade.signals.filters import default_lowpass, lowpass, noise_below, second_derivative

TIME = np.arange(0, 4, 0.002)


def test_the_filter_passes_what_is_low_without_delay_and_stops_what_is_high():
    slow, fast = np.sin(2 * np.pi * 3 * TIME), np.sin(2 * np.pi * 120 * TIME)
    smooth = lowpass(slow + fast, 0.002, 30.0)
    middle = slice(200, -200)
    np.testing.assert_allclose(smooth[middle], slow[middle], atol=1e-4)


@pytest.mark.parametrize("cutoff", [0.0, 250.0, 400.0])
def test_a_cut_off_beyond_half_the_sampling_rate_is_refused(cutoff):
    with pytest.raises(ValueError, match="half the sampling rate"):
        lowpass(TIME, 0.002, cutoff)


def test_the_second_derivative_of_a_displacement_is_its_acceleration():
    displacement = 0.01 * np.sin(2 * np.pi * 2 * TIME)
    acceleration = second_derivative(displacement, 0.002, 20.0)
    expected = -((4 * np.pi) ** 2) * displacement
    np.testing.assert_allclose(acceleration[300:-300], expected[300:-300], atol=2e-3 * np.abs(expected).max())


def test_the_default_cut_off_follows_the_specimen_and_stays_below_the_sampling_rate():
    assert default_lowpass(5.631, 500.0) == pytest.approx(35.0, abs=0.2)
    assert default_lowpass(5.631, 50.0) == 20.0


def test_noise_left_below_the_cut_off_is_what_the_filter_leaves():
    noise = np.random.default_rng(0).normal(0, 1.0, 20_000)
    left = lowpass(noise, 0.002, 35.0).std()
    signal = 50 * np.sin(2 * np.pi * np.arange(20_000) * 0.002)
    recorded = np.arange(noise.size) < 9_000
    bridged = np.where(recorded, noise + signal, 0.0)
    for values, counted in ((noise + signal, noise < np.inf), (bridged, recorded)):
        smooth = lowpass(values, 0.002, 35.0)
        assert noise_below(values, smooth, 0.002, 35.0, counted) == pytest.approx(left, rel=0.1)
