"""Photos on the page of a test: where they are in the report, what is said of them, and which cannot be shown."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from colonnade.campaign import Campaign, Test

KIND = "photo"
"""Kind of the findings about photos that cannot be shown."""


@dataclass(frozen=True)
class Photo:
    """A photo: its address within the report, what it is, for those who do not see it, and its path as written."""

    address: str
    description: str
    written: str


@dataclass(frozen=True)
class Photos:
    """Those of a test that are shown, and why others are not."""

    shown: tuple[Photo, ...] = ()
    problems: tuple[str, ...] = ()


NO_PHOTOS = Photos()


def address_of(test: str, number: int) -> str:
    """Address of a test's photo within the report; photos are numbered from 1."""
    return f"photos/{test}-{number}.jpg"


def photos_of(campaign: Campaign, test: Test, folder: Path) -> Photos:
    """Find the photos of a test that are in the report's folder, and the warnings of those that are not."""
    shown = []
    for number, written in enumerate(test.photos, start=1):
        address = address_of(test.id, number)
        if (folder / address).is_file():
            shown.append(Photo(address, f"Photo {number} of test {test.id}", written))
    problems = tuple(found.text for found in campaign.concerning(test.id) if found.kind == KIND)
    return Photos(tuple(shown), problems)
