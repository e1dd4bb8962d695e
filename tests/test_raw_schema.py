"""The contract of raw data: the schemas are the models', and the worked examples are ingested."""

import json
import re
from pathlib import Path

import jsonschema
import numpy as np
import pytest

import chain
from colonnade.campaign import load
from colonnade.campaign import test as one_test
from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.channel import Channel
from colonnade.campaign.forms.schema import json_schema
from colonnade.campaign.setup import Setup
from colonnade.cli import invoke
from colonnade.cli.app import app
from colonnade.errors import ReadError
from colonnade.readers.registry import formats, read
from colonnade.store.layout import Layout
from colonnade.store.results import STAGES
from every import every

ROOT = Path(__file__).resolve().parents[1]
RAW_SCHEMA = ROOT / "raw_schema"
README = (RAW_SCHEMA / "README.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["campaign", "summary", "review", "forecast"])
def test_schema_file_is_what_the_command_writes(name, capsys):
    assert invoke(["schema", name]) == 0
    written = (RAW_SCHEMA / f"{name}.schema.json").read_text(encoding="utf-8")
    assert capsys.readouterr().out == written, f"colonnade schema {name} > raw_schema/{name}.schema.json"
    jsonschema.Draft202012Validator.check_schema(json.loads(written))


@pytest.mark.parametrize("table", [CampaignFile, Setup, Channel, one_test.Test], ids=lambda table: table.__name__)
def test_the_data_dictionary_names_every_key(table):
    assert [key for key in table.purposes() if f"`{key}" not in README] == []


def test_every_format_has_a_worked_example():
    assert {path.parent.name for path in (RAW_SCHEMA / "examples").glob("*/campaign.toml")} == set(formats())


def example(name):
    """Ingest the one test of a worked example."""
    campaign = load(RAW_SCHEMA / "examples" / name)
    (test,) = campaign.tests.values()
    file = campaign.setups[test.setup].file
    recording = read(test.files["main"], file.format, file.options)
    assert read(test.files["main"]).format == name, "it is recognised without being told"
    return chain.ingested(campaign, test, {"main": recording})


def examples_of(record):
    """Formats whose worked example is a record."""
    return sorted({path.parents[1].name for path in (RAW_SCHEMA / "examples").glob(f"*/raw/{record}.*")})


@every("name", examples_of("free-01"))
def test_the_free_vibration_is_the_same_in_every_format(name):
    recorded, reference = example(name), example("delimited")
    assert recorded.sizes["elapsed"] == 801
    np.testing.assert_allclose(recorded["elapsed"], reference["elapsed"], atol=1e-6)
    for channel, rounding in (("top", 1e-8), ("bottom", 1e-8), ("table_acceleration", 1e-5)):
        np.testing.assert_allclose(recorded[channel], reference[channel], rtol=2e-7, atol=rounding)


@pytest.mark.parametrize("name", examples_of("pulse-01"))
def test_the_pulse_is_the_same_in_every_format(name):
    recorded = example(name)
    time = np.arange(601) / 200
    np.testing.assert_allclose(recorded["elapsed"], time, atol=1e-6)
    moving = (time >= 0.5) & (time <= 2.5)
    pulse = 0.05 * np.sin(4 * np.pi * (time - 0.5)) * np.sin(np.pi * (time - 0.5) / 2)
    np.testing.assert_allclose(recorded["table_acceleration"], 9.80665 * np.where(moving, pulse, 0), atol=1e-7)


def test_the_format_of_the_readme_works_as_it_stands(tmp_path):
    module = {}
    exec(README.split("```python\n")[1].split("```")[0], module)
    path = tmp_path / "record.bbx"
    path.write_bytes(b"BBX1" + np.array([200, 0.5, -0.25, 1], dtype="<f4").tobytes())
    blackbox = module["FORMAT"]
    assert blackbox.recognise(path).yes
    channel = blackbox.read(path, blackbox.options()).channel("signal")
    assert (channel.values.tolist(), channel.unit) == ([0.5, -0.25, 1.0], "V")
    assert channel.time.tolist() == [0.0, 0.005, 0.01]
    path.write_bytes(b"BBX1")
    with pytest.raises(ReadError, match="cut off"):
        blackbox.read(path, blackbox.options())


def test_the_delimited_example_gives_the_restitution_it_was_made_with():
    campaign = load(RAW_SCHEMA / "examples" / "delimited")
    test = campaign.tests["free-01"]
    file = campaign.setups["frame"].file
    recording = read(test.files["main"], file.format, file.options)
    recorded = chain.ingested(campaign, test, {"main": recording})
    assert recorded.sizes["elapsed"] == 801
    assert float(recorded["top"][0]) == pytest.approx(10.02e-3 * 4.1005 - 0.13e-3, rel=1e-12)
    assert float(recorded["table_acceleration"][0]) == pytest.approx(0.5 * 9.80665 * -0.0006, rel=1e-12)
    identified = chain.identified(campaign, chain.measured(campaign, test, {"main": recording})[1])
    assert float(identified["restitution"]) == pytest.approx(0.9, abs=5e-4)


def section(name):
    return re.search(rf"^## {name}\n(.*?)(?=^## |\Z)", README, re.MULTILINE | re.DOTALL)[1]


def test_the_contract_has_every_command():
    named = re.findall(r"`([a-z]+)[^`]*`", "".join(re.findall(r"^\| (`.*?) \|", section("Commands"), re.MULTILINE)))
    assert set(named) == set(app.commands)


def test_the_contract_has_every_field_of_the_summary():
    named = set(re.findall(r"`([a-z_]+)`", section("The summary")))
    schema = json_schema("summary")
    of_records = [schema["$defs"][name]["properties"] for name in ("SpecimenSummary", "TestSummary", "Warned")]
    of_records += [schema["$defs"][name]["properties"] for name in ("PredictionSummary", "RestitutionSummary")]
    fields = {field for properties in of_records for field in properties}
    assert fields - named == set()


@every("stage", STAGES)
def test_the_contract_has_the_file_of_every_stage(stage):
    path = Layout(Path()).stage("SUBJECT", stage, "MODEL").as_posix()
    pattern = re.escape(path).replace("SUBJECT", r"<\w+>").replace("MODEL", "<model>")
    assert re.search(f"`{pattern}`", section("What colonnade writes"))
