"""Every stage's file is CF-1.11 by the IOOS checker, and ACDD-1.3 as far as a laboratory's record can be."""

import numpy as np
import pytest
import xarray as xr
from compliance_checker.suite import CheckSuite

from colonnade.store import files
from colonnade.store.provenance import Origin, global_attributes
from colonnade.store.results import ResultId

TIME = np.arange(400) * 0.005
CLOCK = {"elapsed": TIME}
GEOSPATIAL = "geospatial"  # a specimen on a shake table has no place on the globe
UNKNOWN = (
    "acknowledg",
    "creator_",
    "license",
    "publisher_",
    "naming_authority",
    "comment",
)  # campaign.toml does not tell
VOCABULARY = "standard_name_vocabulary"  # the two names in use are in every version of the table
UNTRIGGERED = ("time_coverage_start", "time_coverage_end")


def channels(clock, size, name, quantity, unit):
    values = np.sin(np.arange(size) / 9)
    attributes = {"channel": name, "quantity": quantity, "on": "table", "recorder": "main", "quality_report": ""}
    return {
        name: (clock, values, attributes | ({"recorded_unit": unit} if unit else {})),
        f"{name}_recorded": (clock, values),
        f"{name}_quality": (clock, np.ones(size, dtype=np.int8)),
    }


def scalars(*names):
    return dict.fromkeys(names, ((), 0.5))


RESULTS = {
    "ingest": xr.Dataset(
        channels("elapsed", 400, "top", "displacement", "V")
        | channels("elapsed", 400, "acceleration", "acceleration", "g's")
        | channels("elapsed_daq2", 50, "spare", "other", "furlong")
        | channels("elapsed_daq2", 50, "sync", "other", None)
        | channels("elapsed_daq2", 50, "gyro", "angular_velocity", "deg/s"),
        coords=CLOCK | {"elapsed_daq2": TIME[:50], "time": 1.7e9},
        attrs={"raw_files": ["raw/a.csv"], "raw_sha256": ["0" * 64], "notes": ["delimiter ';'"], "warnings": ["ö"]},
    ),
    "condition": xr.Dataset(channels("elapsed", 400, "top", "displacement", "V"), coords=CLOCK).drop_vars(
        "top_recorded"
    ),
    "rocking": xr.Dataset(
        {
            **dict.fromkeys(
                ("rocking_angle", "rocking_angle_quality", "slide", "base_acceleration", "base_displacement"),
                ("elapsed", TIME),
            ),
            "impact_time": ("impact", np.array([])),
            **scalars("rocking_angle_drift"),
            **scalars("rocking_angle_standard_error", "slide_standard_error", "peak_angle", "peak_ratio", "peak_time"),
            **scalars("peak_ground_acceleration", "overturning_time", "noise_threshold"),
        },
        coords=CLOCK,
        attrs={"outcome": "", "separation": "angle and slide"},
    ),
    "restitution": xr.Dataset(
        {
            **{
                name: ("peak", np.ones(3))
                for name in ("peak_time", "peak_angle", "peak_angle_standard_error", "fitted_angle", "peak_used")
            },
            **scalars("restitution", "restitution_low", "restitution_high", "restitution_standard_error", "level"),
            **scalars("zero_offset"),
            **{
                f"restitution_history{part}": ("model", np.ones(2))
                for part in ("", "_low", "_high", "_standard_error", "_residual")
            },
        },
        coords={"model": np.array(["linear", "nonlinear"], dtype=object)},
        attrs={"method": "peaks", "reason": "", "history_method": "whole history", "history_reason": ""},
    ),
    "specimen": xr.Dataset(
        {
            **{name: ("test", np.ones(2)) for name in ("test_restitution", "test_restitution_standard_error")},
            "side_restitution": ("side", np.ones(2)),
            **scalars("restitution", "restitution_low", "restitution_high", "level", "rigid_restitution"),
            **scalars("critical_angle", "pole_distance", "inertia", "p"),
        },
        coords={"test_id": ("test", np.array(["free-01", "free-02"], dtype=object))},
        attrs={"source": "identified"},
    ),
    "predict": xr.Dataset(
        {
            **dict.fromkeys(("rocking_angle", "base_acceleration"), ("elapsed", TIME)),
            "impact_time": ("impact", np.ones(4)),
            **scalars("restitution", "peak_angle", "peak_ratio", "peak_time", "overturning_time", "impact_count"),
            **scalars("zero_offset"),
        },
        coords=CLOCK,
    ),
    "compare": xr.Dataset(
        {
            **{
                name: ("model", np.ones(1))
                for name in (
                    "nrmse",
                    "predicted_peak_ratio",
                    "peak_ratio_error",
                    "compared_until",
                    "horizon",
                    "within_spread",
                    "peak_rank",
                )
            },
            "predicted_outcome": ("model", np.array(["rocking"], dtype=object)),
            "predicted_response_order": ("model", np.array(["3"], dtype=object)),
            "response_misfit": ("order", np.ones(4)),
            **scalars("measured_peak_ratio", "measured_peak_time", "release_ratio", "zero_offset"),
            **scalars("forcing_frequency", "forcing_amplitude", "forcing_amplitude_spread"),
            **scalars("forcing_distortion", "steady_start", "steady_stop", "frequency_ratio", "amplitude_ratio"),
            **scalars("impacts_per_cycle"),
        },
        coords={"model": np.array(["linear"], dtype=object)},
        attrs={"response_order": "3", "response_order_reason": "The angle repeats every 3 periods of the table."},
    ),
    "ensemble": xr.Dataset(
        {
            "rocking_angle": ("elapsed", TIME),
            "rocking_angle_band": (("quantile", "elapsed"), np.stack([TIME, TIME])),
            **scalars("overturning_probability", "overturning_probability_low", "overturning_probability_high"),
            **scalars("horizon", "measured_distance"),
            **{name: ("judged_member", np.ones(4)) for name in ("judged_peak_ratio", "member_distance")},
            **{f"member_{name}": ("member", np.ones(5)) for name in ("peak_ratio", "overturning_time")},
            **{name: ("input", np.ones(2)) for name in ("input_deviation", "peak_sensitivity")},
        },
        coords=CLOCK | {"quantile": [0.05, 0.95], "input": np.array(["restitution", "p"], dtype=object)},
        attrs={"model": "linear", "members": 5, "noise": 0.01, "cutoff_hz": None},
    ),
    "map": xr.Dataset(
        {
            "outcome": (("frequency_ratio", "amplitude_ratio"), np.array([[0, 1, 2], [0, 1, 1]], dtype=np.int8)),
            "overturning_fraction": (("frequency_ratio", "amplitude_ratio"), np.zeros((2, 3))),
            **{f"{name}_limit": ("frequency_ratio", np.ones(2)) for name in ("no_rocking", "lower", "upper")},
            **{f"interval_{name}": ("interval", np.ones(4)) for name in ("frequency_ratio", "start", "end")},
        },
        coords={"frequency_ratio": [2.0, 3.0], "amplitude_ratio": [0.5, 1.0, 2.0]},
        attrs={"model": "linear", "cycles": 20.0, "base_motion": "sine"},
    ),
    "failed": None,
}


