"""Contact: the law of contact with which a specimen rocks freely with its restitution, for the contact model."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import lru_cache, partial

from colonnade.arrays import Dataset, dataset
from colonnade.campaign import Campaign
from colonnade.campaign.settings import ContactSettings
from colonnade.dynamics.block import Block
from colonnade.dynamics.contact.body import ContactBody, ContactLaw, rigid_body
from colonnade.dynamics.contact.calibration import FRACTIONS, VELOCITY_RATIO, calibrate, free_restitution
from colonnade.dynamics.contact.history import ContactHistory
from colonnade.dynamics.contact.stability import keep_modes_for_step
from colonnade.errors import StageError
from colonnade.findings import warning
from colonnade.identification.restitution.identify import identify_restitution
from colonnade.store.provenance import Inputs

IDENTIFIED = "identified"
"""What a restitution is that was identified from a rocking angle."""


class ContactInputs(Inputs):
    """
    What `contact` reads of the campaign: the specimen in space, and the settings of the contact model.

    `lowest_amplitude` is that of the identification, |θ|/α.
    """

    block: Block
    shape: str
    sizes: tuple[tuple[str, float], ...]
    settings: ContactSettings
    lowest_amplitude: float

    @classmethod
    def of(cls, campaign: Campaign, specimen: str) -> ContactInputs:
        """Gather what `contact` reads for one specimen."""
        entry = campaign.specimens[specimen]
        return cls(
            block=entry.block(campaign.gravity),
            shape=entry.shape,
            sizes=tuple(sorted(entry.sizes().items())),
            settings=campaign.processing.predict.contact,
            lowest_amplitude=campaign.processing.restitution.lowest_amplitude,
        )


def contact(specimen: Dataset, inputs: ContactInputs) -> Dataset:
    """
    Calibrate the contact of a specimen.

    Parameters
    ----------
    specimen : Dataset
        Result of `specimen`: the restitution that predictions take.
    inputs : ContactInputs

    Returns
    -------
    law : Dataset
        Stiffness, damping and friction; by `node` mass, weight (N, of the standing body) and radius (m, 0 of a point);
        of the free vibration with this law the `contact_restitution`, identified from its rocking angle as from a
        record, and the `contact_velocity_ratio`. The
        attribute `contact_restitution_source` is `IDENTIFIED`, or `VELOCITY_RATIO` if the identification gives no e. A
        damping fraction given in the campaign is not calibrated, but its restitution is computed.

    Raises
    ------
    StageError
        If the specimen cannot be meshed, or the step is too long for the contact.
    """
    settings = inputs.settings
    with refusals():
        body = _whole_body(inputs)
    given = settings.damping_fraction != "auto"
    law = ContactLaw(
        damping_fraction=float(settings.damping_fraction) if given else 0.0,
        friction=settings.friction,
        penetration=settings.penetration,
    ).bearing(body, inputs.block.gravity)
    with refusals():
        found = calibrate(
            body,
            law,
            float(specimen["restitution"]),
            gravity=inputs.block.gravity,
            step=settings.step,
            fractions=(law.damping_fraction,) if given else FRACTIONS,
            identify=partial(identified, lowest_amplitude=inputs.lowest_amplitude),
        )
    history, body, law = found.history, found.history.body, found.history.law
    return dataset(
        {
            "contact_restitution": found.restitution,
            "contact_velocity_ratio": free_restitution(history),
            "restitution": float(specimen["restitution"]),
            "contact_step": history.step,
            "energy_residual": history.energies.relative_residual,
            "contact_stiffness": law.stiffness,
            "damping_fraction": law.damping_fraction,
            "friction": law.friction,
            "effective_damping": law.effective_damping(body),
            "node_mass": ("node", body.node_mass),
            "node_weight": ("node", body.mass * inputs.block.gravity * body.node_area / body.node_area.sum()),
            "ring_radius": ("node", body.ring_radii),
        },
        attrs={
            "body": body.description,
            "contact_restitution_source": found.source,
            "warnings": [] if given or not found.reason else [warning("contact law", found.reason)],
        },
    )


def identified(history: ContactHistory, *, lowest_amplitude: float) -> tuple[float, str]:
    """
    Restitution that a laboratory would identify from the rocking angle of a free vibration, and `IDENTIFIED`.

    If the identification refuses it, as after two or three arcs, the mean velocity ratio of the impacts, and
    `VELOCITY_RATIO`.
    """
    result = identify_restitution(history.time, history.angle, history.block, lowest_amplitude=lowest_amplitude)
    if result.value is None:
        return free_restitution(history), VELOCITY_RATIO
    return result.value, IDENTIFIED


def law_of(calibrated: Dataset) -> ContactLaw:
    """Return the law of contact that a result of `contact` describes."""
    stiffness, damping, friction = (
        float(calibrated[name]) for name in ("contact_stiffness", "damping_fraction", "friction")
    )
    return ContactLaw(stiffness=stiffness, damping_fraction=damping, friction=friction)


def assembly_law(settings: ContactSettings) -> ContactLaw:
    """Return the law of contact of several bodies: that of the settings, which no free vibration calibrates."""
    law = ContactLaw(friction=settings.friction, penetration=settings.penetration)
    given = settings.damping_fraction
    return law if given == "auto" else replace(law, damping_fraction=float(given))


def body_of(inputs: ContactInputs, law: ContactLaw) -> ContactBody:
    """
    Build the body of the contact model, with the modes that the step follows with a law.

    Raises
    ------
    StageError
        If a body without dimensions is to be meshed, or the step is too long for the law.
    """
    with refusals():
        return keep_modes_for_step(_whole_body(inputs), law, inputs.settings.step)


@contextmanager
def refusals() -> Iterator[None]:
    """Tell what the contact model refuses as an error about its settings in the campaign file."""
    try:
        yield
    except ValueError as error:
        raise StageError(f"processing.predict.contact: {error}") from error


@lru_cache(maxsize=4)
def _whole_body(inputs: ContactInputs) -> ContactBody:
    """Build the body with all its modes; meshing takes its time, so the last few are kept."""
    settings, solid = inputs.settings, inputs.block.solid
    if settings.mesh == "rigid":
        return rigid_body(inputs.block)
    if solid is None:
        raise StageError(
            f"processing.predict.contact.mesh is {settings.mesh}, but this specimen is of shape "
            f'"{inputs.shape}" and has no dimensions to mesh. A prism, a cylinder or a cone was expected.'
        )
    from colonnade.dynamics.contact.elastic import elastic_body

    return elastic_body(
        solid,
        inputs.block.mass,
        degrees_of_freedom=settings.mesh,
        modulus=settings.modulus,
        poisson_ratio=settings.poisson_ratio,
    )
