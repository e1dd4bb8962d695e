"""Every stage's file is CF-1.11 by the IOOS checker, and ACDD-1.3 as far as a laboratory's record can be."""

import numpy as np
import pytest
import xarray as xr
from compliance_checker.suite import CheckSuite

from colonnade.findings import warning
from colonnade.store import files
from colonnade.store.provenance import Origin, global_attributes
from colonnade.store.results import ResultId
from small_campaign import STRONG

pytestmark = pytest.mark.whole

TIME = np.arange(400) * 0.005
CLOCK = {"elapsed": TIME}
EXCUSED = ["geospatial"]  # a specimen on a shake table has no place on the globe
# campaign.toml does not tell these.
EXCUSED += ["acknowledg", "creator_", "license", "publisher_", "naming_authority", "comment"]
EXCUSED += ["standard_name_vocabulary"]  # the two names in use are in every version of the table
EXCUSED += ["time_coverage_start", "time_coverage_end"]  # not triggered by a clock that tells the day


def channels(clock, size, name, quantity, unit):
    values = np.sin(np.arange(size) / 9)
    attributes = {"channel": name, "quantity": quantity, "on": "table", "recorder": "main", "quality_report": ""}
    return {
        name: (clock, values, attributes | ({"recorded_unit": unit} if unit else {})),
        f"{name}_recorded": (clock, values),
        f"{name}_quality": (clock, np.ones(size, dtype=np.int8)),
    }


RESULTS = {
    "ingest": xr.Dataset(
        channels("elapsed", 400, "top", "displacement", "V")
        | channels("elapsed", 400, "acceleration", "acceleration", "g's")
        | channels("elapsed_daq2", 50, "spare", "other", "furlong")
        | channels("elapsed_daq2", 50, "sync", "other", None)
        | channels("elapsed_daq2", 50, "gyro", "angular_velocity", "deg/s"),
        coords=CLOCK | {"elapsed_daq2": TIME[:50]},
        attrs={
            "raw_files": ["raw/a.csv"],
            "raw_sha256": ["0" * 64],
            "notes": ["delimiter ';'"],
            "warnings": [warning("other", "ö")],
        },
    ),
    "map": xr.Dataset(
        {
            "outcome": (("frequency_ratio", "amplitude_ratio"), np.array([[0, 1, 2], [0, 1, 1]], dtype=np.int8)),
            "overturning_fraction": (("frequency_ratio", "amplitude_ratio"), np.zeros((2, 3))),
            **{f"{name}_limit": ("frequency_ratio", np.ones(2)) for name in ("no_rocking", "lower", "upper")},
            **{f"interval_{name}": ("interval", np.ones(4)) for name in ("frequency_ratio", "start", "end")},
        },
        coords={"frequency_ratio": [2.0, 3.0], "amplitude_ratio": [0.5, 1.0, 2.0]},
        attrs={"model": "linear", "cycles": 20.0},
    ),
    "failed": None,
}
RUN = [f"tests/free-01/{stage}" for stage in ("conditioned", "rocking", "restitution", "compared", "ensemble-linear")]
RUN += ["tests/free-01/predicted-linear", f"tests/{STRONG}/compared", "specimens/prism"]
"""Files of a real run; those above have what it lacks: odd units, several clocks, a map, a failure."""


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


@pytest.fixture(params=[*RESULTS, *RUN])
def stored(request, tmp_path):
    stage, path = request.param, tmp_path / f"{request.param}.nc"
    if stage in RUN:
        return request.getfixturevalue("filled_campaign")[1].processed / f"{stage}.nc"
    result = RESULTS[stage]
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
        excused = EXCUSED if "elapsed" in opened else [*EXCUSED, "time_coverage"]
    assert [text for text in found.get(2, []) if not any(name in text for name in excused)] == []


def test_the_checker_does_complain_of_a_time_without_a_date(tmp_path):
    path = tmp_path / "bad.nc"
    xr.Dataset({"top": ("time", TIME, {"units": "m"})}, coords={"time": ("time", TIME, {"units": "s"})}).to_netcdf(path)
    assert any("time" in text for texts in complaints(path, "cf:1.11").values() for text in texts)
