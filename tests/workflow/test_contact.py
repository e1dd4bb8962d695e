"""The contact model in a campaign: its law by specimen, its predictions beside the others, its maps."""

import json

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.dynamics.contact.body import rigid_body
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.motion import Motion
from colonnade.errors import CampaignError
from colonnade.stages.assessment_plan import AssessmentInputs
from colonnade.stages.contact import law_of
from colonnade.store import files
from colonnade.store.records.assessment import sentences
from colonnade.store.records.test import record_of_specimen
from colonnade.store.results import ResultId
from colonnade.workflow.advising import advise_kind
from colonnade.workflow.assessing import Where, assess
from colonnade.workflow.calibration import calibrate
from colonnade.workflow.check import check
from colonnade.workflow.graph import one_specimen, restitution_taken
from colonnade.workflow.maps import Wanted, make_maps
from prism import PRISM

pytestmark = pytest.mark.whole


@pytest.mark.smoke
def test_a_campaign_is_predicted_by_the_contact_model_beside_the_others(in_space):
    redone = in_space.redone()
    assert redone["prism", "contact"] == "never run"
    law = files.read(in_space.layout.stage("prism", "contact"))
    assert float(law["damping_fraction"]) == 0.3
    assert 0.9 < float(law["contact_restitution"]) < 1.0

    predicted = files.read(in_space.layout.stage("pulse-01", "predict", "contact"))
    rocking = files.read(in_space.layout.stage("pulse-01", "rocking"))
    time = rocking["elapsed"].to_numpy()
    motion = Motion(rocking["base_acceleration"].to_numpy(), float(time[1] - time[0]))
    history = simulate(rigid_body(PRISM), motion, law=law_of(law), gravity=PRISM.gravity, step=3e-5)
    np.testing.assert_array_equal(predicted["rocking_angle"].to_numpy(), history.angle)
    np.testing.assert_array_equal(predicted["uplift"].to_numpy(), history.uplift)
    assert predicted.attrs["outcome"] == history.outcome
    assert 0.0 <= float(predicted["energy_residual"]) < 0.01
    assert float(law["effective_damping"]) == law_of(law).effective_damping(rigid_body(PRISM))

    summary = in_space.summary()
    for test in ("free-01", "pulse-01"):
        assert set(summary["tests"][test]["predicted"]) == {"nonlinear", "contact"}
    assert not in_space.layout.stage("pulse-01", "ensemble", "contact").exists()
    assert in_space.redone() == {}


def test_an_ensemble_of_the_contact_model_is_reported_and_its_members_outlast_an_interrupt(in_space):
    in_space.edit("members = 20", "members = 5\ncontact = {members = 3}")
    in_space.edit('step = "30 us", penetration = 1e-6', 'step = "90 us", penetration = 1e-5')
    in_space.run(until="report")
    path, counted = in_space.layout.stage("pulse-01", "ensemble", "contact"), []
    bands = files.read(path)
    assert bands.sizes["member"] == 3
    told = in_space.summary()["tests"]["pulse-01"]["predicted"]["contact"]
    assert told["overturning_probability"] == float(bands["overturning_probability"])
    assert told["horizon"] == float(bands["horizon"])
    report = in_space.layout.report.parent
    page = (report / "tests" / "pulse-01.html").read_text(encoding="utf-8")
    assert "Contact model: predicted up to" in page
    methods = (report / "methods.html").read_text(encoding="utf-8")
    assert "run 3 times with varied friction (± 20\u00a0%), damping fraction (± 20\u00a0%)" in methods
    assert "and the nonlinear and contact models" in methods
    assert "Each model except the contact model was run 5 times" in methods
    assert "α 0.5\u00a0%; p 0.5\u00a0%;" in methods
    assert "here: rigid body" in methods
    assert "time step 90 µs" in methods
    specimen = (report / "specimens" / "prism.html").read_text(encoding="utf-8")
    assert "critical damping fraction ξ at a node" in specimen
    assert "25, 0.408 to 1.63 kg and 4 to 16 N each" in specimen
    path.unlink()

    def stop_after(most):
        def tell(stage, done, total):
            if (stage.subject, stage.stage, stage.model, total) == ("pulse-01", "ensemble", None, 3):
                counted.append((done, total))
                if 0 < done == most:
                    raise KeyboardInterrupt

        return tell

    with pytest.raises(KeyboardInterrupt):
        in_space.run(workers=2, progress=stop_after(1))
    assert not path.exists()
    in_space.run(workers=2, progress=stop_after(4))
    assert counted == [(0, 3), (1, 3), (1, 3), (2, 3), (3, 3)]
    for name in bands:
        np.testing.assert_array_equal(files.read(path)[name].to_numpy(), bands[name].to_numpy())
    assert not in_space.layout.blocks(ResultId("pulse-01", "ensemble", "contact")).exists()


def test_a_map_needs_the_law_and_then_is_made(in_space):
    wanted = Wanted(models=("contact",), omega=(2.0, 3.0), amplitude=(0.8, 6.0), points=(2, 3), cycles=2.0)
    with pytest.raises(CampaignError, match="Run `colonnade calibrate` first"):
        make_maps(load(in_space.folder), in_space.layout, wanted)
    calibrate(load(in_space.folder), in_space.layout)
    (made,) = make_maps(load(in_space.folder), in_space.layout, wanted)
    stored = files.read(made.path)
    assert stored["outcome"].to_numpy()[:, [0, -1]].tolist() == [[0, 2], [0, 2]]
    options = json.loads(stored.attrs["settings"])
    assert (options["model"], options["damping_fraction"], options["contact_step"]) == ("contact", 0.3, 3e-5)
    assert not make_maps(load(in_space.folder), in_space.layout, wanted)[0].because


