"""The data of a test's page hold what is stored, in the units that the page names."""

import json

import numpy as np
import pytest
import xarray as xr

from colonnade.figures.stored.subject import OfTest
from colonnade.report.interactive import panels, test_data
from colonnade.report.interactive.panels import Samples
from colonnade.report.test_page.channels import FLAGS
from colonnade.store.records.stored import Stored


def data_of(one):
    """Data of a page as its script reads them."""
    return json.loads(test_data.of_test(one, []).removeprefix("colonnade.show(").removesuffix(");\n"))


@pytest.fixture(scope="module")
def shaken(reported, unpacked):
    one = reported["span-2.0"]
    given, channels = data_of(one), (one.stored.datasets[stage, None] for stage in ("ingest", "condition"))
    return given, unpacked(given["series"], given["samples"]), *channels


def panels_of(given, group):
    return {panel["title"]: panel for each in given["groups"] if each["title"] == group for panel in each["panels"]}


def test_the_angle_has_every_model_with_its_bands(shaken):
    panel = panels_of(shaken[0], "Response")["Rocking angle θ/α"]
    assert [curve["name"] for curve in panel["curves"]] == ["measured", "linear model", "nonlinear model"]
    assert [band["name"] for band in panel["bands"]][-2:] == [
        "nonlinear model, 95\u00a0% of runs",
        "nonlinear model, 50\u00a0% of runs",
    ]
    assert [band["is_hidden"] for band in panel["bands"]] == [True, True, False, True]


def test_conditioned_channels_are_in_the_unit_of_their_panel(shaken):
    given, series, _, conditioned = shaken
    panel = panels_of(given, "Channels, conditioned")["Displacement, conditioned"]
    assert panel["unit"] == "mm"
    for curve in panel["curves"]:
        expected = 1e3 * conditioned[curve["name"]].to_numpy()
        np.testing.assert_allclose(series[curve["values"]], expected, atol=1e-6 * np.nanmax(np.abs(expected)))


def test_recorded_channels_have_the_units_of_the_file_and_of_the_quantity(shaken):
    given, series, recorded, _ = shaken
    panel = panels_of(given, "Channels, as recorded")["top, as recorded"]
    assert (panel["unit"], panel["second"]["unit"]) == ("V", "mm")
    values = series[panel["curves"][0]["values"]]
    np.testing.assert_allclose(values, recorded["top_recorded"], atol=2e-6 * np.abs(values).max())
    converted = panel["second"]["factor"] * values + panel["second"]["offset"]
    np.testing.assert_allclose(converted, 1e3 * recorded["top"], atol=1e-5 * np.abs(converted).max())


def test_flagged_samples_are_those_that_are_not_good(shaken):
    given, _, recorded, _ = shaken
    for channel in ("top", "bottom", "table_acceleration"):
        flags = np.ones(recorded[f"{channel}_quality"].size, dtype=int)
        for first, last, flag in panels_of(given, "Channels, as recorded")[f"{channel}, as recorded"]["flags"]:
            flags[first:last] = next(number for number, said in FLAGS.items() if said == flag)
        assert np.array_equal(flags, recorded[f"{channel}_quality"])
        assert (flags > 1).any()


def test_a_test_without_transducers_on_the_specimen_shows_the_models_on_the_table(reported):
    given = data_of(reported["watched"])
    assert [body["name"] for body in given["moving"]["bodies"]] == ["linear model", "nonlinear model"]
    assert given["moving"]["how"] == "base: recorded acceleration integrated twice"
    assert given["critical"] == [0.21, 0.23]


def test_what_is_too_much_for_a_page_is_left_out_and_said_so(reported, shaken, monkeypatch):
    count = sum(one["count"] for one in shaken[0]["series"])
    monkeypatch.setattr(panels, "MOST", int(0.9 * count))
    given = data_of(reported["span-2.0"])
    assert sum(one["count"] for one in given["series"]) <= 0.9 * count
    left = [group["title"] for group in given["groups"] if not group["panels"]]
    assert left == ["Channels, as recorded"]
    assert given["groups"][-1]["note"] == test_data.TOO_MANY
    monkeypatch.setattr(panels, "MOST", 10)
    assert data_of(reported["span-2.0"])["groups"] == []


def recorded_channel(time, values, **attributes):
    """A channel of one recorder with a unit gain."""
    dataset = xr.Dataset({"c": ("elapsed", values), "c_recorded": ("elapsed", values)}, {"elapsed": time})
    dataset["c"].attrs = {"channel": "c", "quantity": "displacement", "recorded_unit": "m", **attributes}
    return dataset


def panels_as_recorded(recorded, conditioned=None, samples=None):
    datasets = {("ingest", None): recorded} | ({("condition", None): conditioned} if conditioned else {})
    return test_data._recorded(OfTest(None, None, None, Stored(datasets)), samples or Samples())


def test_recorded_samples_are_put_on_the_common_clock():
    time = 0.01 * np.arange(200)
    recorded = recorded_channel(time, np.sin(time))
    late = {"clock_offset": 0.5, "clock_rate_ppm": 1e4, "clock_offset_at": 1.0}
    conditioned = xr.Dataset({"c": ("elapsed", np.zeros(3), late)}, {"elapsed": [0.0, 0.01, 0.02]})
    samples = Samples()
    panels_as_recorded(recorded, conditioned, samples)
    (clock,) = samples.clocks
    # Delay at time t: 0.5 + 0.01 (t − 1).
    assert clock["start"] == pytest.approx(0.0 - 0.5 + 0.01)
    assert clock["interval"] == pytest.approx(0.01 * 0.99)


@pytest.mark.parametrize("time", [np.empty(0), np.array([0.0, np.nan])], ids=["no sample", "no time"])
def test_a_channel_that_cannot_be_drawn_has_no_panel(time):
    assert panels_as_recorded(recorded_channel(time, np.ones(time.size))) == []


def test_a_channel_that_was_corrected_in_part_has_no_second_axis():
    dataset = recorded_channel(np.arange(4.0), np.array([0.0, 1.0, 2.0, 3.0]))
    dataset["c"] = dataset["c"].copy(data=[0.0, 1.0, -2.0, 3.0])
    dataset["c"].attrs = {"channel": "c", "quantity": "displacement", "recorded_unit": "V"}
    (panel,) = panels_as_recorded(dataset)
    assert "second" not in panel
