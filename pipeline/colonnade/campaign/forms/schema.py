"""JSON Schemas of the contract's files, made from the models that read and write them."""

from __future__ import annotations

from typing import Any

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.forms.forecast import ForecastFile
from colonnade.campaign.forms.summary import Summary
from colonnade.campaign.review import ReviewFile
from colonnade.errors import CampaignError, nearest

DIALECT = "https://json-schema.org/draft/2020-12/schema"
NAMES = ("campaign", "summary", "review", "forecast")


def json_schema(name: str) -> dict[str, Any]:
    """
    Return the JSON Schema of a contract.

    Parameters
    ----------
    name : {"campaign", "summary", "review", "forecast"}
        Of campaign.toml as written, where quantities are text with a unit; of processed/summary.json; of review.toml;
        of a file in forecasts/.

    Returns
    -------
    schema : dict
        Draft 2020-12.

    Raises
    ------
    CampaignError
        If the name is unknown.
    """
    if name == "campaign":
        schema = _campaign()
    elif name == "summary":
        schema = Summary.model_json_schema(mode="serialization")
    elif name == "forecast":
        schema = ForecastFile.model_json_schema(mode="serialization")
        schema["properties"]["sha256"] = {
            "type": "string",
            "pattern": "^[0-9a-f]{64}$",
            "description": "Of all the rest, written as JSON with sorted keys, without spaces, in UTF-8.",
        }
        schema["required"] = [*schema["required"], "sha256"]
    elif name == "review":
        schema = _tidied(ReviewFile.model_json_schema())
        for kind in ("exclude", "trim", "flag", "correct"):
            schema["properties"][kind].pop("default", None)
    else:
        raise CampaignError(f'Unknown schema "{name}".{nearest(name, NAMES)}')
    return {"$schema": DIALECT} | schema


def _campaign() -> dict[str, Any]:
    schema = CampaignFile.model_json_schema()
    tests = schema["properties"]["tests"]
    log = {"type": "string", "description": "path of the test log, CSV or Excel"}
    schema["properties"]["tests"] = {
        "description": tests["description"],
        "anyOf": [{"type": "array", "items": tests["items"]}, log],
    }
    for table in (schema, *schema["$defs"].values()):
        for key in table.get("properties", {}).values():
            _as_written(key)
    tidied: dict[str, Any] = _tidied(schema)
    return tidied


def _tidied(node: Any) -> Any:
    """Leave out null, titles and what is said once for each item of a list; close tables whose keys are ids."""
    if isinstance(node, list):
        return [_tidied(item) for item in node]
    if not isinstance(node, dict):
        return node
    tidied = {key: _tidied(value) for key, value in node.items() if not (key == "title" and isinstance(value, str))}
    kept = [choice for choice in tidied.get("anyOf", ()) if choice != {"type": "null"}]
    if len(kept) == 1:
        del tidied["anyOf"]
        tidied = kept[0] | tidied
    elif kept:
        tidied["anyOf"] = kept
    items = tidied.get("prefixItems", [])
    if items and all(item == items[0] for item in items):
        tidied["items"] = tidied.pop("prefixItems")[0]
    if "patternProperties" in tidied:
        tidied["additionalProperties"] = False
    return tidied


def _as_written(key: dict[str, Any]) -> None:
    """Turn the default of a parsed value into what would be written, or leave it out."""
    default = key.get("default")
    if isinstance(default, (dict, list)) or default is None:
        key.pop("default", None)
    elif key.get("type") == "string" and not isinstance(default, str):
        key["default"] = f"{default:g} {key.get('unit', '')}".rstrip()
