"""Names that CF takes, units that UDUNITS reads, nothing stored undescribed."""

import re

import netCDF4
import numpy as np
import pytest
import xarray as xr
from compliance_checker.cfunits import Unit
from hypothesis import example, given
from hypothesis import strategies as st

from colonnade.dynamics.models import MODELS
from colonnade.errors import StoreError
from colonnade.store.description import VARIABLES, describe, udunits, variable_name
from colonnade.store.results import STAGES

CHANNEL_IDS = st.from_regex(r"[A-Za-z0-9][A-Za-z0-9._-]{0,8}((_channel)|(_quality)|(_recorded)){0,2}", fullmatch=True)


@given(CHANNEL_IDS)
def test_every_channel_id_gives_a_name_that_cf_takes_and_no_table_entry_of_a_clock(channel_id):
    name = variable_name(channel_id)
    assert re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", name)
    assert not re.fullmatch(r"time|elapsed(_.*)?|.*_(recorded|quality|standard_error)", name, re.IGNORECASE)


@given(CHANNEL_IDS, CHANNEL_IDS)
@example("time", "time_channel")
@example("2nd", "id_2nd")
@example("elapsed", "elapsed_channel")
def test_channels_that_differ_after_mapping_get_different_names(first, second):
    mapped = [re.sub(r"[.-]", "_", channel_id).casefold() for channel_id in (first, second)]
    assert (variable_name(first).casefold() == variable_name(second).casefold()) == (mapped[0] == mapped[1])


@pytest.mark.parametrize(
    ("recorded", "number", "si"),
    [
        ("g", 9.80665, "m s-2"),
        ("Gal", 0.01, "m s-2"),
        ("mm", 1e-3, "m"),
        ("mV", 1e-3, "V"),
        ("deg/s", np.pi / 180, "rad s-1"),
    ],
)
def test_a_recorded_unit_means_the_same_to_udunits(recorded, number, si):
    assert Unit(udunits(recorded)).convert(1.0, Unit(si)) == pytest.approx(number, rel=1e-12)


def test_a_unit_that_nobody_knows_is_not_spelt():
    assert udunits("furlong per fortnight") == ""


def test_a_channel_is_described_with_what_goes_with_it():
    dataset = xr.Dataset(
        {
            "top": ("elapsed", np.zeros(3), {"channel": "top", "quantity": "displacement", "recorded_unit": "V"}),
            "top_recorded": ("elapsed", np.zeros(3)),
            "top_quality": ("elapsed", np.ones(3, dtype=np.int64)),
        },
        coords={"elapsed": np.arange(3.0)},
    )
    described = describe(dataset)
    assert described["top"].attrs["units"] == "m"
    assert described["top"].attrs["ancillary_variables"] == "top_quality"
    assert described["top_recorded"].attrs["units"] == "V"
    assert described["top_quality"].dtype == np.int8
    assert described["top_quality"].attrs["flag_values"].tolist() == [1, 2, 3, 4, 9]
    assert described["elapsed"].attrs["units"] == "s"
    assert dataset["elapsed"].attrs == {}, "the stage's own dataset is left alone"


def test_a_model_is_not_called_a_measurement():
    dataset = xr.Dataset({"rocking_angle": ("elapsed", np.zeros(2))})
    for stage, kind in (("rocking", "physicalMeasurement"), ("predict", "modelResult")):
        assert describe(dataset, stage)["rocking_angle"].attrs["coverage_content_type"] == kind


def test_a_variable_that_nobody_describes_is_refused_with_the_nearest_name():
    with pytest.raises(StoreError, match=r"'rocking_angel'.*Did you mean \"rocking_angle\""):
        describe(xr.Dataset({"rocking_angel": ("elapsed", np.zeros(2))}))


def test_every_unit_of_the_table_is_one_that_udunits_reads():
    assert all(Unit(variable.units) is not None for variable in VARIABLES.values())


def test_every_variable_is_of_some_stage_and_every_stage_has_some():
    assert {stage for each in VARIABLES.values() for stage in each.stages} == set(STAGES)
    assert [name for name, each in VARIABLES.items() if not each.stages] == []


def stage_of(path, processed):
    """Stage whose file this is."""
    place = path.relative_to(processed).with_suffix("").as_posix()
    any_one = {"subject": r".+", "model": f"({'|'.join(MODELS)})"}
    [fitting] = [stage for stage, entry in STAGES.items() if re.fullmatch(entry.file.format(**any_one), place)]
    return fitting


@pytest.mark.parametrize("campaign", ["filled_campaign", "assessed", "foreseen"])
def test_no_file_has_a_variable_that_its_stage_does_not_have(campaign, request):
    made = request.getfixturevalue(campaign)
    folder = made[1].home if campaign == "filled_campaign" else made if campaign == "assessed" else made[0]
    processed = folder / "processed"
    seen = set()
    for path in processed.rglob("*.nc"):
        stage = stage_of(path, processed)
        seen.add(stage)
        with netCDF4.Dataset(path) as stored:
            known = set(stored.variables) & VARIABLES.keys()
        assert {name for name in known if stage not in VARIABLES[name].stages} == set(), path
    assert {"ingest", "condition", "rocking", "specimen"} <= seen
