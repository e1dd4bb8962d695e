"""Runs of a model as they would have been recorded: with noise, zero, calibration and filter of the measured angle."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import NDArray

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel
from colonnade.signals.filters import lowpass_sections


@dataclass(frozen=True)
class Measurement:
    """
    Errors of a measured rocking angle.

    Attributes
    ----------
    interval : float
        Between samples, s.
    gain : float
        Standard deviation of its calibration, relative.
    zero : float
        Standard deviation of its zero, rad.
    noise : float
        Standard deviation of its noise, after the low-pass, rad.
    drift : ndarray, shape (n,)
        Standard deviation of an error that grows over the record, as of an integrated angle, rad; one draw a record.
    cutoff_hz : float or None
        Of the zero-phase low-pass that it went through; None for none.
    filter_order : int
    start : float or None
        rad, measured angle from which the model starts, in error by the same gain and zero; None if it starts at rest.
    start_error : float
        Standard deviation of what else the start is in error by, rad.
    """

    interval: float
    gain: float
    zero: float
    noise: float
    drift: Array
    cutoff_hz: float | None
    filter_order: int = 4
    start: float | None = None
    start_error: float = 0.0

    @property
    def start_deviation(self) -> float:
        """Standard deviation of the angle that the model starts from, rad."""
        if self.start is None:
            return 0.0
        return float(np.hypot(np.hypot(self.gain * self.start, self.zero), self.start_error))

    def thinned(self, first: int, stride: int) -> Measurement:
        """Return the errors of every `stride`-th sample from `first` on."""
        return replace(self, interval=stride * self.interval, drift=self.drift[first::stride])


def as_measured(
    histories: NDArray[np.float32], starts: Array, measurement: Measurement, random: np.random.Generator
) -> Array:
    """
    Give each run errors of its own.

    Parameters
    ----------
    histories : ndarray, shape (m, n)
        rad.
    starts : ndarray, shape (m,)
        rad, by how much each began above the measured start.
    measurement : Measurement
    random : numpy.random.Generator

    Returns
    -------
    recorded : ndarray, shape (m, n)
        rad.
    """
    angle, error, noise = histories.astype(np.float64), np.empty(histories.shape), np.empty(histories.shape)
    for number, start in enumerate(starts.tolist()):
        gain, zero = _calibration(measurement, start, random)
        angle[number] *= 1 + gain
        error[number] = zero + measurement.drift * random.standard_normal()
        noise[number] = random.standard_normal(angle.shape[1])
    if measurement.cutoff_hz is not None and measurement.cutoff_hz < 0.5 / measurement.interval:
        angle, noise = _filtered(angle, measurement), _filtered(noise, measurement)
        noise /= noise.std(axis=1, keepdims=True)
    return np.asarray(angle + error + measurement.noise * noise)


def _calibration(measurement: Measurement, start: float, random: np.random.Generator) -> tuple[float, float]:
    """Draw errors of gain and zero; of a run that began above the measured start, those that explain it."""
    drawn = random.standard_normal(3) * (measurement.gain, measurement.zero, measurement.start_error)
    total = measurement.start_deviation**2
    if measurement.start is None or total == 0.0:
        return float(drawn[0]), float(drawn[1])
    # Conditional normal draws: what is measured at the start is (1 + gain) θ + zero + the rest, and is known.
    missing = -start - (drawn[0] * measurement.start + drawn[1] + drawn[2])
    return (
        float(drawn[0] + missing * measurement.gain**2 * measurement.start / total),
        float(drawn[1] + missing * measurement.zero**2 / total),
    )


def _filtered(values: Array, measurement: Measurement) -> Array:
    """
    Low-pass what begins at rest or at a peak, shape (m, n): its mirror image goes before it.

    As `signals.filters.lowpass`, but all m at each sample, which takes a tenth of the time.
    """
    assert measurement.cutoff_hz is not None
    longest = int(3 * measurement.filter_order / (measurement.cutoff_hz * measurement.interval))
    memory = min(longest, values.shape[-1] - 1)
    count = values.shape[-1] + memory
    sections, padding = lowpass_sections(count, measurement.interval, measurement.cutoff_hz, measurement.filter_order)
    mirrored = np.concatenate((values[:, memory:0:-1], values), axis=1).T
    before = 2 * mirrored[0] - mirrored[padding:0:-1]
    after = 2 * mirrored[-1] - mirrored[-2 : -padding - 2 : -1]
    extended = np.ascontiguousarray(np.concatenate((before, mirrored, after)))
    settled = np.asarray(scipy.signal.sosfilt_zi(sections))
    for backwards in (False, True):
        _run_filter(extended, sections, settled, backwards)
    return np.ascontiguousarray(extended[padding + memory : padding + count].T)


@kernel
def _run_filter(values: Array, sections: Array, settled: Array, backwards: bool) -> None:
    """
    Run second-order sections, shape (k, 6), over m records, shape (n, m), in place, from their first or last sample on.

    `settled`, shape (k, 2), is the state of the sections that a constant 1 leaves: each record begins as if its first
    value had lasted for ever.
    """
    samples, count = values.shape
    state = np.empty((2 * sections.shape[0], count))
    for row in range(state.shape[0]):
        for record in range(count):
            state[row, record] = settled[row // 2, row % 2] * values[samples - 1 if backwards else 0, record]
    for number in range(samples):
        sample = samples - 1 - number if backwards else number
        for section in range(sections.shape[0]):
            b0, b1, b2, _a0, a1, a2 = sections[section]
            # Direct form II, transposed.
            for record in range(count):
                now = values[sample, record]
                filtered = b0 * now + state[2 * section, record]
                state[2 * section, record] = b1 * now - a1 * filtered + state[2 * section + 1, record]
                state[2 * section + 1, record] = b2 * now - a2 * filtered
                values[sample, record] = filtered
