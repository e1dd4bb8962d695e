"""Whole campaigns, from raw files to summary and report."""

import json
from pathlib import Path

import numpy as np
import pytest

from colonnade.store.files import read
from colonnade.store.layout import Layout


class Outcome:
    """A campaign that was run: its summary, its results, its report."""

    def __init__(self, folder):
        self.folder = folder
        self.layout = Layout(folder)
        self.summary = json.loads(self.layout.summary_json.read_text(encoding="utf-8"))

    def test(self, name):
        return self.summary["tests"][name]

    def result(self, name, stage, model=None):
        return read(self.layout.stage(name, stage, model))

    def angle_error(self, name, critical_angle):
        """RMS of measured minus true angle over the samples with |θ| ≤ α, as a fraction of α."""
        time, true = np.loadtxt(self.folder / "truth" / f"{name}.csv", delimiter=",", skiprows=1).T
        result = self.result(name, "rocking")
        expected = np.interp(result["elapsed"], time, true)
        standing = (np.abs(expected) <= critical_angle) & np.isfinite(result["rocking_angle"].to_numpy())
        difference = (result["rocking_angle"].to_numpy() - expected)[standing]
        return float(np.sqrt(np.mean(difference**2))) / critical_angle


@pytest.fixture(scope="session")
def outcome():
    """Open what came of a campaign that was run."""
    return Outcome


@pytest.fixture(scope="session")
def run_campaign():
    """Run a campaign as a user does, and open what came of it."""
    from colonnade.workflow import run

    def runs(path, **options):
        run(path, **({"workers": 1} | options))
        return Outcome(Path(path).parent)

    return runs
