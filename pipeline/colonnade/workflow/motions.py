"""The base motion that a command asks for: recorded in a test, a reference motion, or a file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.motion import Motion
from colonnade.errors import CampaignError, nearest
from colonnade.findings import Finding
from colonnade.store.layout import Layout
from colonnade.units.text import quantity
from colonnade.workflow.product import read_done


@dataclass(frozen=True)
class AskedMotion:
    """
    A base motion before it is brought to a level.

    Attributes
    ----------
    name : str
        As it was asked for.
    source : str
        Where it comes from, in words.
    motion : Motion
        m/s², in its own time.
    test : Test or None
        In which it was recorded.
    is_shape : bool
        Whether its amplitude says nothing, as that of a reference motion.
    """

    name: str
    source: str
    motion: Motion
    test: Test | None = None
    is_shape: bool = False

    def factor_to(self, peak: float) -> float:
        """Give the factor that brings it to a peak, m/s²."""
        if not self.motion.peak > 0.0:
            raise CampaignError(f'"{self.name}" does not move ({self.source}): it cannot be brought to a peak.')
        return peak / self.motion.peak


def motion_asked_for(
    name: str, campaign: Campaign | None, layout: Layout | None, *, by_shape: bool = False, **reading: Any
) -> AskedMotion:
    """
    Find a base motion by its name.

    Parameters
    ----------
    name : str
        Id of a test that recorded it; a motion that tests name, of which the strongest recording is taken; a reference
        motion; a file that `read_motion` reads, from the present folder or that of the campaign.
    campaign, layout : optional
        None without a campaign.
    by_shape : bool, optional
        Of a file, too, only the shape counts.
    **reading
        How a file is read, as in `read_motion`; if any option is given, the name is that of a file.

    Raises
    ------
    CampaignError
        If there is no such motion, or a reference motion cannot be read.
    ReadError
        If a file cannot be read.
    """
    from colonnade.readers.motion import read_motion
    from colonnade.stages.parts.reference_motions import reference_files

    if campaign is not None and layout is not None and not reading:
        found = _strongest(campaign, layout, name) or _reference(campaign, name)
        if found is not None:
            return found
    folders = [Path()] if campaign is None else [Path(), campaign.folder]
    path = next((folder / name for folder in folders if (folder / name).is_file()), None)
    if path is None:
        known = [] if campaign is None else [*campaign.tests, *reference_files(campaign)]
        raise CampaignError(
            f'There is no motion "{name}".{nearest(name, known)} A file was expected or, of a campaign, a test that '
            "recorded one, a motion that tests name, or a reference motion of [motions]."
        )
    source, how = ("a file, by its shape", {"unit": "m/s^2"}) if by_shape else (f"file {path.name}", reading)
    return AskedMotion(name, source, read_motion(path, **how), is_shape=by_shape)


def _strongest(campaign: Campaign, layout: Layout, name: str) -> AskedMotion | None:
    """Return what the test of this id recorded, or of those with this motion the one whose table moved most."""
    tests = [test for test in campaign.tests.values() if name in (test.id, test.motion)]
    found = [(test, motion) for test in tests if (motion := recorded(layout, test)) is not None]
    if found:
        test, motion = max(found, key=lambda pair: pair[1].peak)
        return AskedMotion(name, f"recorded in {test.id}, peak {quantity(motion.peak, 'g')}", motion, test)
    if name in campaign.tests:
        raise CampaignError(f"{name}: its table motion is not known. Run `colonnade run` first.")
    return None


def recorded(layout: Layout, test: Test) -> Motion | None:
    """Return the table motion of a test along x, None if it is not known throughout."""
    rocking = read_done(layout.stage(test.id, "rocking"))
    if rocking is None or "base_acceleration" not in rocking:
        return None
    base: Array = rocking["base_acceleration"].to_numpy()
    time = rocking["elapsed"].to_numpy()
    return Motion(base, float(time[1] - time[0])) if np.isfinite(base).all() and base.size > 1 else None


def _reference(campaign: Campaign, name: str) -> AskedMotion | None:
    from colonnade.stages.parts.reference_motions import load, reference_files

    known = reference_files(campaign)
    if name not in known:
        return None
    refusals: list[Finding] = []
    series = load({name: known[name]}, refusals).get(name)
    if series is None:
        raise CampaignError(" ".join(map(str, refusals)))
    motion = Motion(series.acceleration, series.interval)
    return AskedMotion(name, "a reference motion, by its shape", motion, is_shape=True)
