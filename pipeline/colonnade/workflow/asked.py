"""What a command asks about: a column (a specimen, its real column, sizes, or α and p) and a base motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import numpy as np
from pydantic import ValidationError

from colonnade.arrays import Array
from colonnade.assessment.real_column import RealColumn
from colonnade.campaign import Campaign, Test
from colonnade.campaign.assessment import Prototype
from colonnade.campaign.specimen import OUTER_DIMENSIONS, SIZED
from colonnade.campaign.syntax.fields import OneOf, Scale
from colonnade.campaign.syntax.table import Table
from colonnade.dynamics.block import STANDARD_GRAVITY, pair
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.spectra import rectangular
from colonnade.errors import CampaignError, nearest
from colonnade.findings import Finding
from colonnade.stages.assessment_plan import ColumnInputs, real_column
from colonnade.store.layout import Layout
from colonnade.units.text import acceleration, number, quantity
from colonnade.workflow.graph import one_specimen, restitution_taken
from colonnade.workflow.product import read_done

if TYPE_CHECKING:
    import xarray as xr

Asked = TypeVar("Asked", bound=Table)

IDENTIFIED, RIGID_BODY = "identified", "rigid-body"
"""Words for e in place of its value."""

OWN = "column"
"""Name of a column that is no specimen, and of a question of one's own."""

SIZES = ("shape", *OUTER_DIMENSIONS)
"""Keys of [specimens.<id>] by which a column is given that is no specimen."""

FLAGS = {"levels": "level", "models": "model"}
"""Options that are not called like their keys, as they are repeated."""

Given = Mapping[str, Any]
"""Options that are given, as in a campaign file; of a column: keys of `Which`, `SIZES` and keys of `Prototype`."""


class Which(Table):
    """Options that say which column is meant, besides its sizes and what is assumed of it."""

    specimen: str | None = None
    """The specimen; needed if there are several and nothing else names it."""
    scale: Scale | None = None
    """How many times larger the column is."""
    shape: Annotated[str, OneOf(tuple(SIZED))] | None = None
    """Shape of a column that is given by its sizes."""


def needs_specimen(given: Given) -> bool:
    """Whether a column is not said by its sizes, or by α and p, alone."""
    return not given.keys() & set(SIZES) and ("specimen" in given or not {"critical_angle", "p"} <= given.keys())


@dataclass(frozen=True)
class FoundColumn:
    """
    A column with all that its properties follow from.

    Attributes
    ----------
    specimen : str or None
        Id; None of a column given by its sizes or by α and p.
    inputs : ColumnInputs
    pooled : xr.Dataset
        The e of the model, as of `stages.specimen`.
    scale : float or None
        How many times larger it is than what the campaign tests; None if that is not said.
    real : RealColumn
    source : str
        Of its e: given, identified or rigid-body.
    """

    specimen: str | None
    inputs: ColumnInputs
    pooled: xr.Dataset
    scale: float | None
    real: RealColumn
    source: str

    def fields(self) -> list[tuple[str, str]]:
        """Write what it is."""
        e, block = " | ".join(dict.fromkeys(number(each, 4) for each in pair(self.real.restitution))), self.real.block
        return [
            ("column", self.name),
            ("critical angle α", quantity(block.critical_angle, "rad", 4)),
            ("p", quantity(block.p, "rad/s", 4)),
            ("uplift from", acceleration(block.uplift_acceleration)),
            ("restitution e", f"{e} ({self.source})"),
        ]

    @property
    def name(self) -> str:
        """Which it is, in words."""
        scale = self.inputs.scale
        return (self.specimen or "as given") + (f", {scale:g} times larger" if scale != 1.0 else "")

    def record(self) -> dict[str, Any]:
        """Give it for programs, SI."""
        of_block = {key: getattr(self.real.block, key) for key in ("critical_angle", "p", "uplift_acceleration")}
        e = pair(self.real.restitution)
        return {"name": self.name, **of_block, "restitution": e, "restitution_source": self.source}


