"""A plan of a virtual campaign and its file: loaded back as planned, whose specimen, and where its raw files are."""

import tomllib
from dataclasses import replace

import pytest

from colonnade.campaign import load
from colonnade.dynamics.block import Block
from colonnade.errors import CampaignError
from colonnade.laboratory.campaign_file import FILE_NAME, MARK, campaign_text, refuse_foreign
from colonnade.laboratory.experiment import MAIN, Plan, Recorder, Setup, Specimen, Trial, raw_path
from colonnade.laboratory.files import Flavour, Tdms
from colonnade.laboratory.table import Transducer
from prism import PRISM

SHAPE = {"shape": "prism", "width": "86 mm", "depth": "86 mm", "height": "456 mm", "mass": "26.10 kg"}
TOP = Transducer("top", "LVDT 1", "displacement", "specimen", 0.100, "mm", offset=0.004, at=(0.043, 0.0, 0.440))
DIRECT = Transducer("low", "LVDT 2", "displacement", "specimen", 0.050, "mm", "mm", at=(0.043, 0.0, 0.020))
ACCELERATION = Transducer("table", 'ACC "x"', "acceleration", "table", 19.6133, "m/s^2")
SECOND = Transducer("again", "ACC 2", "acceleration", "table", 19.6133, "m/s^2")


def plan(gravity=9.81, **recorders):
    block = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10, gravity=gravity)
    setup = Setup({MAIN: Recorder((TOP, DIRECT, ACCELERATION), 200.0)} | recorders, catch=0.28, comment="with a frame")
    shaken = Trial("span-2.0", "earthquake", "frame", 9.0, entry={"span": 2.0, "motion": 'the "big" one'})
    return Plan("virtual-1", 'A "title"', {"prism.a": Specimen(SHAPE, block, 0.93)}, {"frame": setup}, (shaken,))


def written_channels():
    return tomllib.loads(campaign_text(plan()))["setups"]["frame"]["channels"]


@pytest.fixture
def loaded(tmp_path):
    def write(planned):
        (tmp_path / FILE_NAME).write_text(campaign_text(planned), encoding="utf-8")
        return load(tmp_path)

    return write


def test_it_is_loaded_as_it_was_planned(loaded):
    campaign = loaded(plan())
    assert (campaign.campaign, campaign.title, campaign.gravity) == ("virtual-1", 'A "title"', 9.81)
    assert campaign.block("prism.a") == plan().specimens["prism.a"].block
    assert campaign.specimens["prism.a"].restitution is None
    test = campaign.tests["span-2.0"]
    assert (test.kind, test.span, test.motion, test.specimen) == ("earthquake", 2.0, 'the "big" one', "prism.a")
    assert campaign.setups["frame"].catch == pytest.approx(0.28)


def test_a_reading_in_volts_has_the_gain_of_its_full_scale_and_its_offset():
    top = written_channels()["top"]
    assert (top["unit"], top["gain"], top["offset"], top["range"]) == ("V", "10 mm/V", "4 mm", "10 V")
    assert top["at"] == ["43 mm", "0 mm", "440 mm"]


def test_a_direct_reading_has_no_gain():
    low = written_channels()["low"]
    assert (low["unit"], low["range"]) == ("mm", "50 mm")
    assert low.keys().isdisjoint({"gain", "offset"})


def test_gravity_is_written_where_it_is_not_the_usual_one(loaded):
    assert "gravity" not in tomllib.loads(campaign_text(plan()))
    assert loaded(plan(gravity=9.8)).gravity == 9.8


def test_a_second_recorder_has_its_format_its_files_and_the_channels_that_link_it(loaded):
    daq2 = Recorder((SECOND,), 400.0, Tdms(), late=0.3, align=("table", "again"))
    campaign = loaded(plan(daq2=daq2))
    recorder = campaign.setups["frame"].recorders["daq2"]
    assert recorder.file.format == "tdms"
    assert campaign.setups["frame"].channels["again"].recorder == "daq2"
    assert {path.name for path in campaign.tests["span-2.0"].files.values()} == {"span-2.0.csv", "span-2.0-daq2.tdms"}
    assert 'clock = {align = ["table", "again"]}' in campaign_text(plan(daq2=daq2))


def test_its_comments_explain_the_first_setup_once():
    text = campaign_text(plan())
    assert text.startswith(MARK)
    assert text.count("# What each column is.") == 1
    assert "# with a frame\n" in text


@pytest.mark.parametrize("content", ["schema = 1\n", ""], ids=["of a laboratory", "empty"])
def test_a_campaign_file_of_another_hand_is_not_replaced(tmp_path, content):
    refuse_foreign(tmp_path)
    path = tmp_path / FILE_NAME
    path.write_text(content, encoding="utf-8")
    with pytest.raises(CampaignError, match="was not written by the virtual laboratory and was not changed"):
        refuse_foreign(tmp_path)
    path.write_text(campaign_text(plan()), encoding="utf-8")
    refuse_foreign(tmp_path)


FREE = Trial("free-01", "free-vibration", "frame", 9.0)


def plan_with(*specimens):
    specimen = Specimen({"shape": "prism"}, PRISM, 0.93)
    return Plan("one", "One", dict.fromkeys(specimens, specimen), {"frame": Setup({})}, ())


def test_the_only_specimen_needs_no_name():
    assert plan_with("prism").specimen_of(FREE) == "prism"


def test_of_several_specimens_one_is_named():
    with pytest.raises(ValueError, match="free-01: one of prism, statue was expected"):
        plan_with("prism", "statue").specimen_of(FREE)
    assert plan_with("prism", "statue").specimen_of(replace(FREE, specimen="statue")) == "statue"


def test_each_recorder_writes_a_file_of_its_own():
    flavours = (MAIN, Flavour()), (MAIN, Tdms()), ("daq2", Tdms())
    paths = [raw_path(FREE, recorder, Recorder((), 200.0, flavour)) for recorder, flavour in flavours]
    assert paths == ["raw/free-01.csv", "raw/free-01.tdms", "raw/free-01-daq2.tdms"]
