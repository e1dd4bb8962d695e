"""Figures of spectra: what they show, as their tables give it."""

import numpy as np
import pytest

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.pulses import overturning_spectrum
from colonnade.dynamics.spectra import rocking_spectrum
from colonnade.figures.files.table import columns_of
from colonnade.figures.maps import stability_map as spectra
from prism import PRISM


def test_a_rocking_spectrum_shows_peaks_and_which_blocks_overturn():
    motion = Motion(4.0 * np.sin(4 * np.pi * np.linspace(0, 1, 201)), 0.005)
    spectrum = rocking_spectrum(motion, critical_angle=[0.15, 0.25], period=[0.5, 0.8, 9.0])
    table = columns_of(spectra.rocking_spectrum(spectrum, period=4.0, title=""))
    shown = table["largest |θ|/α, α = 0.25 rad"]
    np.testing.assert_allclose(shown, spectrum.peak_ratio[1])
    fallen = table["size 2π/p (s), α = 0.15 rad: overturned"]
    np.testing.assert_array_equal(fallen, spectrum.period[spectrum.overturned[0]])
    assert len(fallen) >= 2


def test_an_overturning_spectrum_shows_both_limits_and_every_interval():
    spectrum = overturning_spectrum(PRISM, "sine", frequency_ratio=[2.0, 3.0, 4.0], largest=6.0)
    figure = spectra.overturning_spectrum(spectrum)
    table = columns_of(figure)
    np.testing.assert_allclose(table["A = a / (g tan α), lower limit"], spectrum.lower)
    np.testing.assert_allclose(table["A = a / (g tan α), upper limit"], spectrum.upper)
    edges = table["A = a / (g tan α), edges of the intervals that overturn"]
    assert sorted(edges) == pytest.approx(sorted([*spectrum.interval_start, *spectrum.interval_end]))
    assert "sine; linear model; e = 0.9" in figure.axes[0].get_title(loc="left")
