"""Maps that a run keeps: those that `colonnade map` makes, of specimens with sine tests at two frequencies or more."""

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.campaign.forms.summary import Summary
from colonnade.store import files
from colonnade.workflow import map_plans as plans
from colonnade.workflow.graph import Graph
from colonnade.workflow.lock import only_run
from colonnade.workflow.map_plans import Wanted
from colonnade.workflow.maps import kept_maps, make_maps
from colonnade.workflow.product import Catalogue
from colonnade.workflow.walk import Walk

pytestmark = pytest.mark.whole

LINEAR = Wanted(models=("linear",))
RARE = Wanted(models=("linear",), points=(3, 4), cycles=2.0)


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
        walk = Walk(Graph(campaign, small.layout, Catalogue(small.layout)), run_id, workers=1, **options)
        walk.map(summary)
    return [(stage.model, stage.action, stage.because) for stage in walk.stages]


def test_sines_at_two_frequencies_make_a_map_by_each_model_in_the_plane(small):
    summary = with_sines(small, 2.0, 3.0)
    done = [("linear", "done", "never run"), ("nonlinear", "done", "never run")]
    assert kept(small, summary) == done
    assert kept(small, summary) == [("linear", "up-to-date", ""), ("nonlinear", "up-to-date", "")]
    stored = files.read(small.layout.stage("prism", "map", "linear"))
    assert stored["frequency_ratio"].to_numpy()[[0, -1]] == pytest.approx([1.8, 3.3])
    assert stored.attrs["restitution_source"] == "identified"


def test_one_frequency_makes_no_map(small):
    assert kept(small, with_sines(small, 2.0, 2.01)) == []
    assert kept(small, with_sines(small)) == []


@pytest.mark.smoke
def test_a_run_and_the_command_give_and_reuse_the_same_map(small):
    summary = with_sines(small, 2.0, 3.0)
    kept(small, summary)
    by_run = files.read(small.layout.stage("prism", "map", "linear"))
    (made,) = make_maps(small.folder, LINEAR, workers=1)
    assert made.action == "up-to-date"
    made.path.unlink()
    (made,) = make_maps(small.folder, LINEAR, workers=1)
    assert made.because == "never run"
    by_command = files.read(made.path)
    assert by_command.attrs["content"] == by_run.attrs["content"]
    assert np.array_equal(by_command["lower_limit"], by_run["lower_limit"], equal_nan=True)
    assert kept(small, summary)[0] == ("linear", "up-to-date", "")


def test_a_map_that_was_asked_for_stays_until_its_specimen_changes(small):
    summary = with_sines(small, 2.0, 3.0)
    (made,) = make_maps(small.folder, RARE, workers=1)
    assert kept(small, summary)[0] == ("linear", "up-to-date", "")
    assert files.read(made.path).sizes["frequency_ratio"] == 3
    small.edit('height = "456 mm"', 'height = "460 mm"')
    assert kept(small, summary)[0] == ("linear", "done", "upstream changed")
    assert files.read(made.path).sizes["frequency_ratio"] > 3


def test_a_specimen_without_e_has_no_map(small):
    summary = with_sines(small, 2.0, 3.0)
    graph = Graph(load(small.folder), small.layout, Catalogue(small.layout))
    assert list(kept_maps(graph, summary, ["prism"]))
    assert list(kept_maps(graph, summary, [])) == []
    record = summary.specimens["prism"]
    refused = record.model_copy(update={"restitution": record.restitution.model_copy(update={"value": None})})
    assert list(kept_maps(graph, summary.model_copy(update={"specimens": {"prism": refused}}), ["prism"])) == []


def test_a_run_that_starts_again_from_the_report_makes_its_maps_again(small):
    summary = with_sines(small, 2.0, 3.0)
    kept(small, summary)
    assert kept(small, summary, start_from="report")[0] == ("linear", "done", "asked for")
