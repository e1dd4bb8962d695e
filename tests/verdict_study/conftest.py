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
        modules = [
            importlib.import_module(f"spread_verdicts.{name}") for name in ("design", "trial", "judging", "page")
        ]
    finally:
        sys.path.remove(str(REPORTS))
    return SimpleNamespace(**{name: value for module in modules for name, value in vars(module).items()})
