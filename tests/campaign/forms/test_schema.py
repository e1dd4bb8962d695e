"""JSON Schemas of the contract: what the models accept and refuse, as TOML has it; the files are in raw_schema."""

import json
import tomllib
from pathlib import Path

import jsonschema
import pytest

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.forms.schema import json_schema
from colonnade.readers.registry import formats

# JSON has no dates: a validator is given them as text.
WRITTEN = tomllib.loads((Path(__file__).parents[1] / "contract.toml").read_text(encoding="utf-8"))
CONTRACT = json.loads(json.dumps(WRITTEN, default=str))


def test_a_campaign_file_of_the_contract_passes_the_schema():
    jsonschema.validate(CONTRACT, json_schema("campaign"))


@pytest.mark.parametrize(
    ("place", "value"),
    [
        (("schema",), 2),
        (("gravity",), 9.81),
        (("specimens", "prism", "width"), "86"),
        (("specimens", "prism", "shape"), "prsm"),
        (("specimens", "prism", "diameter"), "86 mm"),
        (("specimens", "a b"), {}),
        (("setups", "frame", "file", "delimter"), ";"),
        (("setups", "frame", "file", "format"), "csv"),
        (("setups", "frame", "channels", "top", "quantity"), "way"),
        (("setups", "frame", "channels", "top", "direction"), [1, 0]),
        (("setups", "frame", "recorders", "daq2", "clock"), "start"),
        (("processing", "lowpass"), 25),
        (("tests", 0, "kind"), "shaken"),
        (("tests", 0, "zero"), "begin"),
        (("tests", 0, "file"), {"daq2": "raw/a.csv"}),
        (("tests",), 3),
    ],
    ids=str,
)
def test_what_the_models_refuse_fails_the_schema_too(place, value, tmp_path):
    changed = json.loads(json.dumps(CONTRACT))
    table = changed
    for part in place[:-1]:
        table = table[part]
    table[place[-1]] = value
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(changed, json_schema("campaign"))
    with pytest.raises(ValueError, match="validation error"):
        CampaignFile.model_validate(changed, context={"folder": tmp_path})


def inside(node):
    """All tables of a schema."""
    if isinstance(node, list):
        for item in node:
            yield from inside(item)
    elif isinstance(node, dict):
        yield node
        for value in node.values():
            yield from inside(value)


@pytest.mark.parametrize("name", ["campaign", "review"])
def test_what_toml_does_not_have_is_not_in_a_schema_of_a_file_that_people_write(name):
    assert [table for table in inside(json_schema(name)) if table.get("type") == "null"] == []


def test_tables_whose_keys_are_ids_are_closed():
    with_patterns = [table for table in inside(json_schema("campaign")) if "patternProperties" in table]
    assert with_patterns
    assert all(table["additionalProperties"] is False for table in with_patterns)


def test_defaults_are_written_as_people_write_them():
    assert json_schema("campaign")["properties"]["gravity"]["default"] == "9.81 m/s^2"


def test_every_format_has_its_options():
    options = json_schema("campaign")["$defs"]["FileOptions"]["anyOf"]
    assert [each["properties"]["format"]["const"] for each in options] == list(formats())