def find_column(
    given: Given, campaign: Campaign | None, layout: Layout | None, *, is_real: bool = False
) -> FoundColumn:
    """
    Find the column that is asked about.

    Parameters
    ----------
    given : Given
        The only specimen of a campaign is meant if neither one, sizes nor α and p are given.
    campaign, layout : optional
        None without a campaign.
    is_real : bool, optional
        A specimen stands for its real column, at the scale of the campaign file if none is given. Else it stands for
        itself, with the e of its predictions, unless a scale, α or p make it another column.

    Raises
    ------
    CampaignError
        If it is not said which, an option is out of its range, or the e of a real column is not said.
    """
    which, name = picked(Which, given), None
    try:
        if campaign is None or layout is None or not needs_specimen(given):
            inputs, pooled = _without_specimen(which, given)
        else:
            name = one_specimen(campaign, which.specimen)
            inputs = _of_specimen(campaign, name, which, given, is_real)
            pooled = restitution_taken(campaign, layout, name)
        real, source = real_column(inputs, pooled)
    except ValueError as error:
        raise CampaignError(f"The column cannot be: {error}.") from None
    has_own_size = which.scale is None and (name is None or "p" in given)
    return FoundColumn(name, inputs, pooled, None if has_own_size else inputs.scale, real, source)


def _of_specimen(campaign: Campaign, name: str, which: Which, given: Given, is_real: bool) -> ColumnInputs:
    known = campaign.specimens[name]
    scale = which.scale or (known.scale if is_real else None) or 1.0
    if is_real or scale != 1.0 or {"critical_angle", "p"} & given.keys():
        prototype = _prototype(campaign.prototype.get(name), given)
    else:
        prototype = _prototype(None, {"restitution": IDENTIFIED} | dict(given))
    usual = campaign.processing.predict.ensemble.restitution
    return ColumnInputs(block=known.block(campaign.gravity), scale=scale, prototype=prototype, usual_scatter=usual)


def _without_specimen(which: Which, given: Given) -> tuple[ColumnInputs, xr.Dataset]:
    from colonnade.stages.specimen import SpecimenInputs, taken

    sizes = {key: given[key] for key in SIZES if key in given}
    is_model = which.specimen is not None or which.scale not in (None, 1.0) or given.get("restitution") == IDENTIFIED
    if is_model or not ("shape" in sizes if sizes else {"critical_angle", "p"} <= given.keys()):
        raise CampaignError(
            'The column is not known. Give --shape prism --width "1 m" --height "5 m", or --critical-angle "0.2 rad" '
            'and --p "2 rad/s", or a CAMPAIGN with --specimen; --name, --scale and --restitution identified are for '
            "the last alone."
        )
    prototype = _prototype(None, {"restitution": RIGID_BODY} | dict(given))
    if sizes:
        # Neither its depth nor its mass changes how it rocks.
        other = {"mass": "1 kg", "depth": "1 m"} if which.shape == "prism" else {"mass": "1 kg"}
        block = checked(SIZED[sizes["shape"]], other | sizes).block(STANDARD_GRAVITY)
    else:
        assert prototype.critical_angle is not None
        assert prototype.p is not None
        block = rectangular(prototype.critical_angle, 2 * pi / prototype.p)
        prototype = prototype.model_copy(update={"critical_angle": None, "p": None})
    pooled = taken(None, SpecimenInputs(block=block, given=None, level=0.95))
    return ColumnInputs(block=block, scale=1.0, prototype=prototype), pooled


def _prototype(written: Prototype | None, given: Given) -> Prototype:
    """Put options over what a campaign says of the real column."""
    given = {key: given[key] for key in Prototype.model_fields if key in given}
    if written is None and "restitution" not in given:
        raise CampaignError(
            'The e of the real column is not given. Add --restitution: a number, "rigid-body", or "identified" to '
            "assume that of the model."
        )
    new = checked(Prototype, {"restitution": RIGID_BODY} | given)
    # Limits of another value are none of this one.
    others = dict.fromkeys(key for key in Prototype.model_fields if key.removesuffix("_range") in given)
    return (written or new).model_copy(update=others | {key: getattr(new, key) for key in given})


def checked(model: type[Asked], written: Given) -> Asked:
    """
    Check options as the keys of a table of the campaign file.

    Raises
    ------
    CampaignError
        If a value cannot be used; the message names the option.
    """
    try:
        return model.model_validate(written)
    except ValidationError as error:
        problems = []
        for each in error.errors():
            key = str(each["loc"][0]) if each["loc"] else ""
            problems.append(f"--{FLAGS.get(key, key).replace('_', '-')}: {each['msg']}" if key else each["msg"])
        raise CampaignError("\n".join(problems)) from None


def picked(model: type[Asked], given: Given) -> Asked:
    """Pick the options that are keys of a table; as `checked`."""
    return checked(model, {key: value for key, value in given.items() if key in model.model_fields})


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
