"""A campaign's maps: from what is known of a specimen, in blocks that outlast a kill, the same whatever the workers."""

import json

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.campaign.forms.summary import Summary
from colonnade.campaign.syntax.fields import MOST_CYCLES
from colonnade.dynamics.maps import MapPlan, stability_map, steady_response
from colonnade.dynamics.models import MODELS
from colonnade.errors import CampaignError
from colonnade.identification.response.boundaries import MapPoint
from colonnade.store import files
from colonnade.store.records.stored import as_map, as_response
from colonnade.store.results import ResultId
from colonnade.workflow import maps as plans
from colonnade.workflow.asked import picked
from colonnade.workflow.executors import Where
from colonnade.workflow.graph import Graph
from colonnade.workflow.lock import only_run
from colonnade.workflow.maps import SETTLING, Measured, Wanted, kept_maps, make_maps
from colonnade.workflow.product import Catalogue
from colonnade.workflow.walk import Walk
from every import every
from prism import PRISM

pytestmark = pytest.mark.whole

FEW = Wanted(models=("linear",), omega=(2.0, 5.0), amplitude=(0.8, 2.0), points=(6, 10), cycles=5.0)


def asking(**changes):
    return Wanted(**(FEW.model_dump() | changes))


def all_made(small, wanted, **where):
    return make_maps(load(small.folder), small.layout, wanted, where=Where(workers=1, **where))


def made(small, wanted=FEW, **where):
    (only,) = all_made(small, wanted, **where)
    return only


def test_a_map_takes_the_identified_restitution_and_is_that_of_the_library(small):
    result = made(small)
    assert (result.restitution_source, result.because) == ("identified", "never run")
    stored = as_map(files.read(result.path))
    pooled = files.read(small.layout.stage("prism", "specimen"))
    e = tuple(float(value) for value in pooled["side_restitution"])
    axes = {"frequency_ratio": np.linspace(2.0, 5.0, 6), "amplitude_ratio": np.linspace(0.8, 2.0, 10)}
    expected = stability_map(PRISM, restitution=e, cycles=5.0, **axes)
    for name in ("outcome", "overturning_fraction", "no_rocking", "lower", "upper", "interval_start", "interval_end"):
        np.testing.assert_array_equal(getattr(stored, name), getattr(expected, name), err_msg=name)
    assert stored.options == expected.options


def test_a_map_that_is_there_is_not_made_again_until_something_changes(small):
    assert made(small).because == "never run"
    assert made(small).because == ""
    assert made(small, asking(ramp=1.0)).because == "settings changed"
    assert made(small, asking(ramp=1.0, omega=(2.0, 4.0))).because == "upstream changed"
    assert made(small, asking(ramp=1.0, omega=(2.0, 4.0), amplitude=(0.8, 1.9))).because == "upstream changed"
    small.edit('height = "456 mm"', 'height = "460 mm"')
    assert made(small, asking(ramp=1.0)).because == "upstream changed"


MAP = """
import sys
from pathlib import Path
from colonnade.campaign import load
from colonnade.store.layout import Layout
from colonnade.workflow.executors import Where
from colonnade.workflow.maps import Wanted, make_maps
wanted = Wanted(models=("linear",), omega=(2.0, 5.0), amplitude=(0.8, 2.0), points=(60, 10), cycles=5.0)
where = Where(workers=1, progress=lambda done, total: print(done, flush=True))
make_maps(load(Path(sys.argv[1])), Layout(Path(sys.argv[1])), wanted, where=where)
"""


def test_a_map_that_is_killed_goes_on_where_it_was_and_leaves_nothing_behind(start, small):
    process = start(MAP, small.folder, said=3)
    process.kill()
    process.wait()
    assert not small.layout.stage("prism", "map", "linear").exists()
    wanted = asking(points=(60, 10))
    told = []
    result = made(small, wanted, progress=lambda *state: told.append(state))
    assert 3 <= told[0][0] < 60
    again = files.read(result.path).attrs["content"]
    assert not small.layout.blocks(ResultId("prism", "map", "linear")).exists()
    result.path.unlink()
    assert files.read(made(small, wanted).path).attrs["content"] == again


