"""The study's own modules, from the folder of the reference reports."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

REPORTS = Path(__file__).resolve().parents[2] / "reports"


@pytest.fixture(scope="session")
def study():
    """Everything that the study's modules offer, by name."""
    sys.path.insert(0, str(REPORTS))
    try:
        names = ("truth", "integration", "design", "bound", "naive", "trial", "levels", "page")
        modules = [importlib.import_module(f"monte_carlo.{name}") for name in names]
    finally:
        sys.path.remove(str(REPORTS))
    return SimpleNamespace(**{name: value for module in modules for name, value in vars(module).items()})
