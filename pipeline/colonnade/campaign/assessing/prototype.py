"""[prototype.<specimen>]: the real column that a specimen is a model of."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import model_validator

from colonnade.campaign.syntax import fields
from colonnade.campaign.syntax.fields import FREQUENCY_PARAMETER, shown
from colonnade.campaign.syntax.table import Table, problem, refuse

_FREQUENCY_PARAMETER = fields.quantity("angular_velocity", between=FREQUENCY_PARAMETER, example="1.26 rad/s")
_ANGLE = fields.quantity("angle")
_FRICTION = fields.number_between(0.01, 10.0)


def _range(kind: fields.Kind, example: str) -> fields.Kind:
    """Give the kind of the limits between which a value lies."""
    limits = fields.list_of(2, kind, f"the lowest and the highest value, such as {example}").then(_ordered)
    unit = {"unit": kind.schema["unit"]} if "unit" in kind.schema else {}
    return fields.Kind(limits.take, {**limits.schema, **unit})


def _ordered(limits: tuple[float, float], written: object) -> tuple[float, float]:
    if not limits[0] < limits[1]:
        raise ValueError(f"{shown(written)} was found. The second limit has to be the larger one.")
    return limits


class Prototype(Table):
    """The real column of a specimen. What is not given follows from the specimen by its scale."""

    restitution: Annotated[
        Literal["identified", "rigid-body"] | float, fields.or_word(fields.RESTITUTION, "identified", "rigid-body")
    ]
    """Its e: a number, "rigid-body", or "identified" to assume that it is the one that predictions of the model use."""
    restitution_range: Annotated[tuple[float, float], _range(fields.RESTITUTION, "[0.93, 0.97]")] | None = None
    """Limits of e; without them the interval of the identified e in a new test, else 0.02 to either side."""
    critical_angle: Annotated[float, _ANGLE] | None = None
    """Its critical angle, such as "0.18 rad"; that of the specimen if it is not given."""
    critical_angle_range: Annotated[tuple[float, float], _range(_ANGLE, '["0.17 rad", "0.19 rad"]')] | None = None
    """Limits of its critical angle; without them it counts as known."""
    p: Annotated[float, _FREQUENCY_PARAMETER] | None = None
    """Its frequency parameter, such as "1.26 rad/s"; by default that of the specimen over the root of the scale."""
    p_range: Annotated[tuple[float, float], _range(_FREQUENCY_PARAMETER, '["1.2 rad/s", "1.3 rad/s"]')] | None = None
    """Limits of its frequency parameter; without them it counts as known."""
    friction: Annotated[float, _FRICTION] | None = None
    """Coulomb's coefficient between the column and what it stands on; without it sliding is not judged."""
    friction_range: Annotated[tuple[float, float], _range(_FRICTION, "[0.5, 0.7]")] | None = None
    """Limits of the coefficient; without them it counts as known."""

    @model_validator(mode="after")
    def _ranges_hold_values(self) -> Self:
        problems = []
        for name in ("restitution", "critical_angle", "p", "friction"):
            value, limits = getattr(self, name), getattr(self, f"{name}_range")
            if isinstance(value, float) and limits is not None and not limits[0] <= value <= limits[1]:
                message = f"The limits {limits[0]:g} and {limits[1]:g} (SI) do not hold {name} = {value:g}."
                problems.append(problem(message, f"{name}_range", value=limits))
        if self.friction is None and self.friction_range is not None:
            problems.append(problem("It is missing, though its limits are given.", "friction"))
        if problems:
            raise refuse("prototype", problems)
        return self
