import numpy as np
import pytest

from colonnade.signals.metrics import nrmse


def test_nrmse_is_the_root_mean_square_over_the_scale():
    assert nrmse([0.0, 0.0], [0.3, -0.3], 0.1) == pytest.approx(3.0)


def test_samples_missing_in_either_do_not_count():
    assert nrmse([0.0, np.nan, 0.0], [0.3, 9.0, np.nan], 0.1) == pytest.approx(3.0)
    assert np.isnan(nrmse([np.nan], [1.0], 0.1))
