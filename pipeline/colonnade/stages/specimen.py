"""Specimen: the e of all its free vibrations together, and the one rule for the e that predictions use."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Campaign
from colonnade.dynamics.block import Block, Sided, pair
from colonnade.findings import Finding, note, warning
from colonnade.identification.restitution.pooling import pool
from colonnade.stages.parts.inputs import Inputs

if TYPE_CHECKING:
    import xarray as xr


class SpecimenInputs(Inputs):
    """What `specimen` reads of the campaign: the block, the restitution given in the file, the interval's level."""

    block: Block
    given: Sided | None
    level: float

    @classmethod
    def of(cls, campaign: Campaign, specimen: str) -> SpecimenInputs:
        """Gather what `specimen` reads for one specimen."""
        entry = campaign.specimens[specimen]
        return cls(
            block=entry.block(campaign.gravity), given=entry.restitution, level=campaign.processing.restitution.level
        )


@dataclass(frozen=True)
class _Identified:
    """Ids of the free vibrations with an e, their e and standard errors, the method, and why others have none."""

    tests: tuple[str, ...] = ()
    values: Array = field(default_factory=lambda: np.empty(0))
    errors: Array = field(default_factory=lambda: np.empty(0))
    method: str = ""
    refused: tuple[str, ...] = ()


def specimen(identified: Mapping[str, xr.Dataset], inputs: SpecimenInputs) -> xr.Dataset:
    """
    Pool the restitution of a specimen's free vibrations.

    Parameters
    ----------
    identified : mapping of str to xr.Dataset
        Results of `restitution` by test id; those that were refused carry NaN.
    inputs : SpecimenInputs

    Returns
    -------
    pooled : xr.Dataset
        `side_restitution` (θ < 0, θ > 0) that predictions take and `restitution`, their mean: the one given in the
        campaign file, else the identified one, else the rigid-body value; `restitution_source` says which.
    """
    tests = tuple(sorted(name for name, result in identified.items() if np.isfinite(float(result["restitution"]))))
    refused = [f"{name}: {result.attrs['reason']}" for name, result in sorted(identified.items()) if name not in tests]
    return _taken(
        _Identified(
            tests,
            np.array([float(identified[name]["restitution"]) for name in tests]),
            np.array([float(identified[name]["restitution_standard_error"]) for name in tests]),
            identified[tests[0]].attrs["method"] if tests else "",
            tuple(refused),
        ),
        inputs,
    )


def taken(stored: xr.Dataset | None, inputs: SpecimenInputs) -> xr.Dataset:
    """
    Give e by the same rule for the current campaign, even if a stored result was made from an earlier one.

    Parameters
    ----------
    stored : xr.Dataset or None
        An earlier result of `specimen`; what it holds of the free vibrations counts if it is of the same block.
    inputs : SpecimenInputs

    Returns
    -------
    pooled : xr.Dataset
        As of `specimen`.
    """
    found = _Identified(refused=("the free vibrations have not been identified",))
    if stored is not None and "test_method" in stored.attrs and _is_of(stored, inputs.block):
        found = _Identified(
            tuple(str(name) for name in stored["test_id"].to_numpy()),
            stored["test_restitution"].to_numpy(),
            stored["test_restitution_standard_error"].to_numpy(),
            str(stored.attrs["test_method"]),
            tuple(stored.attrs["refused"]),
        )
    return _taken(found, inputs)


def restitution_spread(pooled: xr.Dataset, usual: float) -> tuple[float, int | None]:
    """Give the standard deviation of e in a new test and its degrees of freedom, as of `Pooled.of_new_test`."""
    if pooled.attrs["restitution_source"] != "identified":
        return usual, None
    tests = pool(pooled["test_restitution"].to_numpy(), pooled["test_restitution_standard_error"].to_numpy())
    return tests.of_new_test(usual)


def _is_of(stored: xr.Dataset, block: Block) -> bool:
    return all(float(stored[name]) == value for name, value in _properties(block).items())


def _properties(block: Block) -> dict[str, float]:
    names = ("critical_angle", "pole_distance", "inertia", "p")
    return {name: getattr(block, name) for name in names} | {"rigid_restitution": block.restitution}


def _taken(found: _Identified, inputs: SpecimenInputs) -> xr.Dataset:
    """The rule: e as given, else as identified, else of the rigid body."""
    import xarray as xr

    block = inputs.block
    low = high = between = np.nan
    method = reason = ""
    if inputs.given is not None:
        value, source, method = pair(inputs.given), "given", "given in the campaign file"
    elif found.tests:
        pooled = pool(found.values, found.errors, level=inputs.level)
        value, source = pair(pooled.value), "identified"
        low, high, between = pooled.low, pooled.high, pooled.between
        count = f"{len(found.tests)} free vibration{'s' if len(found.tests) > 1 else ''}"
        method = f"{found.method}; random effects over {count}"
    else:
        value, source = pair(block.restitution), "rigid-body"
        reason = "; ".join(found.refused) or "no free vibration of this specimen was identified"
        method = "rigid body without bounce, 1 − (2 m R b/I₀) sin α (Housner 1963)"
    return xr.Dataset(
        {
            "side_restitution": ("side", np.array(value)),
            "restitution": ((), float(np.mean(value))),
            "restitution_low": ((), low),
            "restitution_high": ((), high),
            "between_test_scatter": ((), between),
            "level": ((), inputs.level),
            **{name: ((), each) for name, each in _properties(block).items()},
            "test_restitution": ("test", found.values),
            "test_restitution_standard_error": ("test", found.errors),
        },
        coords={"test_id": ("test", np.array(found.tests, dtype=object))},
        attrs={
            "restitution_source": source,
            "method": method,
            "reason": reason,
            "test_method": found.method,
            "refused": list(found.refused),
            "warnings": _warnings(source, value, found),
        },
    )


def _warnings(source: str, value: tuple[float, float], found: _Identified) -> list[Finding]:
    """Note that predictions use the e of a rigid body; a warning if free vibrations should have given it."""
    if source != "rigid-body":
        return []
    weight = warning if found.refused else note
    why = "none of its free vibrations gives one" if found.refused else "it has no free vibration"
    return [
        weight(
            "rigid-body e",
            f"Predictions use the rigid body's e, {value[0]:.4g}, because {why}. Give `restitution` in the campaign "
            "file if it is known.",
        )
    ]