def test_a_map_of_several_bodies_is_made_by_the_contact_model_alone(in_space):
    channels = "\n[setups.frame.channels]"
    in_space.edit(channels, f'\n[assemblies.two]\nstack = ["prism", "prism"]\n{channels}')
    in_space.edit(
        'step = "30 us", penetration = 1e-6, damping_fraction = 0.3', "penetration = 1e-3, damping_fraction = 1"
    )
    wanted = Wanted(models=("contact",), omega=(2.0, 3.0), amplitude=(0.8, 8.0), points=(2, 2), cycles=1.0)
    (made,) = make_maps(load(in_space.folder), in_space.layout, wanted, ["two"])
    assert files.read(made.path)["outcome"].to_numpy()[:, 1].tolist() == [2, 2]
    nonlinear = Wanted(**(wanted.model_dump() | {"models": ("nonlinear",)}))
    with pytest.raises(CampaignError, match="do not rock as one block"):
        make_maps(load(in_space.folder), in_space.layout, nonlinear, ["two"])


def test_no_question_about_a_block_is_answered_of_bodies_that_do_not_rock_as_one(in_space):
    drum = '[specimens.drum]\nshape = "prism"\nwidth = "1 m"\ndepth = "1 m"\nheight = "1 m"\nmass = "900 kg"\n'
    channels = "\n[setups.frame.channels]"
    in_space.edit(channels, f'\n[assemblies.two]\nstack = ["drum", "drum"]\n\n{drum}{channels}')
    campaign = load(in_space.folder)
    with pytest.raises(CampaignError, match="two: its bodies do not rock as one block"):
        one_specimen(campaign, "two")
    assert one_specimen(campaign, "prism") == "prism"
    assert campaign.of_interest == ("prism", "two")
    assert campaign.but(tests={}).of_interest == campaign.of_interest
    assert advise_kind(campaign, in_space.layout, "two", "free-vibration", {}) == []
    taken = record_of_specimen(campaign, "two", restitution_taken(campaign, in_space.layout, "two")).restitution
    assert (taken.value, taken.method) == (None, None)
    assert taken.reason == "Its bodies do not rock as one block."
    with pytest.raises(CampaignError, match="two: the contact of several bodies is not calibrated"):
        calibrate(load(in_space.folder), in_space.layout, ["two"])
    few = Wanted(models=("linear",), omega=(2.0, 3.0), amplitude=(0.8, 2.0), points=(2, 2), cycles=1.0)
    assert [made.specimen for made in make_maps(load(in_space.folder), in_space.layout, few)] == ["prism"]


SITE = """
[assemblies.two]
stack = ["prism", "prism"]

[assessments.site]
specimen = "two"
scale = 2
records = "records"
levels = ["0.2 m/s", "3 m/s"]
displaced = "50 mm"
measures = ["pga"]
draws = 1
resamples = 100
"""


def test_a_real_column_of_several_bodies_is_assessed_by_the_contact_model(in_space):
    in_space.edit("\n[setups.frame.channels]", f"{SITE}\n[setups.frame.channels]")
    in_space.edit(
        'step = "30 us", penetration = 1e-6, damping_fraction = 0.3', "penetration = 1e-3, damping_fraction = 1"
    )
    (in_space.folder / "records").mkdir()
    time = np.arange(0.0, 1.0, 0.01)
    pulses = {each: np.where(time < 1 / each, np.sin(2 * np.pi * each * time), 0.0) for each in (2.0, 2.5)}
    for frequency, pulse in pulses.items():
        rows = np.column_stack((time, pulse))
        head = "time [s],acceleration [m/s^2]"
        np.savetxt(in_space.folder / "records" / f"{frequency}.csv", rows, delimiter=",", header=head, comments="")
    campaign = load(in_space.folder)
    assert not check(campaign).failed
    [found] = assess(campaign, in_space.layout, (), {}, Where(workers=1))
    record = found.record
    assert (record.displaced, record.restitution.value, record.friction) == (0.05, None, 0.6)
    assert record.friction_range == pytest.approx((0.48, 0.72))
    overturned = found.result["case_overturned"].to_numpy()[:, :, :, 0, 0]
    assert overturned[:, 1].all()
    plan = AssessmentInputs.of(campaign, campaign.assessments["site"]).on_contact()
    assert plan.assembly.height == pytest.approx(2 * campaign.specimens["two"].assembly(9.81).height)
    motion = Motion(found.result["case_factor"].to_numpy()[0, 0, 0] * pulses[2.0], 0.01)
    of_the_first = [found.result[f"case_{name}"].to_numpy()[0, 0, 0, 0, 0] for name in ("outcome", "peak_ratio")]
    assert plan.end(motion, 0.6)[:2] == tuple(of_the_first)
    first, *_, last = sentences(record)
    assert first.startswith("A body falls, or ends more than 50 mm from its place, with a probability of 5\xa0%")
    assert "drums" not in last


def test_what_an_assessment_of_several_bodies_needs_is_said(in_space):
    file, channels = in_space.folder / "campaign.toml", "\n[setups.frame.channels]"
    plain = file.read_text(encoding="utf-8")
    for old, new, words in (
        ('levels = ["0.2 m/s", "3 m/s"]\n', "", "assessments.site.levels: It is missing"),
        ('specimen = "two"\n', 'specimen = "prism"\n', "assessments.site.displaced: It is for several bodies"),
        ("[assessments.site]", "[prototype.two]\nrestitution = 0.9\n\n[assessments.site]", "Leave this table out"),
    ):
        file.write_text(plain.replace(channels, f"{SITE.replace(old, new)}{channels}", 1), encoding="utf-8")
        with pytest.raises(CampaignError) as refused:
            load(in_space.folder)
        assert words in str(refused.value)
