"""The laws of contact of a campaign's specimens: those for its own settings are stored, others are only shown."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

from colonnade.campaign import Campaign, load
from colonnade.campaign.settings import ContactSettings
from colonnade.errors import CampaignError, ColonnadeError, nearest
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.catalogue import Catalogue, stored_attributes
from colonnade.workflow.chain import Chain, bring_up_to_date
from colonnade.workflow.execution.lock import only_run
from colonnade.workflow.execution.spreading import spread
from colonnade.workflow.steps import Graph
from colonnade.workflow.walk import Walk

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Calibrated:
    """
    The law of contact of one specimen, on one mesh with one step.

    Attributes
    ----------
    specimen, mesh, body : str
        Id of the specimen; mesh as in the settings; description of the body for people.
    step : float
        s.
    target, restitution : float or None
        e asked for, and e of the model's free vibration; None if the calibration failed.
    source : str
        How the latter was found: `IDENTIFIED` from the rocking angle, or the `VELOCITY_RATIO` if the identification
        gives no e; empty if the calibration failed.
    velocity_ratio : float or None
        Mean velocity ratio of the impacts of the same free vibration.
    damping_fraction, effective_damping, stiffness : float or None
        ξ at each node, ξ of the whole body, and the stiffness, N/m³.
    energy_residual : float or None
        Of the model's free vibration with this law.
    reason : str
        Why the calibration failed, or missed its target; else empty.
    path : Path or None
        Where the law is stored; None unless it is for the campaign's own settings.
    seconds : float
        Time of computing; 0 if the law was stored already.
    """

    specimen: str
    mesh: str
    body: str
    step: float
    target: float | None
    restitution: float | None
    source: str
    velocity_ratio: float | None
    damping_fraction: float | None
    effective_damping: float | None
    stiffness: float | None
    energy_residual: float | None
    reason: str
    path: Path | None
    seconds: float


@dataclass(frozen=True)
class _Task:
    """A law to be found; `chain` stores it if it is for the campaign's own settings, else it is only shown."""

    campaign: Campaign
    layout: Layout
    specimen: str
    settings: ContactSettings
    chain: Chain | None


def calibrate(
    campaign: Path | str,
    *,
    specimens: Sequence[str] = (),
    meshes: Sequence[str] = (),
    steps: Sequence[float] = (),
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
    meshes : sequence of str, optional
        Meshes; default that of the settings.
    steps : sequence of float, optional
        s; default that of the settings.
    workers : int, optional
        Processes; default one a core.
    results : Path or str, optional
        Folder that holds `processed` and `report`; default that of the campaign file.

    Returns
    -------
    calibrated : list of Calibrated
        Specimen by specimen, mesh by mesh, step by step.

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
    own = loaded.processing.predict.contact
    with only_run(layout) as run_id:
        for name in chosen:
            is_given = loaded.specimens[name].restitution is not None
            if not is_given and stored_attributes(layout.stage(name, "specimen")).get("status") != "done":
                raise CampaignError(f"{name}: its restitution is not known yet. Run `colonnade identify` first.")
        graph = Graph(loaded, layout, Catalogue(layout))
        walk = Walk(graph, run_id, workers=1)
        walk.pool()
        for name in chosen:
            if name in walk.failed_specimens:
                raise CampaignError(f"{name}: {walk.failed_specimens[name]}")
        tasks = []
        for name, mesh, step in product(chosen, meshes or (own.mesh,), steps or (own.step,)):
            settings = own.model_copy(update={"mesh": mesh, "step": step})
            chain = walk.chain([graph.calibrating(name)]) if settings == own else None
            tasks.append(_Task(loaded, layout, name, settings, chain))
        found = dict(spread(_calibrated, list(enumerate(tasks)), workers=workers))
    return [found[number] for number in range(len(tasks))]


def _calibrated(numbered: tuple[int, _Task]) -> tuple[int, Calibrated]:
    """Find one law; store it if it is for the campaign's own settings."""
    number, task = numbered
    campaign, layout = task.campaign, task.layout
    started = time.perf_counter()
    path = None
    if task.chain is not None:
        path = layout.stage(task.specimen, "contact")
        [done] = bring_up_to_date(task.chain)
        result, reason = (None, done.reason) if done.action == "failed" else (files.read(path), "")
    else:
        from colonnade.stages import contact

        try:
            pooled = files.read(layout.stage(task.specimen, "specimen"))
            result = contact.contact(pooled, contact.ContactInputs.of(campaign, task.specimen, task.settings))
            reason = ""
        except ColonnadeError as error:
            result, reason = None, str(error)
    known = _known(result)
    return number, Calibrated(
        specimen=task.specimen,
        mesh=task.settings.mesh,
        body="" if result is None else str(result.attrs["body"]),
        step=known["contact_step"] or task.settings.step,
        target=known["restitution"],
        restitution=known["contact_restitution"],
        source="" if result is None else str(result.attrs["contact_restitution_source"]),
        velocity_ratio=known["contact_velocity_ratio"],
        damping_fraction=known["damping_fraction"],
        effective_damping=known["effective_damping"],
        stiffness=known["contact_stiffness"],
        energy_residual=known["energy_residual"],
        reason=reason or _warning(result),
        path=None if result is None else path,
        seconds=time.perf_counter() - started,
    )


def _known(result: xr.Dataset | None) -> dict[str, float | None]:
    names = (
        "contact_step",
        "restitution",
        "contact_restitution",
        "contact_velocity_ratio",
        "damping_fraction",
        "effective_damping",
        "contact_stiffness",
        "energy_residual",
    )
    return {name: None if result is None else float(result[name]) for name in names}


def _warning(result: xr.Dataset | None) -> str:
    """Return why a law missed its target, if it did."""
    return "" if result is None else " ".join(map(str, result.attrs["warnings"]))