def test_they_are_those_of_the_library_and_made_once(small):
    _, result = all_made(small, asking(responses=True))
    stored = as_response(files.read(result.path))
    e = tuple(float(value) for value in files.read(small.layout.stage("prism", "specimen"))["side_restitution"])
    axes = {"frequency_ratio": np.linspace(2.0, 5.0, 6), "amplitude_ratio": np.linspace(0.8, 2.0, 10)}
    expected = steady_response(MapPlan(PRISM, restitution=e, **axes), range(6), SETTLING)
    assert set(np.unique(expected.order)) >= {-2, 0, 1}
    for name in ("order", "amplitude"):
        np.testing.assert_array_equal(getattr(stored, name), getattr(expected, name), err_msg=name)
    assert "every cycle" in result.figure.read_text(encoding="utf-8")
    assert [each.because for each in all_made(small, asking(responses=True))] == ["", ""]
    assert [each.because for each in all_made(small, asking(responses=True, phase=1.0))] == ["settings changed"] * 2
    result.path.unlink()
    assert [each.because for each in all_made(small, asking(responses=True, phase=1.0))] == ["", "never run"]


def test_they_depend_on_the_sine_and_on_their_own_settling_and_not_on_the_cycles_of_the_map(small):
    few = {"points": (2, 3)}
    _, before = all_made(small, asking(responses=True, **few))
    settings = json.loads(files.read(before.path).attrs["settings"])
    assert settings["settling"] == SETTLING
    assert settings["model"] == "linear"
    assert settings.keys().isdisjoint({"cycles", "width", "edge"})
    longer, same = all_made(small, asking(responses=True, cycles=6.0, **few))
    assert (longer.because, same.because) == ("settings changed", "")


@pytest.fixture(autouse=True)
def low(monkeypatch):
    """Maps up to A = 1.5, which take a second."""
    monkeypatch.setattr(plans, "USUAL_AMPLITUDE", 1.5)


def with_sines(small, *frequency_ratios):
    """Let the summary take the pulses for sines of these Ω; return it."""
    summary = small.summary()
    for name, ratio in zip(("pulse-01", "pulse-02"), frequency_ratios, strict=False):
        summary["tests"][name] |= {"frequency_ratio": ratio, "amplitude_ratio": 1.2, "outcome": "rocking"}
    read = Summary.model_validate(summary)
    small.layout.summary_json.write_text(read.text(), encoding="utf-8")
    return read


def kept(small, summary, **options):
    """Bring the maps up to date as a run does; return model, action and reason of each."""
    campaign = load(small.folder)
    with only_run(small.layout) as run_id:
        walk = Walk(Graph(campaign, small.layout, Catalogue(small.layout)), run_id, where=Where(workers=1), **options)
        walk.follow([product] for product in kept_maps(walk.graph, summary, campaign.specimens))
    return [(stage.model, stage.action, stage.because) for stage in walk.stages]


def plan_of(small, wanted, *points):
    """The plan of a linear map with these measured points."""
    measured = Measured("prism", [MapPoint("sine-01", *point, "rocking") for point in points], 0.93, "given")
    return plans.plan_of(load(small.folder), small.layout, wanted, "linear", measured)


def test_axes_are_those_that_are_given_else_those_of_the_tests_with_a_margin_else_the_usual_ones(untouched):
    few = Wanted(models=("linear",), points=(3, 4), cycles=2.0)
    usual, given, tested, default = (
        plan_of(untouched, few),
        plan_of(untouched, asking(omega=(3.0, 5.0), amplitude=(1.0, 2.0), points=(3, 4)), (2.0, 9.0)),
        plan_of(untouched, few, (2.0, 1.0), (4.0, 9.0)),
        plan_of(untouched, Wanted(models=("linear",), cycles=2.0)),
    )
    assert (usual.frequency_ratio[0], usual.frequency_ratio[-1]) == plans.USUAL_FREQUENCIES
    assert (usual.amplitude_ratio[0], usual.amplitude_ratio[-1]) == (plans.LOWEST_AMPLITUDE, plans.USUAL_AMPLITUDE)
    assert usual.restitution == (0.93, 0.93)
    np.testing.assert_allclose(given.frequency_ratio, [3.0, 4.0, 5.0])
    np.testing.assert_allclose(given.amplitude_ratio, np.linspace(1.0, 2.0, 4))
    assert (tested.frequency_ratio[0], tested.frequency_ratio[-1]) == (1.8, 4.4)
    assert tested.amplitude_ratio[-1] == 11.0  # 1.2 times 9 is 10.8
    assert (default.frequency_ratio.size, default.amplitude_ratio.size) == MODELS["linear"].map_points


