"""A campaign file as contract 1 shows it, and a way to load a changed one."""

from pathlib import Path

import pytest

from colonnade.campaign import load

CONTRACT = Path(__file__).with_name("contract.toml").read_text(encoding="utf-8")


@pytest.fixture
def contract():
    """Text of a campaign file that has every key of contract 1."""
    return CONTRACT


@pytest.fixture
def load_text(tmp_path):
    """Load a campaign file of this text."""

    def loaded(text):
        (tmp_path / "campaign.toml").write_text(text, encoding="utf-8")
        return load(tmp_path)

    return loaded
