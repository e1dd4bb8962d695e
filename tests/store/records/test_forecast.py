from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from colonnade.store.records.forecast import FEWEST, SCORES, judge


def campaign(tests, *, recorded=True):
    """As many tests, each with a forecast of members evenly between 0 and 1, and scores that are their numbers."""
    forecasts, scores = {}, {}
    for number in range(1, tests + 1):
        name = f"test-{number}"
        peaks = SimpleNamespace(peak_ratio=tuple(np.linspace(0.01, 0.99, 21)))
        forecasts[name] = SimpleNamespace(models={"linear": peaks})
        values = [[float(number), float(number) if recorded else np.nan, 4.0 * number]]
        variables = {f"forecast_{key}": (("model", "basis"), np.array(values)) for key in SCORES}
        variables |= {"forecast_pit": (("model", "basis"), np.full((1, 3), number / (tests + 1)))}
        scores[name] = xr.Dataset(
            variables | {"observed_amplitude": ((), number / (tests + 1))},
            coords={"model": ["linear"], "basis": ["on_target", "on_recorded", "rigid_body"]},
            attrs={"outcome": "rocking"},
        )
    return forecasts, scores


def test_means_skill_and_coverage():
    judged = judge(*campaign(19))["linear"]
    assert judged.tests == 19
    assert judged.on_target.crps == pytest.approx(10.0)
    assert judged.skill_rigid_body.brier == pytest.approx(0.75)
    assert judged.skill_base_rate.crps < 0
    assert [band.probability for band in judged.coverage] == [0.5, 0.8, 0.95]
    assert [band.share for band in judged.coverage] == pytest.approx([11 / 19, 15 / 19, 19 / 19], abs=2.1 / 19)
    assert all(band.low <= band.share <= band.high for band in judged.coverage)


def test_of_few_tests_only_means_are_given():
    judged = judge(*campaign(FEWEST - 1))["linear"]
    assert (judged.skill_rigid_body, judged.skill_base_rate, judged.coverage) == (None, None, None)
    assert judged.on_target.brier == pytest.approx(FEWEST / 2)


def test_scores_that_are_not_known_do_not_count():
    judged = judge(*campaign(3, recorded=False))["linear"]
    assert judged.on_recorded.crps is None
