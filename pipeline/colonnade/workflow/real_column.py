"""The column that a command asks about: a specimen, the real column of one, or one given by its sizes or by α and p."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

from pydantic import ValidationError

from colonnade.assessment.real_column import RealColumn
from colonnade.campaign import Campaign
from colonnade.campaign.assessment import Prototype
from colonnade.campaign.specimen import OUTER_DIMENSIONS, SIZED
from colonnade.campaign.syntax.fields import OneOf, Scale
from colonnade.campaign.syntax.table import Table
from colonnade.dynamics.block import STANDARD_GRAVITY, Block, pair
from colonnade.dynamics.spectra import rectangular
from colonnade.errors import CampaignError
from colonnade.stages.assessment_plan import ColumnInputs, real_column
from colonnade.store.layout import Layout
from colonnade.units.text import acceleration, quantity
from colonnade.workflow.pooling import one_specimen, restitution_taken

if TYPE_CHECKING:
    import xarray as xr

Written = TypeVar("Written", bound=Table)

IDENTIFIED, RIGID_BODY = "identified", "rigid-body"
"""Words for e in place of its value."""


SIZES = ("shape", *OUTER_DIMENSIONS)
"""Keys of [specimens.<id>] by which a column is given that is no specimen."""

Given = Mapping[str, Any]
"""Options that are given, as in a campaign file; of a column: `specimen`, `scale`, `SIZES` and keys of `Prototype`."""


def needs_specimen(given: Given) -> bool:
    """Whether a column is not said by its sizes, or by α and p, alone."""
    is_said = bool(given.keys() & set(SIZES)) or {"critical_angle", "p"} <= given.keys()
    return "specimen" in given or not is_said


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
    """

    specimen: str | None
    inputs: ColumnInputs
    pooled: xr.Dataset
    scale: float | None

    @cached_property
    def real(self) -> tuple[RealColumn, str]:
        """
        The column, and where its e comes from: given, identified or rigid-body.

        Raises
        ------
        CampaignError
            If there can be no such column.
        """
        try:
            return real_column(self.inputs, self.pooled)
        except ValueError as error:
            raise CampaignError(f"The column cannot be: {error}.") from None

    @property
    def block(self) -> Block:
        """Of the column."""
        return self.real[0].block

    @property
    def restitution(self) -> tuple[float, float]:
        """e of impacts that end an arc at θ < 0, and at θ > 0."""
        return pair(self.real[0].restitution)

    @property
    def name(self) -> str:
        """What it is, in words."""
        scale = self.inputs.scale
        if self.specimen is None:
            return f"α = {self.block.critical_angle:.4g} rad, p = {self.block.p:.4g} rad/s"
        return self.specimen if scale == 1.0 else f"{self.specimen}, {scale:g} times larger"

    def fields(self) -> list[tuple[str, str]]:
        """Write what it is."""
        negative, positive = self.restitution
        e = f"{negative:.4g}" if negative == positive else f"{negative:.4g} | {positive:.4g}"
        return [
            ("column", self.name),
            ("critical angle α", quantity(self.block.critical_angle, "rad", 4)),
            ("p", quantity(self.block.p, "rad/s", 4)),
            ("uplift from", acceleration(self.block.uplift_acceleration)),
            ("restitution e", f"{e} ({self.real[1]})"),
        ]

    def record(self) -> dict[str, Any]:
        """Give it for programs, SI."""
        return {
            "name": self.name,
            **{key: getattr(self.block, key) for key in ("critical_angle", "p", "uplift_acceleration")},
            "restitution": list(self.restitution),
            "restitution_source": self.real[1],
        }


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

    Returns
    -------
    found : FoundColumn

    Raises
    ------
    CampaignError
        If it is not said which, an option is out of its range, or the e of a real column is not said.
    """
    if "specimen" in given and given.keys() & set(SIZES):
        raise CampaignError(
            "--shape and its sizes are for a column that is not a specimen. Leave --specimen and --name out."
        )
    if campaign is None or layout is None or not needs_specimen(given):
        return _without_specimen(given, has_campaign=campaign is not None)
    name = one_specimen(campaign, given.get("specimen"))
    known = campaign.specimens[name]
    scale = checked(Size, {"scale": given.get("scale")}).scale or (known.scale if is_real else None) or 1.0
    if is_real or scale != 1.0 or {"critical_angle", "p"} & given.keys():
        own = campaign.prototype.get(name)
        written = {} if own is None else own.model_dump(exclude_none=True)
    else:
        written = {"restitution": IDENTIFIED}
    inputs = ColumnInputs(
        block=known.block(campaign.gravity),
        scale=scale,
        prototype=_prototype(written, given),
        usual_scatter=campaign.processing.predict.ensemble.restitution,
    )
    has_own_size = "scale" not in given and "p" in given
    return FoundColumn(name, inputs, restitution_taken(campaign, layout, name), None if has_own_size else scale)


class Size(Table):
    """Options that are not keys of [prototype.<specimen>]."""

    scale: Scale | None = None
    """How many times larger the column is."""
    shape: Annotated[str, OneOf(tuple(SIZED))] | None = None
    """Shape of a column that is given by its sizes."""


def _without_specimen(given: Given, *, has_campaign: bool) -> FoundColumn:
    from colonnade.stages.specimen import SpecimenInputs, taken

    if "specimen" in given:
        raise CampaignError(
            f"--specimen {given['specimen']}: there is no campaign here. Give CAMPAIGN, or --shape with the sizes."
        )
    if given.get("scale", 1.0) != 1.0:
        raise CampaignError("--scale is for a specimen. Sizes, or --critical-angle and --p, are of the real column.")
    if given.get("restitution") == IDENTIFIED:
        where = "name it with --specimen" if has_campaign else "give CAMPAIGN and --specimen"
        raise CampaignError(f"--restitution identified: e is identified of a specimen; {where}.")
    prototype = _prototype({"restitution": RIGID_BODY}, given)
    if sizes := {key: given[key] for key in SIZES if key in given}:
        block = _sized(sizes)
    elif prototype.critical_angle is None or prototype.p is None:
        raise CampaignError(
            'The column is not known. Give --shape prism --width "1 m" --height "5 m", or --critical-angle "0.2 rad" '
            'and --p "2 rad/s", or a CAMPAIGN with --specimen.'
        )
    else:
        try:
            block = rectangular(prototype.critical_angle, 2 * pi / prototype.p)
        except ValueError as error:
            raise CampaignError(f"The column cannot be: {error}.") from None
        prototype = prototype.model_copy(update={"critical_angle": None, "p": None})
    inputs = ColumnInputs(block=block, scale=1.0, prototype=prototype)
    pooled = taken(None, SpecimenInputs(block=block, given=None, level=0.95))
    return FoundColumn(None, inputs, pooled, given.get("scale"))


def _sized(sizes: Mapping[str, Any]) -> Block:
    """Make the block of a shape and its sizes; neither its depth nor its mass changes how it rocks."""
    if "shape" not in sizes:
        raise CampaignError(f"--{next(iter(sizes)).replace('_', '-')}: give its --shape too: {', '.join(SIZED)}.")
    other = {"mass": "1 kg", "depth": "1 m"} if sizes["shape"] == "prism" else {"mass": "1 kg"}
    return checked(SIZED[sizes["shape"]], other | dict(sizes)).block(STANDARD_GRAVITY)


def _prototype(written: dict[str, Any], given: Mapping[str, Any]) -> Prototype:
    """Put options over what a campaign says of the real column."""
    given = {key: given[key] for key in Prototype.model_fields if key in given}
    # Limits of another value are none of this one.
    written = {key: value for key, value in written.items() if key.removesuffix("_range") not in given}
    if "restitution" not in {**written, **given}:
        raise CampaignError(
            'The e of the real column is not given. Add --restitution: a number, "rigid-body", or "identified" to '
            "assume that of the model."
        )
    new = checked(Prototype, {"restitution": written.get("restitution"), **given})
    return new.model_copy(update={key: value for key, value in written.items() if key not in given})


def checked(model: type[Written], written: Mapping[str, Any], names: Mapping[str, str] | None = None) -> Written:
    """
    Check options as the keys of a table of the campaign file.

    Parameters
    ----------
    model : type
    written : mapping
    names : mapping, optional
        Names of options that are not called like their keys.

    Raises
    ------
    CampaignError
        If a value cannot be used; the message names the option.
    """
    try:
        return model.model_validate(written)
    except ValidationError as error:
        named = ((str(each["loc"][0] if each["loc"] else "shape"), each["msg"]) for each in error.errors())
        problems = [f"--{(names or {}).get(key, key).replace('_', '-')}: {said}" for key, said in named]
        raise CampaignError("\n".join(problems)) from None


def given_of(options: Mapping[str, Any]) -> Given:
    """Take from the options of a command those that are given, neither None nor (); lists and numbers as in a file."""
    given = {key: value for key, value in options.items() if value is not None and value != ()}
    return {key: _as_written(key, value) for key, value in given.items()}


def _as_written(key: str, value: Any) -> Any:
    if key == "restitution" and isinstance(value, str):
        try:
            return float(value)
        except ValueError:
            return value  # "identified" or "rigid-body"
    return list(value) if isinstance(value, tuple) else value


def picked(model: type[Written], options: Mapping[str, Any]) -> Written:
    """Pick from the options of a command those that are given and keys of a table; as `checked`."""
    return checked(model, {key: value for key, value in given_of(options).items() if key in model.model_fields})
