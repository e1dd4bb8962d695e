"""JSON Schemas of the contract's files, made from the models that read and write them."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel

from colonnade.campaign.campaign import CampaignFile
from colonnade.campaign.forms.forecast import ForecastFile
from colonnade.campaign.forms.summary import Summary
from colonnade.campaign.review import ReviewFile

DIALECT = "https://json-schema.org/draft/2020-12/schema"
MODELS: dict[str, type[BaseModel]] = {
    "campaign": CampaignFile,
    "summary": Summary,
    "review": ReviewFile,
    "forecast": ForecastFile,
}


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
    """
    schema: dict[str, Any]
    if name in ("campaign", "review"):
        schema = _tidied(MODELS[name].model_json_schema())
    else:
        schema = MODELS[name].model_json_schema(mode="serialization")
    if name == "campaign":
        tests = schema["properties"]["tests"]
        log = {"type": "string", "description": "path of the test log, CSV or Excel"}
        tests["anyOf"] = [{"type": tests.pop("type"), "items": tests.pop("items")}, log]
    elif name == "forecast":
        schema["properties"]["sha256"] = {
            "type": "string",
            "pattern": "^[0-9a-f]{64}$",
            "description": "Of all the rest, written as JSON with sorted keys, without spaces, in UTF-8.",
        }
        schema["required"].append("sha256")
    return {"$schema": DIALECT} | schema


def _tidied(node: Any) -> Any:
    """
    Leave out null, titles and what is said once for each item of a list; close tables whose keys are ids.

    The default of a parsed value becomes what would be written, or is left out.
    """
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
    default = tidied.get("default")
    if default is None or isinstance(default, (dict, list)):
        tidied.pop("default", None)
    elif tidied.get("type") == "string" and not isinstance(default, str):
        tidied["default"] = f"{default:g} {tidied.get('unit', '')}".rstrip()
    return tidied
