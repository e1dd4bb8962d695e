"""Predict: recorded base motion, specimen and restitution -> the rocking angle of a model."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.campaign.channel import ALONG
from colonnade.dynamics.history import History, amplitude
from colonnade.dynamics.models import model_of
from colonnade.dynamics.rock import rock
from colonnade.errors import StageError
from colonnade.findings import serious
from colonnade.stages.contact import ContactInputs, assembly_law, body_of, law_of, law_variables
from colonnade.stages.parts.beginning import Beginning, BeginningInputs, begin
from colonnade.stages.parts.bodies import AssemblyInputs, predicted_variables
from colonnade.stages.parts.transducers import transducers
from colonnade.stages.specimen import centre

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.dynamics.contact.history import ContactHistory


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

    @property
    def is_in_space(self) -> bool:
        """Whether the model also moves across the plane."""
        return self.space is not None

    @classmethod
    def of(cls, campaign: Campaign, test: Test, model: str) -> PredictInputs:
        """Gather what `predict` reads for one test and model."""
        return cls(
            block=campaign.specimens[test.specimen].block(campaign.gravity),
            model=model,
            rest_angle=campaign.processing.predict.rest_angle,
            free_vibration=test.kind == "free-vibration",
            tilt=campaign.setups[test.setup].table_tilt or 0.0,
            has_vertical=any(
                abs(direction[2]) >= ALONG for direction in transducers(campaign.channels(test)).accelerations.values()
            ),
            space=ContactInputs.of(campaign, test.specimen) if model_of(model).in_space else None,
            assembly=AssemblyInputs.of(campaign, test) if model_of(model).in_space else None,
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
    if inputs.assembly is not None and inputs.space is not None:
        return _assembled(beginning, time, inputs.assembly, inputs.space).assign_attrs(
            model=inputs.model, restitution_source=""
        )
    if contact is not None and inputs.space is not None:
        moved = _in_space(beginning, contact, inputs.space)
        described = _described(moved, time, beginning, specimen, inputs)
        return described.assign(
            _space_variables(moved, beginning.first)
            | law_variables(moved.body, moved.law, moved.block.gravity)
            | {"energy_residual": ((), moved.energies.relative_residual)}
        ).assign_attrs(
            body=moved.body.description,
            warnings=[*beginning.warnings, *(serious("energy balance", text) for text in moved.warnings)],
        )
    history = rock(
        block,
        beginning.motion,
        restitution=sides(specimen),
        model=inputs.model,
        theta0=beginning.theta0,
        omega0=beginning.omega0,
        rest_angle=inputs.rest_angle,
    )
    return _described(history, time, beginning, specimen, inputs)


def _assembled(beginning: Beginning, time: Array, inputs: AssemblyInputs, space: ContactInputs) -> xr.Dataset:
    """Move the bodies of an assembly; its rocking angle is the lean of the lowest body with all that it carries."""
    import xarray as xr

    from colonnade.dynamics.contact.simulate import simulate_assembly

    try:
        moved = simulate_assembly(
            inputs.assembly,
            beginning.motion,
            law=assembly_law(space.settings),
            theta0=beginning.theta0,
            omega0=beginning.omega0,
        )
    except ValueError as error:
        raise StageError(f"processing.predict.contact: {error}") from error
    lowest, first = next(iter(moved.bodies.values())), beginning.first
    peak = int(np.argmax(np.abs(moved.angle)))
    return xr.Dataset(
        {
            "rocking_angle": ("elapsed", np.concatenate((np.full(first, np.nan), moved.angle))),
            "base_acceleration": ("elapsed", beginning.base),
            "impact_time": ("impact", lowest.impact_times + time[first]),
            "zero_offset": ((), beginning.zero_offset),
            "angle_gain": ((), beginning.angle_gain),
            "peak_angle": ((), float(moved.angle[peak])),
            "peak_ratio": ((), np.nan if moved.peak_ratio is None else moved.peak_ratio),
            "peak_time": ((), float(time[first] + moved.time[peak])),
            "overturning_time": ((), moved.overturning_time + float(time[first])),
            "impact_count": ((), lowest.impact_times.size),
            "energy_residual": ((), moved.energies.relative_residual),
        }
        | predicted_variables(moved, first, inputs),
        coords={"elapsed": ("elapsed", time)},
        attrs={"outcome": moved.outcome, "driven_by": beginning.driven_by, "warnings": beginning.warnings},
    )


def sides(specimen: xr.Dataset) -> tuple[float, float]:
    """Return e that predictions take, of impacts that end an arc at θ < 0 and at θ > 0."""
    negative, positive = (float(e) for e in specimen["side_restitution"].to_numpy())
    return negative, positive


def _in_space(beginning: Beginning, contact: xr.Dataset, inputs: ContactInputs) -> ContactHistory:
    from colonnade.dynamics.contact.simulate import simulate

    settings, law = inputs.settings, law_of(contact)
    body = body_of(inputs, law)
    try:
        return simulate(
            body,
            beginning.motion,
            law=law,
            gravity=inputs.block.gravity,
            step=settings.step,
            theta0=beginning.theta0,
            omega0=beginning.omega0,
            out_of_plane=settings.out_of_plane,
        )
    except ValueError as error:
        raise StageError(f"processing.predict.contact: {error}") from error


def _space_variables(history: ContactHistory, first: int) -> dict[str, tuple[str, Array]]:
    """What the contact model says beyond the rocking angle, NaN up to the sample at which it starts."""
    values = {
        "slide": history.slide[:, 0],
        "transverse_slide": history.slide[:, 1],
        "uplift": history.uplift,
        "out_of_plane_angle": history.out_of_plane,
        "yaw": history.yaw,
    }
    return {name: ("elapsed", np.concatenate((np.full(first, np.nan), each))) for name, each in values.items()}


def _described(
    history: History,
    time: Array,
    beginning: Beginning,
    specimen: xr.Dataset,
    inputs: PredictInputs,
) -> xr.Dataset:
    import xarray as xr

    first = beginning.first
    angle = np.concatenate((np.full(first, np.nan), history.angle))
    peak = int(np.searchsorted(history.time, history.peak_time))
    return xr.Dataset(
        {
            "rocking_angle": ("elapsed", angle),
            "base_acceleration": ("elapsed", beginning.base),
            "impact_time": ("impact", history.impact_times + time[first]),
            "restitution": ((), float(specimen["restitution"])),
            "zero_offset": ((), beginning.zero_offset),
            "angle_gain": ((), beginning.angle_gain),
            "peak_angle": ((), float(history.angle[peak])),
            # By the α of the campaign file, as the measured one is.
            "peak_ratio": ((), np.nan if history.peak_ratio is None else amplitude(history.angle, inputs.block).max()),
            "peak_time": ((), history.peak_time + float(time[first])),
            "overturning_time": ((), history.overturning_time + float(time[first])),
            "impact_count": ((), history.impacts),
        },
        coords={"elapsed": ("elapsed", time)},
        attrs={
            "outcome": history.outcome,
            "model": inputs.model,
            "restitution_source": specimen.attrs["restitution_source"],
            "driven_by": beginning.driven_by,
            "warnings": beginning.warnings,
        },
    )
