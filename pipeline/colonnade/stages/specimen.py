"""Specimen: the e of all its free vibrations together, and the one rule for the e that predictions use."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from colonnade.arrays import Dataset, dataset
from colonnade.campaign import Campaign
from colonnade.campaign.settings import PlaneEnsembleSettings
from colonnade.dynamics.block import Block, Sided, pair
from colonnade.dynamics.uncertainty import Uncertainty, member_block
from colonnade.errors import count
from colonnade.findings import Finding, warning
from colonnade.identification.restitution.pooling import Pooled, pool
from colonnade.identification.restitution.result import Joint
from colonnade.store.provenance import Inputs


class SpecimenInputs(Inputs):
    """
    What `specimen` reads of the campaign.

    Attributes
    ----------
    block : Block
    given : Sided or None
        e given in the file.
    level : float
        Of the interval.
    known : (float, float)
        Relative standard deviations of α and p.
    """

    block: Block
    given: Sided | None
    level: float
    known: tuple[float, float] = (0.0, 0.0)

    @classmethod
    def of(cls, campaign: Campaign, specimen: str) -> SpecimenInputs:
        """Gather what `specimen` reads for one specimen."""
        settings = campaign.ensemble_settings(specimen)
        return cls(
            block=campaign.block(specimen),
            given=campaign.specimens[specimen].restitution,
            level=campaign.processing.restitution.level,
            known=(settings.critical_angle, settings.p),
        )


OF_TESTS: dict[str, tuple[int, ...]] = {
    "restitution": (),
    "restitution_standard_error": (),
    "joint_mean": (3,),
    "joint_covariance": (3, 3),
}
"""Variables of a free vibration that the pool keeps, as `test_…`, and their shapes."""

JOINT = ("joint", "joint_column")
"""Their dimensions."""


def specimen(identified: Mapping[str, Dataset], inputs: SpecimenInputs) -> Dataset:
    """
    Pool the restitution of a specimen's free vibrations.

    Parameters
    ----------
    identified : mapping of str to Dataset
        Results of `restitution` by test id; those that were refused carry NaN.
    inputs : SpecimenInputs

    Returns
    -------
    pooled : Dataset
        `side_restitution` (θ < 0, θ > 0) that predictions take and `restitution`, their mean: the one given in the
        campaign file, else the identified one, else the rigid-body value; `restitution_source` says which.
    """
    return _taken(_gathered(identified), inputs)


def taken(stored: Dataset | None, inputs: SpecimenInputs) -> Dataset:
    """
    Give e by the same rule for the current campaign, even if a stored result was made from an earlier one.

    Parameters
    ----------
    stored : Dataset or None
        An earlier result of `specimen`; what it holds of the free vibrations counts if it is of the same block.
    inputs : SpecimenInputs

    Returns
    -------
    pooled : Dataset
        As of `specimen`.
    """
    properties = _properties(inputs.block)
    is_complete = stored is not None and "known" in stored
    if stored is not None and is_complete and all(float(stored[name]) == properties[name] for name in properties):
        return _taken(stored[[f"test_{name}" for name in OF_TESTS]], inputs)
    return _taken(_gathered({}).assign_attrs(refused=["the free vibrations have not been identified"]), inputs)


def _gathered(identified: Mapping[str, Dataset]) -> Dataset:
    """What the free vibrations that have an e say of e, α and p, and why others have none."""
    tests, refused = {}, []
    for name, result in sorted(identified.items()):
        if np.isfinite(result["restitution"]):
            tests[name] = result
        else:
            refused.append(f"{name}: {result.attrs['reason']}")
    values = {
        name: np.array([result[name].to_numpy() for result in tests.values()]).reshape(len(tests), *shape)
        for name, shape in OF_TESTS.items()
    }
    return dataset(
        {f"test_{name}": (("test", *JOINT)[: each.ndim], each) for name, each in values.items()},
        coords={"test_id": ("test", np.array(list(tests), dtype=object))},
        attrs={"test_method": next((each.attrs["method"] for each in tests.values()), ""), "refused": refused},
    )


def restitution_spread(pooled: Dataset, usual: float) -> tuple[float, int | None]:
    """Give the standard deviation of e in a new test and its degrees of freedom, as of `Pooled.of_new_test`."""
    if pooled.attrs["restitution_source"] != "identified":
        return usual, None
    return pooled_of(pooled).of_new_test(usual)


def centre(pooled: Dataset, block: Block) -> Block:
    """Return the block with the α and p that the free vibrations show; as it is where e is not identified from them."""
    if pooled.attrs["restitution_source"] != "identified":
        return block
    _, critical_angle, p = np.exp(pooled_of(pooled).mean)
    return member_block(block, float(critical_angle), float(p))


def spread_of(pooled: Dataset, usual: PlaneEnsembleSettings) -> Uncertainty:
    """
    Say how well e of a new test, α and p are known together.

    Parameters
    ----------
    pooled : Dataset
        Result of `specimen`.
    usual : PlaneEnsembleSettings
        What counts where e is not identified; then the three vary by themselves.
    """
    e, freedom = restitution_spread(pooled, usual.restitution)
    if pooled.attrs["restitution_source"] != "identified":
        return Uncertainty(restitution=e, critical_angle=usual.critical_angle, p=usual.p)
    found = pooled_of(pooled)
    # e of a new test scatters besides; α and p are those of the specimen.
    covariance = found.covariance.copy()
    covariance[0, 0] = max(covariance[0, 0], (e / found.value) ** 2)
    deviations = np.sqrt(np.diag(covariance))
    known = np.where(deviations > 0.0, deviations, 1.0)
    e_angle, e_p, angle_p = (covariance / np.outer(known, known))[np.triu_indices(3, 1)].tolist()
    return Uncertainty(
        restitution=e,
        restitution_freedom=freedom,
        critical_angle=float(deviations[1]),
        p=float(deviations[2]),
        correlations=(e_angle, e_p, angle_p),
    )


def pooled_of(pooled: Dataset) -> Pooled:
    """Give what the free vibrations in a result of `specimen` say of e, α and p together."""
    values, errors, means, covariances = (pooled[f"test_{name}"].to_numpy() for name in OF_TESTS)
    joints = [Joint(mean, covariance) for mean, covariance in zip(means, covariances, strict=True)]
    critical_angle, p = pooled["known"].to_numpy().tolist()
    return pool(values, errors, level=float(pooled["level"]), joints=joints, known=(critical_angle, p))


def _properties(block: Block) -> dict[str, float]:
    names = ("critical_angle", "pole_distance", "inertia", "p")
    return {name: getattr(block, name) for name in names} | {"rigid_restitution": block.restitution}


def _taken(found: Dataset, inputs: SpecimenInputs) -> Dataset:
    """The rule: e as given, else as identified, else of the rigid body."""
    block, refused = inputs.block, list(found.attrs["refused"])
    found = found.assign(level=inputs.level, known=("property", np.array(inputs.known)))
    low = high = between = np.nan
    reason, warnings = "", list[Finding]()
    if inputs.given is not None:
        value, source, method = pair(inputs.given), "given", "given in the campaign file"
    elif tests := found.sizes["test"]:
        pooled = pooled_of(found)
        value, source = pair(pooled.value), "identified"
        low, high, between = pooled.low, pooled.high, pooled.between
        method = f"{found.attrs['test_method']}; random effects over {count(tests, 'free vibration')}"
    else:
        value, source = pair(block.restitution), "rigid-body"
        reason = "; ".join(refused) or "no free vibration of this specimen was identified"
        beam = ", the beam counts four times in m" if block.beam_ratio else ""
        method = f"rigid body without bounce, 1 − (2 m R b/I₀) sin α (Housner 1963){beam}"
        if refused:
            text = (
                f"Predictions use the rigid body's e, {value[0]:.4g}, because none of its free vibrations gives one. "
                "Give `restitution` in the campaign file if it is known."
            )
            warnings.append(warning("rigid-body e", text))
    variables = {
        "side_restitution": ("side", np.array(value)),
        "restitution": float(np.mean(value)),
        "restitution_low": low,
        "restitution_high": high,
        "between_test_scatter": between,
        **_properties(block),
    }
    told = {"restitution_source": source, "method": method, "reason": reason, "warnings": warnings}
    return found.assign(variables).assign_attrs(told)
