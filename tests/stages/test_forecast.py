import numpy as np
import pytest
import xarray as xr

from colonnade.campaign.forms.forecast import ForecastBlock, ForecastFile
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.stages.forecast import ForecastScoreInputs, score_forecast
from prism import PRISM

TIME = np.arange(800) / 200
MOTION = Motion(3.0 * np.sin(25 * TIME) * (TIME < 2.0), 1 / 200)
EXACT = dict.fromkeys(("restitution", "critical_angle", "p", "gain", "clock"), 0.0)


def forecast(peaks=(0.2, 0.4, None), rigid=(0.1, 0.1, 0.1)):
    model = {
        **{
            "no_rocking": 0.0,
            "rocking": 0.5,
            "overturned": 0.5,
            "bands": 3 * [{"probability": 0.5, "low": 0.0, "high": 1.0}],
            "required_friction": None,
        },
        **{"peak_ratio": peaks, "rigid_body_peak_ratio": rigid},
    }
    e = {"value": (0.9, 0.9), "low": None, "high": None, "level": 0.95, "source": "given", "rigid_body": (0.8, 0.8)}
    return ForecastFile.model_validate(
        {
            **{"made": "2026-01-02T03:04:05Z", "colonnade": "0", "code": "a" * 64, "test": "t", "specimen": "prism"},
            **{"level": "1x", "raw_files": {}, "models": {"nonlinear": model}},
            "motion": {
                **{"name": "", "source": "", "sha256": "b" * 64, "interval": 0.005, "samples": 800, "time_scale": 1.0}
            },
            "table": {"peak_acceleration": 1.0, "peak_velocity": None, "peak_displacement": None, "drift": 0.0},
            "inputs": {
                **{
                    "block": ForecastBlock.of(PRISM),
                    "restitution": e,
                    "spread": EXACT,
                    "table_tilt": 0.0,
                    "rest_angle": 1e-6,
                },
                **{"members": 3, "seed": 0},
            },
        }
    )


def rocking(**changes):
    history = rock(PRISM, MOTION, restitution=0.9, model="nonlinear")
    assert history.outcome == "rocking"
    values = {
        "rocking_angle": ("elapsed", history.angle),
        "base_acceleration": ("elapsed", MOTION.acceleration),
        "peak_ratio": ((), history.peak_ratio),
    }
    kept = {name: value for name, value in (values | changes).items() if value is not None}
    return xr.Dataset(kept, coords={"elapsed": TIME}, attrs={"outcome": history.outcome})


def scored(measured, given=None):
    return score_forecast(measured, given or forecast(), ForecastScoreInputs(file="f.json"))


def test_scores_are_those_of_the_members_in_the_file():
    measured = rocking()
    peak = float(measured["peak_ratio"])
    found = scored(measured).sel(model="nonlinear")
    members = np.array([0.2, 0.4, 1.0])
    pairs = abs(members[:, None] - members).sum() / (2 * 3 * 2)
    assert float(found["forecast_crps"].sel(basis="on_target")) == pytest.approx(abs(members - peak).mean() - pairs)
    assert float(found["forecast_crps"].sel(basis="on_recorded")) == 0.0  # of a perfect model
    assert float(found["forecast_crps"].sel(basis="rigid_body")) == pytest.approx(abs(0.1 - peak))
    assert float(found["forecast_overturning_probability"].sel(basis="on_target")) == pytest.approx(1 / 3)
    assert 0.0 < float(found["forecast_pit"].sel(basis="on_target")) < 1.0


def test_without_a_recorded_motion_only_the_forecast_is_scored_and_without_an_angle_nothing():
    found = scored(rocking(base_acceleration=None)).sel(model="nonlinear")
    assert "not recorded" in found.attrs["reason"]
    assert np.isnan(found["forecast_crps"].sel(basis="on_recorded"))
    assert np.isfinite(found["forecast_crps"].sel(basis="on_target"))
    unmeasured = scored(rocking(rocking_angle=None))
    assert not unmeasured.data_vars
    assert "not measured" in unmeasured.attrs["reason"]
