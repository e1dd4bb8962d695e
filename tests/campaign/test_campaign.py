"""What a campaign says of its tests and specimens, wherever its folder is."""

from dataclasses import replace

from colonnade.campaign import Processing
from colonnade.campaign.settings import NextSettings, settings
from colonnade.findings import note


def test_a_copy_elsewhere_is_told_in_the_same_words(contract, load_text, tmp_path):
    campaign = load_text(contract)
    assert tmp_path.as_posix() not in campaign.told(campaign)
    assert "Path('./raw/span20.csv')" in campaign.told(campaign.tests["span-2.0"])
    assert campaign.tests["span-2.0"].files["main"].is_absolute()


def test_a_channel_on_one_specimen_by_its_id_is_only_in_the_tests_of_that_one(contract, load_text):
    text = contract.replace('on = "specimen"', 'on = "prism"', 1)
    rest = '\nsetup = "frame"\nfile = "raw'
    campaign = load_text(text.replace(f'specimen = "prism"{rest}', f'specimen = "cone"{rest}'))
    own, others = (campaign.channels(campaign.tests[name]) for name in ("free-01", "span-2.0"))
    assert own["top"].on == "specimen"
    assert "top" not in others
    assert "bottom" in others


def test_findings_about_its_specimen_and_set_up_concern_a_test(contract, load_text):
    tables = ("specimens.prism", "setups.frame", "specimens.cone", "")
    findings = tuple(replace(note("x", f"{table}."), about=table) for table in tables)
    campaign = load_text(contract).but(warnings=findings)
    assert campaign.tests["span-2.0"].specimen == "prism"
    assert [found.about for found in campaign.concerning("span-2.0")] == ["specimens.prism", "setups.frame"]


def test_every_setting_is_described_and_stands_at_its_default():
    listed = settings(Processing(), "processing") | settings(NextSettings(), "next")
    assert all(setting["description"] for setting in listed.values())
    assert all(setting["value"] == setting["default"] for setting in listed.values())
    assert {"processing.lowpass", "processing.restitution.level", "next.largest_risk"} <= listed.keys()


def test_a_changed_setting_shows_value_and_default(contract, load_text):
    found = settings(load_text(contract).processing, "processing")
    lowpass = found["processing.lowpass"]
    assert (lowpass["value"], lowpass["default"], lowpass["unit"]) == (25.0, "auto", "Hz")
    assert found["processing.restitution.level"]["value"] == 0.9


def test_defaults_hold_their_own_rules():
    defaults = {key.removeprefix("all."): each for key, each in settings(Processing(), "all").items()}
    written = {key: each["default"] for key, each in defaults.items() if "." not in key and each["unit"] != "s"}
    assert Processing.model_validate(written) == Processing()
