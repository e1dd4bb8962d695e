"""Photos on the page of a test: where they are in the report, and what is said of them."""

from __future__ import annotations

from dataclasses import dataclass

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
