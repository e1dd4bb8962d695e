"""The column that a command asks about: a specimen, the real column of one, or one given by its sizes or by α and p."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
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
from colonnade.units.text import acceleration, number, quantity
from colonnade.workflow.graph import one_specimen, restitution_taken

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

    @property
    def restitution(self) -> tuple[float, float]:
        """e of impacts that end an arc at θ < 0, and at θ > 0."""
        return pair(self.real.restitution)

    def fields(self) -> list[tuple[str, str]]:
        """Write what it is."""
        e, block = " | ".join(dict.fromkeys(number(each, 4) for each in self.restitution)), self.real.block
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
        return {"name": self.name, **of_block, "restitution": self.restitution, "restitution_source": self.source}


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

    if which.specimen is not None or which.scale not in (None, 1.0) or given.get("restitution") == IDENTIFIED:
        raise CampaignError(
            "--specimen, --name, --scale and --restitution identified are for a specimen of a CAMPAIGN. Sizes, or "
            "--critical-angle and --p, are of a column that is none: leave those options out."
        )
    prototype = _prototype(None, {"restitution": RIGID_BODY} | dict(given))
    if "shape" in given:
        block = _sized({key: given[key] for key in SIZES if key in given})
    elif given.keys() & set(SIZES) or prototype.critical_angle is None or prototype.p is None:
        raise CampaignError(
            'The column is not known. Give --shape prism --width "1 m" --height "5 m", or --critical-angle "0.2 rad" '
            'and --p "2 rad/s", or a CAMPAIGN with --specimen.'
        )
    else:
        block = rectangular(prototype.critical_angle, 2 * pi / prototype.p)
        prototype = prototype.model_copy(update={"critical_angle": None, "p": None})
    pooled = taken(None, SpecimenInputs(block=block, given=None, level=0.95))
    return ColumnInputs(block=block, scale=1.0, prototype=prototype), pooled


def _sized(sizes: dict[str, Any]) -> Block:
    """Make the block of a shape and its sizes; neither its depth nor its mass changes how it rocks."""
    other = {"mass": "1 kg", "depth": "1 m"} if sizes["shape"] == "prism" else {"mass": "1 kg"}
    return checked(SIZED[sizes["shape"]], other | sizes).block(STANDARD_GRAVITY)


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
