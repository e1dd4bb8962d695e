"""A Kalman smoother for states whose changes are measured, and whose values are known now and then."""

from __future__ import annotations

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.kernel import kernel


def smooth(
    transition: Array, inputs: Array, process: Array, readings: Array, variances: Array, start: Array
) -> tuple[Array, Array]:
    """
    Estimate all states of a linear system from all readings.

    Parameters
    ----------
    transition : ndarray, shape (s, s)
        State from one sample to the next, x' = F x + u.
    inputs : ndarray, shape (n, s)
        u from each sample to the next; the last is not used.
    process : ndarray, shape (n, s, s)
        Covariance of the noise of each step.
    readings, variances : ndarray, shape (n, s)
        Of each state alone; a variance of infinity means no reading.
    start : ndarray, shape (s,)
        Variance of each state before the first reading, about zero.

    Returns
    -------
    states : ndarray, shape (n, s)
    deviations : ndarray, shape (n, s)
        Their standard deviations.

    Notes
    -----
    Filter forwards with updates one reading at a time, then back by Rauch, Tung & Striebel (1965):
    the least-squares solution over the whole record.
    """
    states, covariances = _smooth(transition, inputs, process, readings, variances, start)
    return states, np.sqrt(np.maximum(np.diagonal(covariances, axis1=1, axis2=2), 0.0))


@kernel
def _smooth(
    transition: Array, inputs: Array, process: Array, readings: Array, variances: Array, start: Array
) -> tuple[Array, Array]:
    count, size = readings.shape
    states, ahead = np.zeros((count, size)), np.zeros((count, size))
    covariances, ahead_covariances = np.zeros((count, size, size)), np.zeros((count, size, size))
    ahead_covariances[0] = np.diag(start)
    gains, spare = np.zeros((size, size)), np.zeros((size, size))
    # Forwards: each state from the one before, then from its own readings.
    for index in range(count):
        if index > 0:
            ahead[index] = inputs[index - 1]
            _predict(
                transition, states[index - 1], covariances[index - 1], ahead[index], ahead_covariances[index], spare
            )
            ahead_covariances[index] += process[index - 1]
        states[index], covariances[index] = ahead[index], ahead_covariances[index]
        for row in range(size):
            if np.isfinite(variances[index, row]):
                _update(states[index], covariances[index], row, readings[index, row], variances[index, row])
    # Backwards: each state from what is known of the one after.
    for index in range(count - 2, -1, -1):
        # The gain C Fᵀ P⁻¹ is the transpose of the solution of P x = F C, as C and P are symmetric.
        _product(transition, covariances[index], gains)
        spare[:] = ahead_covariances[index + 1]
        _solve_in_place(spare, gains)
        spare[:] = covariances[index + 1] - ahead_covariances[index + 1]
        _correct(gains, states[index + 1] - ahead[index + 1], spare, states[index], covariances[index])
    return states, covariances


@kernel
def _predict(
    transition: Array, state: Array, covariance: Array, ahead: Array, ahead_covariance: Array, spare: Array
) -> None:
    """Add F x to the state ahead, and set its covariance to F C Fᵀ; `spare` is overwritten."""
    _product(transition, covariance, spare)
    _product(spare, transition.T, ahead_covariance)
    for row in range(state.size):
        for column in range(state.size):
            ahead[row] += transition[row, column] * state[column]


@kernel
def _correct(gains: Array, missed: Array, change: Array, state: Array, covariance: Array) -> None:
    """Add Gᵀ times what a state missed, and Gᵀ times a change of its covariance times G."""
    size = missed.size
    for row in range(size):
        for column in range(size):
            state[row] += gains[column, row] * missed[column]
            for one in range(size):
                for other in range(size):
                    covariance[row, column] += gains[one, row] * change[one, other] * gains[other, column]


@kernel
def _update(state: Array, covariance: Array, row: int, reading: float, variance: float) -> None:
    """Take in a reading of one state: (I − k hᵀ) C (I − k hᵀ)ᵀ + k kᵀ variance, written out."""
    size = state.size
    gain, seen = np.zeros(size), np.zeros(size)
    whole, missed = covariance[row, row] + variance, reading - state[row]
    for one in range(size):
        seen[one] = covariance[one, row]
        gain[one] = seen[one] / whole
        state[one] += gain[one] * missed
    for one in range(size):
        for other in range(size):
            covariance[one, other] += (
                gain[one] * gain[other] * whole - gain[one] * seen[other] - seen[one] * gain[other]
            )


@kernel
def _product(one: Array, other: Array, result: Array) -> None:
    size = one.shape[0]
    for row in range(size):
        for column in range(size):
            result[row, column] = 0.0
            for inner in range(size):
                result[row, column] += one[row, inner] * other[inner, column]


@kernel
def _solve_in_place(matrix: Array, right: Array) -> None:
    """Gauss elimination of a symmetric positive definite matrix; the solution takes the place of the right side."""
    size = matrix.shape[0]
    for pivot in range(size):
        for row in range(pivot + 1, size):
            factor = matrix[row, pivot] / matrix[pivot, pivot]
            for column in range(size):
                matrix[row, column] -= factor * matrix[pivot, column]
                right[row, column] -= factor * right[pivot, column]
    for row in range(size - 1, -1, -1):
        for column in range(size):
            for later in range(row + 1, size):
                right[row, column] -= matrix[row, later] * right[later, column]
            right[row, column] /= matrix[row, row]
