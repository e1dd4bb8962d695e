"""Predict: recorded base motion, specimen and restitution -> the rocking angle of a model."""

from __future__ import annotations

from typing import Any

import numpy as np

from colonnade.arrays import Dataset, dataset
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.contact.body import InSpace
from colonnade.dynamics.contact.ensemble import ContactPlan
from colonnade.dynamics.contact.history import AssemblyHistory, ContactHistory
from colonnade.dynamics.contact.simulate import plane_block
from colonnade.dynamics.ensemble import PlanePlan
from colonnade.dynamics.history import amplitude
from colonnade.dynamics.models import model_of
from colonnade.dynamics.uncertainty import Uncertainty
from colonnade.findings import serious
from colonnade.stages.contact import ContactInputs, assembly_law, body_of, law_of, refusals
from colonnade.stages.parts.beginning import Beginning, BeginningInputs, begin
from colonnade.stages.parts.bodies import AssemblyInputs, predicted_variables
from colonnade.stages.specimen import centre


class PredictInputs(BeginningInputs):
    """
    What `predict` reads of the campaign for one test and model.

    Attributes
    ----------
    model : str
    rest_angle : float
        Largest arc after an impact that counts as rest, of α.
    space : ContactInputs or None
        What the contact model also needs; None for the others.
    assembly : AssemblyInputs or None
        Bodies of an assembly, which the contact model moves.
    """

    model: str
    rest_angle: float
    space: ContactInputs | None = None
    assembly: AssemblyInputs | None = None

    @classmethod
    def of(cls, campaign: Campaign, test: Test, model: str) -> PredictInputs:
        """Gather what `predict` reads for one test and model."""
        in_space = model_of(model).in_space
        return cls(
            block=campaign.block(test.specimen),
            model=model,
            rest_angle=campaign.processing.predict.rest_angle,
            free_vibration=test.kind == "free-vibration",
            tilt=campaign.setups[test.setup].table_tilt or 0.0,
            is_in_space=in_space,
            space=ContactInputs.of(campaign, test.specimen) if in_space else None,
            assembly=AssemblyInputs.of(campaign, test) if in_space else None,
        )


def predict(
    rocking: Dataset,
    specimen: Dataset,
    inputs: PredictInputs,
    contact: Dataset | None = None,
    identified: Dataset | None = None,
) -> Dataset:
    """
    Run a model on the base motion that was recorded.

    Parameters
    ----------
    rocking : Dataset
        Result of `rocking`: `base_acceleration`, and that along z if it was recorded; of a free vibration, the measured
        angle that it starts from.
    specimen : Dataset
        Result of `specimen`: `restitution`.
    inputs : PredictInputs
    contact : Dataset, optional
        Result of `contact`, of the contact model: its law.
    identified : Dataset, optional
        Result of `restitution`, of a free vibration: zero and scale of its angle.

    Returns
    -------
    predicted : Dataset
        `rocking_angle` on the clock of the record; of the contact model also slide, uplift and rotation out of the
        plane, and how well its energy balance closes. A free vibration is predicted from the first peak after its first
        impact, where the measured angle is known and the velocity is zero; before it the angle is NaN. The angle is the
        true one, of which the measured one shows `angle_gain` times as much about its `zero_offset`; the attribute
        `driven_by` says which base motion was used.

    Raises
    ------
    StageError
        If there is no base motion, or a free vibration shows no arc to start from.
    """
    beginning, plan = planned(rocking, inputs, specimen, contact, identified)
    with refusals():
        history = plan.central()
    time, warnings = rocking["elapsed"].to_numpy(), list(beginning.warnings)
    start = float(time[beginning.first])
    variables: dict[str, Any] = {
        "rocking_angle": ("elapsed", beginning.padded(history.angle)),
        "base_acceleration": ("elapsed", beginning.base),
        "zero_offset": beginning.zero_offset,
        "angle_gain": beginning.angle_gain,
        "overturning_time": history.overturning_time + start,
    }
    if isinstance(history, AssemblyHistory):
        assert inputs.assembly is not None  # whose bodies were moved
        # Its rocking angle is the lean of the lowest body with all that it carries.
        peak, ratio = int(np.argmax(np.abs(history.angle))), history.peak_ratio
        impacts = history.impact_times
        variables |= {"energy_residual": history.energies.relative_residual, "impact_count": impacts.size}
        variables |= predicted_variables(history, beginning, inputs.assembly)
    else:
        peak, impacts = int(np.searchsorted(history.time, history.peak_time)), history.impact_times
        # By the α of the campaign file, as the measured one is.
        ratio = None if history.peak_ratio is None else float(amplitude(history.angle, inputs.block).max())
        variables |= {"restitution": float(specimen["restitution"]), "impact_count": history.impacts}
    if isinstance(history, ContactHistory):
        over_time = {
            "slide": history.slide[:, 0],
            "transverse_slide": history.slide[:, 1],
            "uplift": history.uplift,
            "out_of_plane_angle": history.out_of_plane_angle,
            "yaw": history.yaw,
        }
        variables |= {name: ("elapsed", beginning.padded(values)) for name, values in over_time.items()}
        variables["energy_residual"] = history.energies.relative_residual
        warnings += [serious("energy balance", text) for text in history.warnings]
    variables |= {
        "impact_time": ("impact", impacts + start),
        "peak_angle": float(history.angle[peak]),
        "peak_ratio": np.nan if ratio is None else ratio,
        "peak_time": float(history.time[peak]) + start,
    }
    attributes = {
        "outcome": history.outcome,
        "driven_by": beginning.driven_by,
        "model": inputs.model,
        "restitution_source": specimen.attrs["restitution_source"] if "restitution" in variables else "",
        "warnings": warnings,
    }
    return dataset(variables, coords={"elapsed": ("elapsed", time)}, attrs=attributes)


def planned(
    rocking: Dataset,
    inputs: PredictInputs,
    specimen: Dataset | None,
    contact: Dataset | None,
    identified: Dataset | None,
) -> tuple[Beginning, PlanePlan | ContactPlan]:
    """Find where a prediction begins, and put together what moves from there on; nothing is varied."""
    space, block = inputs.space, inputs.block
    if specimen is not None and space is None:
        block = centre(specimen, block)
    beginning = begin(rocking, inputs, identified, block)
    start: dict[str, Any] = {
        "motion": beginning.motion,
        "theta0": beginning.theta0,
        "omega0": beginning.omega0,
        "count": 1,
    }
    if space is None:
        assert specimen is not None  # which a model in the plane reads
        return beginning, PlanePlan(
            block=block,
            restitution=sides(specimen),
            uncertainty=Uncertainty(),
            model=inputs.model,
            rest_angle=inputs.rest_angle,
            **start,
        )
    law = assembly_law(space.settings) if contact is None else law_of(contact)
    if inputs.assembly is not None:
        return beginning, ContactPlan(block=block, space=InSpace(inputs.assembly.assembly, law), ranges={}, **start)
    body, out_of_plane = body_of(space, law), space.settings.out_of_plane
    return beginning, ContactPlan(
        block=plane_block(body, block.gravity),
        space=InSpace(body, law, space.settings.step),
        ranges={"out_of_plane": (out_of_plane, out_of_plane)},
        **start,
    )


def sides(specimen: Dataset) -> tuple[float, float]:
    """Return e that predictions take, of impacts that end an arc at θ < 0 and at θ > 0."""
    negative, positive = (float(e) for e in specimen["side_restitution"].to_numpy())
    return negative, positive
