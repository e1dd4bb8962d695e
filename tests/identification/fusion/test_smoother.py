import numpy as np

from colonnade.identification.fusion.smoother import smooth


def test_the_smoother_is_the_least_squares_solution_of_the_whole_record():
    rng = np.random.default_rng(0)
    count, size = 40, 3
    transition = np.array([[1.0, 0.1, 0.005], [0.0, 1.0, 0.1], [0.0, 0.0, 1.0]])
    inputs = rng.normal(size=(count, size))
    process = np.array([np.diag(rng.uniform(0.1, 1.0, size)) for _ in range(count)])
    readings = rng.normal(size=(count, size))
    variances = np.where(rng.random((count, size)) < 0.3, rng.uniform(0.1, 1.0, (count, size)), np.inf)
    start = np.array([4.0, 2.0, 1.0])

    rows, right = [np.eye(count * size)[row] / np.sqrt(start[row]) for row in range(size)], [0.0] * size
    for index in range(count):
        for row in range(size):
            if np.isfinite(variances[index, row]):
                rows.append(np.eye(count * size)[index * size + row] / np.sqrt(variances[index, row]))
                right.append(readings[index, row] / np.sqrt(variances[index, row]))
    for index in range(count - 1):
        for row in range(size):
            step = np.zeros(count * size)
            step[(index + 1) * size + row] = 1.0
            step[index * size : (index + 1) * size] -= transition[row]
            scale = np.sqrt(process[index, row, row])
            rows.append(step / scale)
            right.append(inputs[index, row] / scale)
    matrix = np.array(rows)
    covariance = np.linalg.inv(matrix.T @ matrix)
    expected = covariance @ matrix.T @ np.array(right)

    states, deviations = smooth(transition, inputs, process, readings, variances, start)
    np.testing.assert_allclose(states.ravel(), expected, atol=1e-10)
    np.testing.assert_allclose(deviations.ravel(), np.sqrt(np.diagonal(covariance)), rtol=1e-9)
