"""What every test shares: a deterministic hypothesis, figures without a screen, real files found or skipped."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import settings

os.environ.setdefault("MPLBACKEND", "Agg")

settings.register_profile("colonnade", deadline=None, derandomize=True)
settings.load_profile("colonnade")

LONGEST = (
    "test_readme.py",
    "test_reports.py",
    "test_wheel.py",
    "test_processes.py",
    "test_spreading.py",
    "test_kills.py",
)
"""Files that take half a minute and more."""


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with the longest files: where several processes share the files, none is left with one in the end."""
    items.sort(key=lambda item: item.path.name not in LONGEST)


SHARED_DATA = Path(__file__).resolve().parents[2] / "shared" / "data"


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Folder of real files from other laboratories; they are not part of the project."""
    if not SHARED_DATA.is_dir():
        pytest.skip(f"the collection of other laboratories' files is not here ({SHARED_DATA})")
    return SHARED_DATA
