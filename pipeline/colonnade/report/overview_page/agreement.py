"""How well a model agrees with a campaign: right outcomes, always with the misfits and the model's spread."""

from __future__ import annotations

from collections.abc import Mapping
from math import nan
from statistics import median
from typing import Any

from colonnade.errors import count
from colonnade.identification.response.rank import is_within
from colonnade.store.records.wording import agree
from colonnade.units.text import ratio


def agreement(tests: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """
    Say how far each model agrees with tests.

    Parameters
    ----------
    tests : mapping of str to mapping
        Records as summary.json has them, by test; of each `outcome`, `observed_outcome` and `predicted` are read.

    Returns
    -------
    said : list of str
        A sentence or more for each model that predicts the outcome of a test whose outcome is known.

    Examples
    --------
    >>> predicted = {"linear": {"outcome": "rocking", "nrmse": 0.02, "within_spread": 0.9}}
    >>> agreement({"a": {"outcome": "rocking", "predicted": predicted}})
    ['The linear model predicts the outcome of 1 of 1 test. Its misfit (nrmse) is 0.02 at the median and 0.02 at most, \
in a. 1 of 1 misfit is within its own spread.']
    """
    models = dict.fromkeys(model for test in tests.values() for model in test["predicted"])
    said = (
        _said(model, {name: test for name, test in tests.items() if model in test["predicted"]}) for model in models
    )
    return [text for text in said if text]


def _said(model: str, tests: Mapping[str, Mapping[str, Any]]) -> str:
    """Say how far a model agrees with the tests that it predicts, empty if no outcome can be compared."""
    predicted = {name: test["predicted"][model] for name, test in tests.items()}
    agrees = [
        agree(test["outcome"] or test.get("observed_outcome") or "", predicted[name]["outcome"] or "")
        for name, test in tests.items()
    ]
    known = [each for each in agrees if each is not None]
    if not known:
        return ""
    parts = [f"The {model} model predicts the outcome of {known.count(True)} of {count(len(known), 'test')}."]
    misfits = sorted((each["nrmse"], name) for name, each in predicted.items() if each["nrmse"] is not None)
    if misfits:
        middle, (largest, test) = median(misfit for misfit, _ in misfits), misfits[-1]
        parts.append(
            f"Its misfit (nrmse) is {ratio(middle, 2)} at the median and {ratio(largest, 2)} at most, in {test}."
        )
    ranks = (each["within_spread"] for each in predicted.values())
    judged = [within for rank in ranks if (within := is_within(nan if rank is None else rank)) is not None]
    if judged:
        verb = "is" if judged.count(True) == 1 else "are"
        parts.append(f"{judged.count(True)} of {count(len(judged), 'misfit')} {verb} within its own spread.")
    else:
        parts.append("Its own spread was not computed.")
    return " ".join(parts)