@every(
    ("changes", "said"),
    [
        ({"omega": (1.0, 1e9)}, "--omega: "),
        ({"omega": (3.0, 2.0)}, "--omega: 3 and 2 (SI) were found. The second has to be the larger one."),
        ({"amplitude": (0.0, 1.0)}, "--amplitude: "),
        ({"cycles": 2 * MOST_CYCLES}, "--cycles: "),
        ({"ramp": float("nan")}, "--ramp: "),
        ({"points": (3, 10_001)}, "--points: "),
    ],
)
def test_what_cannot_be_asked_is_refused_by_its_option(changes, said):
    with pytest.raises(CampaignError) as caught:
        picked(Wanted, changes)
    assert str(caught.value).startswith(said)


def test_sines_at_two_frequencies_make_a_map_by_each_model_in_the_plane(small):
    summary = with_sines(small, 2.0, 3.0)
    done = [("linear", "done", "never run"), ("nonlinear", "done", "never run")]
    assert kept(small, summary) == done
    assert kept(small, summary) == [("linear", "up-to-date", ""), ("nonlinear", "up-to-date", "")]
    stored = files.read(small.layout.stage("prism", "map", "linear"))
    assert stored["frequency_ratio"].to_numpy()[[0, -1]] == pytest.approx([1.8, 3.3])
    assert stored.attrs["restitution_source"] == "identified"


@pytest.mark.smoke
def test_a_run_and_the_command_give_and_reuse_the_same_map(small):
    summary = with_sines(small, 2.0, 3.0)
    kept(small, summary)
    by_run = files.read(small.layout.stage("prism", "map", "linear"))
    (made,) = all_made(small, Wanted(models=("linear",)))
    assert (made.because, made.measured) == ("", 2)
    made.path.unlink()
    (made,) = all_made(small, Wanted(models=("linear",)))
    assert made.because == "never run"
    by_command = files.read(made.path)
    assert by_command.attrs["content"] == by_run.attrs["content"]
    assert np.array_equal(by_command["lower_limit"], by_run["lower_limit"], equal_nan=True)
    assert kept(small, summary)[0] == ("linear", "up-to-date", "")


def test_a_map_that_was_asked_for_stays_until_its_specimen_changes(small):
    summary = with_sines(small, 2.0, 3.0)
    (made,) = all_made(small, Wanted(models=("linear",), points=(3, 4), cycles=2.0))
    assert kept(small, summary)[0] == ("linear", "up-to-date", "")
    assert files.read(made.path).sizes["frequency_ratio"] == 3
    small.edit('height = "456 mm"', 'height = "460 mm"')
    assert kept(small, summary)[0] == ("linear", "done", "upstream changed")
    assert files.read(made.path).sizes["frequency_ratio"] > 3


def test_a_specimen_without_e_or_with_one_frequency_has_no_map(small):
    summary = with_sines(small, 2.0, 3.0)
    graph = Graph(load(small.folder), small.layout, Catalogue(small.layout))
    assert list(kept_maps(graph, summary, ["prism"]))
    assert list(kept_maps(graph, with_sines(small, 2.0, 2.01), ["prism"])) == []
    record = summary.specimens["prism"]
    refused = record.model_copy(update={"restitution": record.restitution.model_copy(update={"value": None})})
    assert list(kept_maps(graph, summary.model_copy(update={"specimens": {"prism": refused}}), ["prism"])) == []


def test_a_run_that_starts_again_from_the_report_makes_its_maps_again(small):
    summary = with_sines(small, 2.0, 3.0)
    kept(small, summary)
    assert kept(small, summary, start_from="report")[0] == ("linear", "done", "asked for")
