"""The real columns of a virtual campaign, and a site for them: synthetic ground motions and a made-up hazard."""

from __future__ import annotations

from math import sqrt
from pathlib import Path

import numpy as np

from colonnade.campaign.syntax.document import toml_key, toml_value
from colonnade.laboratory.experiment import Plan, Specimen
from colonnade.laboratory.files import put
from colonnade.laboratory.suite.records import synthetic_records, write_suite

FOLDER = "records"
HAZARD = "hazard-synthetic.csv"

KNOWN_WITHIN = 0.02
"""Limits of α and p of the real columns, relative."""

RESTITUTION, FRICTION = (0.93, 0.985), (0.6, 0.8)
"""Limits of e and of the friction of the real columns."""

LEVELS = np.geomspace(0.02, 3.0, 16)
"""PGV of the hazard, m/s."""

_HEAD = """
# The real columns that these specimens are models of, and a question about each of them. Ground motions and hazard
# are synthetic: no site has them. That the e of a model holds for its column is an assumption, within the limits given.
"""


def annual_rate(velocity: float) -> float:
    """
    Rate a year at which a PGV (m/s) is exceeded at the made-up site: it falls ever faster.

    Examples
    --------
    >>> [round(annual_rate(each), 6) for each in (0.1, 0.5)]
    [0.01, 0.000386]
    """
    steps = np.log(velocity / 0.1)
    return float(0.01 * np.exp(-1.7 * steps - 0.2 * steps**2))


def site_text(plan: Plan) -> str:
    """Write out the real columns and their assessments for a campaign file."""
    lines = [_HEAD.rstrip()]
    for name, specimen in plan.specimens.items():
        lines += ["", f"[prototype.{toml_key(name)}]", *(_line(*each) for each in _column(specimen).items())]
        asked = {
            "specimen": name,
            "records": f"{FOLDER}/records.csv",
            "measure": "pgv",
            "hazard": HAZARD,
        }
        lines += ["", f"[assessments.{toml_key(name)}]", *(_line(*each) for each in asked.items())]
    return "\n".join([*lines, ""])


def add_site(plan: Plan, campaign_file: Path, *, seed: int) -> None:
    """
    Add the real columns, the ground motions and the hazard to a campaign that was written.

    Parameters
    ----------
    plan : Plan
    campaign_file : Path
    seed : int
        Of the ground motions.

    Raises
    ------
    StoreError
        If a file cannot be written.
    """
    folder = campaign_file.parent
    write_suite(folder / FOLDER, synthetic_records(seed=seed))
    rows = [f"{level:.4g}, {annual_rate(level):.4g}" for level in LEVELS.tolist()]
    put(folder / HAZARD, "\n".join(["pgv [m/s], rate [1/year]", *rows, ""]).encode())
    put(campaign_file, campaign_file.read_bytes() + site_text(plan).encode())


def _column(specimen: Specimen) -> dict[str, object]:
    block = specimen.block
    p = block.p / sqrt(float(specimen.shape["scale"]))
    return {
        "restitution": "identified",
        "restitution_range": list(RESTITUTION),
        "critical_angle_range": _around(block.critical_angle, "rad"),
        "p_range": _around(p, "rad/s"),
        "friction": sum(FRICTION) / 2,
        "friction_range": list(FRICTION),
    }


def _around(value: float, unit: str) -> list[str]:
    return [f"{value * (1 + change):.4g} {unit}" for change in (-KNOWN_WITHIN, KNOWN_WITHIN)]


def _line(key: str, value: object) -> str:
    return f"{key} = {toml_value(value)}"
