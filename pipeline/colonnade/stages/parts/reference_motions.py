"""Motions that a table may have followed: those of the campaign file, and El Centro if it is installed."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field

from colonnade.campaign import Campaign
from colonnade.campaign.test import ReferenceMotion
from colonnade.errors import ReadError
from colonnade.findings import Finding, warning
from colonnade.readers.files import sha256_of
from colonnade.readers.motion import EL_CENTRO, el_centro, is_installed
from colonnade.signals.named_motion import Series


class ReferenceMotionFile(BaseModel):
    """
    Where a reference motion is read from.

    Attributes
    ----------
    given : ReferenceMotion or None
        As the campaign file gives it, None for El Centro of the installed package. No part of what a result is made
        from: the content is.
    content : str
        SHA-256 of the file, empty if it cannot be read, and how it is read.
    """

    model_config = ConfigDict(frozen=True)

    given: ReferenceMotion | None = Field(exclude=True)
    content: str


def reference_files(campaign: Campaign) -> dict[str, ReferenceMotionFile]:
    """Reference motions of a campaign, by name."""
    found = {
        name: ReferenceMotionFile(given=each, content=f"{_digest(each.file)} {each.model_dump_json(exclude={'file'})}")
        for name, each in campaign.motions.items()
    }
    if EL_CENTRO not in found and is_installed():
        found[EL_CENTRO] = ReferenceMotionFile(given=None, content=EL_CENTRO)
    return found


def load(known: Mapping[str, ReferenceMotionFile], warnings: list[Finding]) -> dict[str, Series]:
    """Read reference motions; what cannot be read is reported and left out."""
    from colonnade.readers.motion import read_motion

    loaded = {}
    for name, source in known.items():
        try:
            given = source.given
            if given is None:
                motion = el_centro()
            else:
                how = given.model_dump(include={"column", "layout"})
                motion = read_motion(given.file, unit="m/s^2", dt=given.interval, **how)
        except ReadError as error:
            warnings.append(warning("reference motion", f'The reference motion "{name}" cannot be used: {error}'))
            continue
        loaded[name] = Series(motion.acceleration, motion.dt)
    return loaded


def _digest(path: Path) -> str:
    """SHA-256 of a file; empty if it cannot be read."""
    try:
        status = path.stat()
    except OSError:
        return ""
    return _known(path, status.st_size, status.st_mtime_ns)


@lru_cache(maxsize=64)
def _known(path: Path, size: int, changed: int) -> str:
    return sha256_of(path) or ""
