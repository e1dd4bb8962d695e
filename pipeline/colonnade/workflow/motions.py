"""The base motion that a forecast asks for: recorded in a test, a reference motion, or a file."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from colonnade import units
from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.campaign.syntax.fields import PLAIN, Quantity, outside
from colonnade.dynamics.motion import Motion
from colonnade.errors import CampaignError, ReadError, nearest
from colonnade.findings import Finding
from colonnade.store.layout import Layout
from colonnade.workflow.product import read_done

_FACTOR = re.compile(r"\s*([0-9]*\.?[0-9]+(?:[eE][-+]?[0-9]+)?)\s*[x×]\s*", re.IGNORECASE)


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
        Along x, m/s², at the time scale.
    time_scale : float
        Factor on its own time.
    test : Test or None
        In which it was recorded: its amplitude counts then. Of any other motion only the shape does.
    """

    name: str
    source: str
    motion: Motion
    time_scale: float
    test: Test | None


def motion_asked_for(
    campaign: Campaign, layout: Layout, name: str, test: Test | None, time_scale: float | None
) -> AskedMotion:
    """
    Find a base motion by its name.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    name : str
        Id of a test that recorded it; a motion that tests name, of which the strongest recording is taken; a reference
        motion; a file that `read_motion` reads, from the present folder or that of the campaign.
    test : Test or None
        The one that the forecast is for: its time scale counts.
    time_scale : float or None
        In place of that.

    Raises
    ------
    CampaignError
        If there is no such motion or it cannot be read.
    """
    recorded = _strongest(campaign, layout, name)
    if recorded is not None:
        own, motion = recorded
        scale = time_scale or _ratio(test, own)
        source = f"recorded in {own.id}, peak {motion.peak / units.factor_to_si('g', 'acceleration'):.3g} g"
        return AskedMotion(name, source, Motion(motion.acceleration, motion.dt * scale), scale, own)
    scale = time_scale or (test.time_scale if test is not None else None) or 1.0
    source, motion = _reference(campaign, name) or _in_file(campaign, name)
    return AskedMotion(name, source, Motion(motion.acceleration, motion.dt * scale), scale, None)


def level_of(text: str, asked: AskedMotion) -> float:
    """
    Read a level: give what the motion is multiplied by.

    Parameters
    ----------
    text : str
        A peak acceleration with its unit, "0.3 g", or a factor on a recorded motion, "1.5x".
    asked : AskedMotion

    Raises
    ------
    CampaignError
        If it is neither, out of its range, or a factor on a motion of which only the shape counts.
    """
    if found := _FACTOR.fullmatch(text):
        if asked.test is None:
            raise CampaignError(
                f'--level {text}: only the shape of "{asked.name}" counts ({asked.source}), so a factor on it says '
                'nothing. Give the peak acceleration, such as "0.3 g".'
            )
        factor = float(found[1])
        if expected := outside(factor, PLAIN):
            raise CampaignError(f"--level {text}: {expected}")
        return factor
    try:
        peak = Quantity("acceleration").take(text)
    except ValueError as error:
        raise CampaignError(f'--level {text}: {error} Or a factor on a recorded motion, such as "1.5x".') from None
    if not asked.motion.peak > 0.0:
        raise CampaignError(f'"{asked.name}" does not move ({asked.source}): it cannot be brought to a level.')
    return peak / asked.motion.peak


def _strongest(campaign: Campaign, layout: Layout, name: str) -> tuple[Test, Motion] | None:
    """Return the test of this id, or of those with this motion the one whose table moved most, with its motion."""
    if name in campaign.tests:
        motion = recorded(layout, campaign.tests[name])
        if motion is None:
            raise CampaignError(f"{name}: its table motion is not known. Run `colonnade run` first.")
        return campaign.tests[name], motion
    named = [test for test in campaign.tests.values() if test.motion == name]
    found = [(test, motion) for test in named if (motion := recorded(layout, test)) is not None]
    return max(found, key=lambda pair: pair[1].peak, default=None)


def recorded(layout: Layout, test: Test) -> Motion | None:
    """Return the table motion of a test along x, None if it is not known throughout."""
    rocking = read_done(layout.stage(test.id, "rocking"))
    if rocking is None or "base_acceleration" not in rocking:
        return None
    base: Array = rocking["base_acceleration"].to_numpy()
    time = rocking["elapsed"].to_numpy()
    return Motion(base, float(time[1] - time[0])) if np.isfinite(base).all() and base.size > 1 else None


def _ratio(test: Test | None, own: Test) -> float:
    """Factor on the time of a motion that was recorded in one test, for another."""
    wanted = None if test is None else test.time_scale
    return wanted / own.time_scale if wanted is not None and own.time_scale is not None else 1.0


def _reference(campaign: Campaign, name: str) -> tuple[str, Motion] | None:
    from colonnade.stages.parts.reference_motions import load, reference_files

    known = reference_files(campaign)
    if name not in known:
        return None
    refusals: list[Finding] = []
    series = load({name: known[name]}, refusals).get(name)
    if series is None:
        raise CampaignError(" ".join(map(str, refusals)))
    return "a reference motion, by its shape", Motion(series.acceleration, series.interval)


def _in_file(campaign: Campaign, name: str) -> tuple[str, Motion]:
    from colonnade.readers.motion import read_motion

    path = next((path for path in (Path(name), campaign.folder / name) if path.is_file()), None)
    if path is None:
        known = sorted(set(_names(campaign)))
        raise CampaignError(
            f'There is no motion "{name}".{nearest(name, known)} A test that recorded one, a motion that tests name, '
            "a reference motion of [motions] or a file was expected."
        )
    try:
        return "a file, by its shape", read_motion(path, unit="m/s^2")
    except ReadError as error:
        raise CampaignError(
            f"{error} A motion that needs options (interval, column, layout) can be entered in [motions] of "
            f"{campaign.path.name}, and then given by its name."
        ) from error


def _names(campaign: Campaign) -> Iterator[str]:
    from colonnade.stages.parts.reference_motions import reference_files

    yield from campaign.tests
    yield from reference_files(campaign)
    yield from (test.motion for test in campaign.tests.values() if test.motion)
