"""Every setting is listed with value, default, unit and what it does."""

from colonnade.campaign import Processing
from colonnade.campaign.settings import NextSettings, settings


def test_every_setting_is_described_and_stands_at_its_default():
    listed = list(settings(Processing(), NextSettings()))
    assert all(setting.description for setting in listed)
    assert all(setting.value == setting.default for setting in listed)
    assert {"processing.lowpass", "processing.restitution.level", "processing.predict.models", "next.largest_risk"} <= {
        setting.key for setting in listed
    }


def test_a_changed_setting_shows_value_and_default(contract, load_text):
    found = {setting.key: setting for setting in settings(load_text(contract).processing, NextSettings())}
    assert (found["processing.lowpass"].value, found["processing.lowpass"].default) == (25.0, "auto")
    assert found["processing.lowpass"].unit == "Hz"
    assert found["processing.restitution.level"].value == 0.9


def test_defaults_hold_their_own_rules():
    defaults = {setting.key.removeprefix("processing."): setting for setting in settings(Processing(), NextSettings())}
    written = {key: setting.default for key, setting in defaults.items() if "." not in key and setting.unit != "s"}
    assert Processing.model_validate(written) == Processing()