def complaints(path, checker):
    """What the checker misses, by priority (3: highly recommended, 2: recommended); it needs no network."""
    CheckSuite.load_all_available_checkers()
    suite = CheckSuite()
    dataset = suite.load_dataset(str(path))
    found = {}
    try:
        results, errors = suite.run_all(dataset, [checker])[checker]
    finally:
        dataset.close()
    assert errors == {}
    for result in results:
        if result.value is False or (isinstance(result.value, tuple) and result.value[0] < result.value[1]):
            found.setdefault(result.weight, []).extend(result.msgs or [str(result.name)])
    return found


@pytest.fixture(params=list(RESULTS))
def stored(request, tmp_path):
    stage, result = request.param, RESULTS[request.param]
    path = tmp_path / f"{stage}.nc"
    made_by = "rocking" if result is None else stage
    attributes = global_attributes(Origin("prism", "Prism", "Laboratory"), ResultId("free-01", made_by))
    if result is None:
        files.write_failed(path, "The clock runs backwards.", attributes=attributes)
    else:
        files.write(result, path, attributes=attributes)
    return path


def test_a_stages_file_is_cf(stored):
    assert complaints(stored, "cf:1.11") == {}


def test_a_stages_file_has_what_acdd_asks_for_and_a_laboratory_knows(stored):
    found = complaints(stored, "acdd:1.3")
    # CF has no names for rocking, and a unit that the recorder invented has no spelling in UDUNITS.
    unnamed = {"standard_name"} | ({"units"} if stored.stem == "ingest" else set())
    assert set(found.pop(3, [])) <= unnamed
    with xr.open_dataset(stored, decode_times=False) as opened:
        excused = (GEOSPATIAL, VOCABULARY, *UNKNOWN, *(() if "time" in opened else UNTRIGGERED))
        excused += () if "elapsed" in opened else ("time_coverage",)
    assert [text for text in found.get(2, []) if not any(name in text for name in excused)] == []


def test_the_checker_does_complain_of_a_time_without_a_date(tmp_path):
    path = tmp_path / "bad.nc"
    xr.Dataset({"top": ("time", TIME, {"units": "m"})}, coords={"time": ("time", TIME, {"units": "s"})}).to_netcdf(path)
    assert any("time" in text for texts in complaints(path, "cf:1.11").values() for text in texts)
