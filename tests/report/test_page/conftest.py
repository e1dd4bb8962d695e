"""A test of the small campaign as its page takes it."""

from __future__ import annotations

import pytest

from colonnade.report.pictures.subjects import OfTest


@pytest.fixture
def subject(filled_campaign, reported):
    """A test by its id."""
    return lambda name: OfTest(filled_campaign[0], *reported[name])
