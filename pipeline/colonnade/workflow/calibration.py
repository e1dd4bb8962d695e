"""The laws of contact of a campaign's specimens, as a run finds and stores them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from colonnade.campaign import load
from colonnade.errors import CampaignError, nearest
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.catalogue import Catalogue, stored_attributes
from colonnade.workflow.execution.lock import only_run
from colonnade.workflow.steps import Graph
from colonnade.workflow.walk import Walk


@dataclass(frozen=True)
class Calibrated:
    """
    The law of contact of one specimen.

    Attributes
    ----------
    specimen, mesh : str
        Id of the specimen; mesh as in the settings.
    reason : str
        Why the calibration failed, or missed its target; else empty.
    body : str
        Description for people; empty, as the numbers below are None, if the calibration failed.
    step : float or None
        s.
    target, restitution : float or None
        e asked for, and e of the model's free vibration.
    source : str
        How the latter was found: `IDENTIFIED` from the rocking angle, or the `VELOCITY_RATIO` if the identification
        gives no e.
    velocity_ratio : float or None
        Mean velocity ratio of the impacts of the same free vibration.
    damping_fraction, effective_damping, stiffness : float or None
        ξ at each node, ξ of the whole body, and the stiffness, N/m³.
    energy_residual : float or None
        Of the model's free vibration with this law.
    path : Path or None
        Where the law is stored.
    """

    specimen: str
    mesh: str
    reason: str
    body: str = ""
    step: float | None = None
    target: float | None = None
    restitution: float | None = None
    source: str = ""
    velocity_ratio: float | None = None
    damping_fraction: float | None = None
    effective_damping: float | None = None
    stiffness: float | None = None
    energy_residual: float | None = None
    path: Path | None = None


def calibrate(
    campaign: Path | str,
    *,
    specimens: Sequence[str] = (),
    workers: int | None = None,
    results: Path | str | None = None,
) -> list[Calibrated]:
    """
    Find the contact damping with which each specimen rocks freely with its restitution.

    Parameters
    ----------
    campaign : Path or str
        A campaign.toml or its folder; its free vibrations have been identified.
    specimens : sequence of str, optional
        Ids; default all.
    workers : int, optional
        Processes; default one a core.
    results : Path or str, optional
        Folder that holds `processed` and `report`; default that of the campaign file.

    Returns
    -------
    calibrated : list of Calibrated
        Specimen by specimen.

    Raises
    ------
    CampaignError
        If the campaign file is not usable, or a specimen is not in it or not identified yet.
    StoreError
        If a run is in progress, or results cannot be written.
    """
    loaded = load(Path(campaign))
    layout = Layout.of(loaded.path, results)
    for name in specimens:
        if name not in loaded.specimens:
            raise CampaignError(f'{loaded.path.name} has no specimen "{name}".{nearest(name, loaded.specimens)}')
    chosen = list(specimens or loaded.specimens)
    mesh = loaded.processing.predict.contact.mesh
    with only_run(layout) as run_id:
        for name in chosen:
            is_given = loaded.specimens[name].restitution is not None
            if not is_given and stored_attributes(layout.stage(name, "specimen")).get("status") != "done":
                raise CampaignError(f"{name}: its restitution is not known yet. Run `colonnade identify` first.")
        walk = Walk(Graph(loaded, layout, Catalogue(layout)), run_id, workers=workers)
        walk.pool()
        for name in chosen:
            if name in walk.failed_specimens:
                raise CampaignError(f"{name}: {walk.failed_specimens[name]}")
        walk.calibrate(chosen)
        failed = walk.failed_specimens
        return [
            Calibrated(name, mesh, failed[name]) if name in failed else _stored(name, mesh, layout) for name in chosen
        ]


def _stored(specimen: str, mesh: str, layout: Layout) -> Calibrated:
    path = layout.stage(specimen, "contact")
    law = files.read(path)
    return Calibrated(
        specimen,
        mesh,
        " ".join(map(str, law.attrs["warnings"])),
        str(law.attrs["body"]),
        step=float(law["contact_step"]),
        target=float(law["restitution"]),
        restitution=float(law["contact_restitution"]),
        source=str(law.attrs["contact_restitution_source"]),
        velocity_ratio=float(law["contact_velocity_ratio"]),
        damping_fraction=float(law["damping_fraction"]),
        effective_damping=float(law["effective_damping"]),
        stiffness=float(law["contact_stiffness"]),
        energy_residual=float(law["energy_residual"]),
        path=path,
    )
