"""Everything that the study's modules offer, by name."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from monte_carlo import bound, design, integration, levels, naive, page, trial, truth


@pytest.fixture(scope="session")
def study():
    modules = (truth, integration, design, bound, naive, trial, levels, page)
    return SimpleNamespace(**{name: value for module in modules for name, value in vars(module).items()})
