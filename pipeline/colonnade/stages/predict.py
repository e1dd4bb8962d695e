"""Predict: recorded base motion, specimen and restitution -> the rocking angle of a model."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.history import History, amplitude
from colonnade.dynamics.models import model_of
from colonnade.dynamics.rock import rock
from colonnade.findings import serious
from colonnade.stages.contact import ContactInputs, assembly_law, body_of, law_of, law_variables, refusals
from colonnade.stages.parts.beginning import Beginning, BeginningInputs, begin
from colonnade.stages.parts.bodies import AssemblyInputs, predicted_variables
from colonnade.stages.parts.transducers import along, transducers
from colonnade.stages.specimen import centre

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.dynamics.contact.history import AssemblyHistory


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
        known, in_space = transducers(campaign.channels(test)), model_of(model).in_space
        return cls(
            block=campaign.block(test.specimen),
            model=model,
            rest_angle=campaign.processing.predict.rest_angle,
            free_vibration=test.kind == "free-vibration",
            tilt=campaign.setups[test.setup].table_tilt or 0.0,
            has_vertical=bool(along(known.accelerations, 2)),
            is_in_space=in_space,
            space=ContactInputs.of(campaign, test.specimen) if in_space else None,
            assembly=AssemblyInputs.of(campaign, test) if in_space else None,
        )


def predict(
    rocking: xr.Dataset,
    specimen: xr.Dataset,
    inputs: PredictInputs,
    contact: xr.Dataset | None = None,
    identified: xr.Dataset | None = None,
) -> xr.Dataset:
    """
    Run a model on the base motion that was recorded.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`: `base_acceleration`, and that along z if it was recorded; of a free vibration, the measured
        angle that it starts from.
    specimen : xr.Dataset
        Result of `specimen`: `restitution`.
    inputs : PredictInputs
    contact : xr.Dataset, optional
        Result of `contact`, of the contact model: its law.
    identified : xr.Dataset, optional
        Result of `restitution`, of a free vibration: zero and scale of its angle.

    Returns
    -------
    predicted : xr.Dataset
        `rocking_angle` on the clock of the record; of the contact model also slide, uplift and rotation out of the
        plane, its law with masses and weights of the nodes, and how well its energy balance closes. A free vibration
        is predicted from the first peak after its first impact, where the measured angle is known and the velocity is
        zero; before it the angle is NaN. The angle is the true one, of which the measured one shows `angle_gain` times
        as much about its `zero_offset`; the attribute `driven_by` says which base motion was used.

    Raises
    ------
    StageError
        If there is no base motion, or a free vibration shows no arc to start from.
    """
    block = inputs.block if inputs.is_in_space else centre(specimen, inputs.block)
    beginning = begin(rocking, inputs, identified, block)
    time = rocking["elapsed"].to_numpy()
    if inputs.space is not None:
        return _in_space(beginning, time, specimen, inputs, inputs.space, contact)
    history = rock(
        block,
        beginning.motion,
        restitution=sides(specimen),
        model=inputs.model,
        theta0=beginning.theta0,
        omega0=beginning.omega0,
        rest_angle=inputs.rest_angle,
    )
    return _of_block(history, time, beginning, specimen, inputs)


def sides(specimen: xr.Dataset) -> tuple[float, float]:
    """Return e that predictions take, of impacts that end an arc at θ < 0 and at θ > 0."""
    negative, positive = (float(e) for e in specimen["side_restitution"].to_numpy())
    return negative, positive


def _in_space(
    beginning: Beginning,
    time: Array,
    specimen: xr.Dataset,
    inputs: PredictInputs,
    space: ContactInputs,
    contact: xr.Dataset | None,
) -> xr.Dataset:
    """Move one body with its calibrated law, or the bodies of an assembly, by the contact model."""
    from colonnade.dynamics.contact.simulate import simulate, simulate_assembly

    settings, motion = space.settings, beginning.motion
    theta0, omega0 = beginning.theta0, beginning.omega0
    law = assembly_law(settings) if contact is None else law_of(contact)
    if inputs.assembly is not None:
        bodies = inputs.assembly.assembly
        with refusals():
            together = simulate_assembly(bodies, motion, law=law, theta0=theta0, omega0=omega0)
        return _of_assembly(together, time, beginning, inputs, inputs.assembly)
    body = body_of(space, law)
    with refusals():
        moved = simulate(
            body,
            motion,
            law=law,
            gravity=space.block.gravity,
            step=settings.step,
            theta0=theta0,
            omega0=omega0,
            out_of_plane=settings.out_of_plane,
        )
    over_time = {
        "slide": moved.slide[:, 0],
        "transverse_slide": moved.slide[:, 1],
        "uplift": moved.uplift,
        "out_of_plane_angle": moved.out_of_plane_angle,
        "yaw": moved.yaw,
    }
    described = _of_block(moved, time, beginning, specimen, inputs).assign(
        {name: ("elapsed", beginning.padded(values)) for name, values in over_time.items()}
        | law_variables(moved.body, law, moved.block.gravity)
        | {"energy_residual": moved.energies.relative_residual}
    )
    warnings = [*beginning.warnings, *(serious("energy balance", text) for text in moved.warnings)]
    return described.assign_attrs(body=moved.body.description, warnings=warnings)


def _of_block(
    history: History, time: Array, beginning: Beginning, specimen: xr.Dataset, inputs: PredictInputs
) -> xr.Dataset:
    peak = int(np.searchsorted(history.time, history.peak_time))
    # By the α of the campaign file, as the measured one is.
    ratio = None if history.peak_ratio is None else float(amplitude(history.angle, inputs.block).max())
    described = _described(history, time, beginning, peak, ratio, history.impact_times)
    return described.assign(restitution=float(specimen["restitution"]), impact_count=history.impacts).assign_attrs(
        model=inputs.model, restitution_source=specimen.attrs["restitution_source"]
    )


def _of_assembly(
    history: AssemblyHistory, time: Array, beginning: Beginning, inputs: PredictInputs, assembly: AssemblyInputs
) -> xr.Dataset:
    """Its rocking angle is the lean of the lowest body with all that it carries."""
    peak, impacts = int(np.argmax(np.abs(history.angle))), next(iter(history.bodies.values())).impact_times
    described = _described(history, time, beginning, peak, history.peak_ratio, impacts)
    return described.assign(
        {"impact_count": impacts.size, "energy_residual": history.energies.relative_residual}
        | predicted_variables(history, beginning, assembly)
    ).assign_attrs(model=inputs.model, restitution_source="")


def _described(
    history: History | AssemblyHistory,
    time: Array,
    beginning: Beginning,
    peak: int,
    peak_ratio: float | None,
    impacts: Array,
) -> xr.Dataset:
    """What all models say; the history's largest angle is at its sample `peak`."""
    import xarray as xr

    start = float(time[beginning.first])
    return xr.Dataset(
        {
            "rocking_angle": ("elapsed", beginning.padded(history.angle)),
            "base_acceleration": ("elapsed", beginning.base),
            "impact_time": ("impact", impacts + start),
            "zero_offset": beginning.zero_offset,
            "angle_gain": beginning.angle_gain,
            "peak_angle": float(history.angle[peak]),
            "peak_ratio": np.nan if peak_ratio is None else peak_ratio,
            "peak_time": float(history.time[peak]) + start,
            "overturning_time": history.overturning_time + start,
        },
        coords={"elapsed": ("elapsed", time)},
        attrs={"outcome": history.outcome, "driven_by": beginning.driven_by, "warnings": beginning.warnings},
    )
