"""Attributes that NetCDF can hold: no None, no truth values, no lists of text."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from colonnade.findings import Finding, from_text, to_text


def storable(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """
    Turn attributes into what NetCDF can hold.

    Returns
    -------
    stored : dict
        None left out, truth values as int8, mappings, lists of text and findings as JSON text.

    Examples
    --------
    >>> storable({"a": None, "notes": ["x"], "b": {"c": 1}, "d": 2.5})
    {'notes': '["x"]', 'b': '{"c": 1}', 'd': 2.5}
    """
    return {name: _storable(value) for name, value in attributes.items() if value is not None}


def listed(value: Any) -> Any:
    """
    Turn JSON text of a list back into the list; all else passes.

    Examples
    --------
    >>> listed('["x"]'), listed("[1] is no list of text"), listed(2.5)
    (['x'], '[1] is no list of text', 2.5)
    """
    if not (isinstance(value, str) and value.startswith("[")):
        return value
    try:
        found = json.loads(value)
    except json.JSONDecodeError:
        return value
    return found if isinstance(found, list) and all(isinstance(item, str) for item in found) else value


def restored(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Turn what NetCDF held back into lists: of text, and the `warnings` into findings."""
    return {name: from_text(str(value)) if name == "warnings" else listed(value) for name, value in attributes.items()}


def _storable(value: Any) -> Any:
    if isinstance(value, (bool, np.bool_)):
        return np.int8(value)
    if isinstance(value, Mapping):
        return json.dumps(value, ensure_ascii=False, sort_keys=True)
    if isinstance(value, (list, tuple)) and any(isinstance(item, Finding) for item in value):
        return to_text(value)
    if isinstance(value, (list, tuple)) and all(isinstance(item, str) for item in value):
        return json.dumps(list(value), ensure_ascii=False)
    return value
