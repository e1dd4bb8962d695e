"""The results of a virtual campaign, compared with the truth."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any


def with_truth(truth: Mapping[str, Any], summary: Path) -> dict[str, Any]:
    """
    Put what a run found next to what is true.

    Parameters
    ----------
    truth : mapping
        Of a campaign of `write_campaign`: `specimens` and `tests` by id.
    summary : Path
        summary.json of its run.

    Returns
    -------
    comparison : dict
        `restitution` by specimen: the true one as `true`, and the fields of the summary; `tests` by id: outcome, peak
        and release, each found and true, and what was predicted.
    """
    read = json.loads(summary.read_text(encoding="utf-8"))
    return {
        "restitution": {
            name: {"true": true["restitution"]} | read["specimens"][name]["restitution"]
            for name, true in truth["specimens"].items()
        },
        "tests": {name: _test(true, read["tests"][name]) for name, true in truth["tests"].items()},
    }


def _test(true: Mapping[str, Any], found: Mapping[str, Any]) -> dict[str, Any]:
    pairs: dict[str, Any] = {}
    for name in ("outcome", "peak_ratio", "release_ratio"):
        pairs |= {f"true_{name}": true[name], name: found[name]}
    return pairs | {"predicted": found["predicted"]}
