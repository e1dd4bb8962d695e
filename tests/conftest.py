"""What every test shares: a deterministic hypothesis, figures without a screen, real files found or skipped."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import settings

os.environ.setdefault("MPLBACKEND", "Agg")

settings.register_profile("colonnade", deadline=None, derandomize=True)
settings.load_profile("colonnade")

SHARED_DATA = Path(__file__).resolve().parents[2] / "shared" / "data"


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Folder of real files from other laboratories; they are not part of the project."""
    if not SHARED_DATA.is_dir():
        pytest.skip(f"the collection of other laboratories' files is not here ({SHARED_DATA})")
    return SHARED_DATA
