"""Everything that the study's modules offer, by name."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from spread_verdicts import design, judging, page, trial


@pytest.fixture(scope="session")
def study():
    modules = (design, trial, judging, page)
    return SimpleNamespace(**{name: value for module in modules for name, value in vars(module).items()})
