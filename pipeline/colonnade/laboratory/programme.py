"""Virtual campaigns, planned and written; the smaller of two: ten tests of the paper's prism."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.campaign_file import FILE_NAME, campaign_text, refuse_foreign
from colonnade.laboratory.experiment import Plan, Specimen
from colonnade.laboratory.files import put
from colonnade.laboratory.plans.trials import LENGTH_SCALE, Placed, earthquakes, free_vibrations, sine
from colonnade.laboratory.record import load_record
from colonnade.laboratory.rig import prism_setups
from colonnade.laboratory.runs import run_tests, write_truth
from colonnade.laboratory.site import add_site
from colonnade.store.files import own_files

PRISM_RESTITUTION = 0.976
"""The paper's coefficient of restitution of the prism."""

SINES = (("sine-3Hz", 3.0, 0.80), ("sine-5Hz", 5.0, 1.50), ("sine-4Hz", 4.0, 1.80), ("sine-2Hz", 2.0, 1.80))
"""Id, Hz, A: no rocking, rocking twice, overturning; each outcome holds for 15 % less and more of A."""


@dataclass(frozen=True)
class WrittenCampaign:
    """
    A virtual campaign on disk.

    Attributes
    ----------
    path : Path
        Its campaign.toml.
    truth : dict
        What truth/truth.json next to it holds: by specimen `restitution` and more, by test `outcome`, `peak_ratio` and
        more. The true angle of each test is in the same folder.
    """

    path: Path
    truth: dict[str, Any]


def write_campaign(
    folder: Path | str,
    *,
    seed: int = 0,
    motion: Path | None = None,
    programme: Callable[..., Plan] | None = None,
    workers: int | None = 1,
    site: bool = False,
) -> WrittenCampaign:
    """
    Write a virtual campaign.

    Parameters
    ----------
    folder : Path or str
        Folder of campaign.toml, raw/ and truth/; made if necessary.
    seed : int, optional
        Of noise, offsets, spikes and the exact releases. The same seed gives the same files.
    motion : Path, optional
        File with the earthquake record; default: El Centro 1940 NS of the extra `demo`.
    programme : callable, optional
        `paper_programme`, or `prism_programme`, the default: its prism's ten tests.
    workers : int or None, optional
        Processes; None takes one a core.
    site : bool, optional
        Also ask whether the real columns stand, on synthetic ground motions.

    Returns
    -------
    written : WrittenCampaign

    Raises
    ------
    ReadError
        If the record is missing or cannot be read.
    CampaignError
        If the folder holds a campaign that the laboratory did not write.
    StoreError
        If a file cannot be written.
    """
    name, record = load_record(motion)
    plan = (programme or prism_programme)(name, record, seed=seed)
    written = write(plan, folder, seed=seed, workers=workers)
    if site:
        add_site(plan, written.path, seed=seed)
    return written


def write(plan: Plan, folder: Path | str, *, seed: int = 0, workers: int | None = 1) -> WrittenCampaign:
    """Run a plan: write its raw files, its truth and its campaign file; see `write_campaign`."""
    folder = Path(folder)
    refuse_foreign(folder)
    for name in ("raw", "truth"):
        own_files(folder / name)
    records = run_tests(plan, folder, seed, workers)
    truth = write_truth(plan, records, folder, seed)
    put(folder / FILE_NAME, campaign_text(plan).encode())
    return WrittenCampaign(folder / FILE_NAME, truth)


def prism_programme(name: str, record: Motion, *, seed: int = 0) -> Plan:
    """
    Plan three free vibrations, four sine tests and an earthquake at three Spans for the paper's prism.

    Parameters
    ----------
    name : str
        Of the earthquake record.
    record : Motion
        At full scale; its time is divided by √20, and its largest acceleration set to `PEAK_PER_SPAN` × Span.
    seed : int, optional
        Of the exact releases.
    """
    prism = paper_prism()
    placed = Placed("prism", prism.block, "bench", "table")
    sines = (sine(placed, *each, cycles=round(4 * each[1]), ramp=3) for each in SINES)
    generator = np.random.default_rng(seed)
    return Plan(
        campaign="virtual-prism",
        title="Rocking of a solid steel prism on a virtual shake table",
        specimens={"prism": prism},
        setups=prism_setups(),
        trials=(*free_vibrations(placed, generator), *sines, *earthquakes(placed, name, record)),
    )


def paper_prism() -> Specimen:
    """Build the paper's prism."""
    return Specimen(
        {
            "shape": "prism",
            "width": "86 mm",
            "depth": "86 mm",
            "height": "456 mm",
            "mass": "26.10 kg",
            "scale": LENGTH_SCALE,
        },
        Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10),
        PRISM_RESTITUTION,
    )
