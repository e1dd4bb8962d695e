"""Motions that a table may have followed: those of the campaign file, and El Centro if it is installed."""

from __future__ import annotations

import functools
import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from colonnade.campaign import Campaign
from colonnade.errors import ReadError
from colonnade.findings import Finding, warning
from colonnade.readers.files import sha256_of
from colonnade.readers.motion import EL_CENTRO, el_centro, is_installed
from colonnade.readers.registry import companions
from colonnade.signals.named_motion import Series


class ReferenceMotionFile(BaseModel):
    """
    Where a reference motion is read from.

    Attributes
    ----------
    path : Path or None
        Its file; None for El Centro of the installed package. No part of what a result is made from: the digest is.
    digest : str
        SHA-256 of the file; empty if it cannot be read.
    interval : float or None
        s.
    column : str, int or None
    layout : str or None
        Whether columns are channels or numbers run on, if given.
    """

    model_config = ConfigDict(frozen=True)

    path: Path | None = Field(exclude=True)
    digest: str
    interval: float | None = None
    column: str | int | None = None
    layout: Literal["columns", "running"] | None = None


def reference_files(campaign: Campaign) -> dict[str, ReferenceMotionFile]:
    """Reference motions of a campaign, by name."""
    found = {
        name: ReferenceMotionFile(path=each.file, digest=_digest(each.file), **each.model_dump(exclude={"file"}))
        for name, each in campaign.motions.items()
    }
    if EL_CENTRO not in found and is_installed():
        found[EL_CENTRO] = ReferenceMotionFile(path=None, digest="")
    return found


def load(known: Mapping[str, ReferenceMotionFile], warnings: list[Finding]) -> dict[str, Series]:
    """Read reference motions; what cannot be read is reported and left out."""
    from colonnade.readers.motion import read_motion

    loaded = {}
    for name, source in known.items():
        try:
            if source.path is None:
                motion = el_centro()
            else:
                motion = read_motion(
                    source.path, unit="m/s^2", dt=source.interval, column=source.column, layout=source.layout
                )
        except ReadError as error:
            warnings.append(warning("reference motion", f'The reference motion "{name}" cannot be used: {error}'))
            continue
        loaded[name] = Series(motion.acceleration, motion.dt)
    return loaded


def _digest(path: Path) -> str:
    """SHA-256 of a file, or of all its companion files together; empty if it cannot be read."""
    own, others = _now(path)
    digests = [own, *(_now(each)[0] for each in others)]
    return own if len(digests) == 1 else hashlib.sha256(" ".join(digests).encode()).hexdigest()


def _now(path: Path) -> tuple[str, tuple[Path, ...]]:
    try:
        status = path.stat()
    except OSError:
        return "", ()
    return _known(path, status.st_size, status.st_mtime_ns)


@functools.lru_cache(maxsize=64)
def _known(path: Path, size: int, changed: int) -> tuple[str, tuple[Path, ...]]:
    """SHA-256 of a file, and the other files that it is in; none if they cannot be found, as reading it then says."""
    try:
        return sha256_of(path) or "", companions(path)
    except ReadError:
        return sha256_of(path) or "", ()
