"""TOML files of a campaign as text and as tables, refused in words where they are neither."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

from colonnade.campaign.places import Place
from colonnade.errors import CampaignError
from colonnade.readers.irregular import irregular

_LARGEST_BYTES = 20_000_000


def read_text(path: Path) -> str:
    """
    Read a text file that a person wrote.

    Raises
    ------
    CampaignError
        If it cannot be read or is not UTF-8.
    """
    if kind := irregular(path):
        raise CampaignError(f"{path.name}: this is {kind}; a text file was expected.")
    try:
        if path.stat().st_size > _LARGEST_BYTES:
            raise CampaignError(f"{path.name} is larger than a campaign's own files can be. Is it a raw file?")
        return path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise CampaignError(
            f"{path.name}: byte {error.start + 1} is not UTF-8 text. "
            "Save the file as UTF-8; editors offer it as the encoding."
        ) from None
    except OSError as error:
        raise CampaignError(f"{path.name}: it cannot be read ({error.strerror}).") from None


def parse(text: str, name: str) -> dict[str, Any]:
    """
    Parse TOML.

    Raises
    ------
    CampaignError
        If it is none; the message gives line and column.
    """
    try:
        return tomllib.loads(text.replace("\r\n", "\n"))
    except (ValueError, RecursionError) as error:  # a number of thousands of digits is a plain ValueError
        said = "tables or lists are nested too deeply" if isinstance(error, RecursionError) else str(error)
        raise CampaignError(
            f"{name}: this is not TOML: {said}. Text stands in quotes, lists in [ ], and each key once in its table."
        ) from None


def place_of(location: Place) -> Place:
    """Return a key's place: pydantic's, without its mark for a key."""
    return tuple(part for part in location if part != "[key]")
