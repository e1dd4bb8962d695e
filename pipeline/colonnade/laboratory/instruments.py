"""Transducers of the virtual laboratory and the errors of their measuring chains."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from colonnade import units
from colonnade.arrays import Array, Vector
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import point_displacement
from colonnade.laboratory.table import TableMotion

VOLTS = 10.0
"""Every chain puts out ±10 V."""
BITS = 16
STEP = 2 * VOLTS / 2**BITS
"""Smallest step of the converter, V."""


@dataclass(frozen=True)
class Transducer:
    """
    A measuring chain, from the physical quantity to a column of a raw file.

    Attributes
    ----------
    channel, column : str
        Its id in the campaign, and the name of its column.
    quantity, on : str
    full_scale : float
        Physical value, less `offset`, that gives 10 V; m or m/s².
    physical_unit : str
        In which the campaign gives gain and offset, such as "mm".
    recorded_unit : str
        "V", or a unit in which the recorder has written the physical value already.
    offset : float
        Physical value of 0 V, known from calibration and given in the campaign; m or m/s².
    at : tuple of float or None
        Material point on the specimen, m.
    direction : tuple of float
        Unit vector of a positive reading.
    relative_to : {"table", "ground"}
        What a displacement transducer on the specimen is fixed to.
    """

    channel: str
    column: str
    quantity: Literal["displacement", "acceleration"]
    on: Literal["specimen", "table"]
    full_scale: float
    physical_unit: str
    recorded_unit: str = "V"
    offset: float = 0.0
    at: Vector | None = None
    direction: Vector = (1.0, 0.0, 0.0)
    relative_to: Literal["table", "ground"] = "table"

    @property
    def dimension(self) -> str:
        """Dimension of the quantity, as `units` calls it."""
        return "length" if self.quantity == "displacement" else "acceleration"

    def sense(self, block: Block, table: TableMotion, time: Array, angle: Array) -> Array:
        """Physical value along `direction` without any error, m or m/s², at times (s) with their angles."""
        if self.on == "table":
            motion = table.displacement(time) if self.quantity == "displacement" else table.acceleration(time)
            return motion * self.direction[0]
        if self.quantity != "displacement" or self.at is None:
            raise ValueError(
                f"{self.channel}: on the specimen, the virtual laboratory has only displacement transducers with a "
                f"point `at`; {self.quantity} at {self.at} was asked for"
            )
        moved = point_displacement(angle, self.at, block)[0] @ np.array(self.direction)
        return np.asarray(
            moved + (table.displacement(time) * self.direction[0] if self.relative_to == "ground" else 0.0)
        )

    def written(self, volts: Array) -> Array:
        """Values as the recorder writes them, of shape (n,), from volts."""
        if self.recorded_unit == "V":
            return volts
        physical = volts * self.full_scale / VOLTS + self.offset
        return physical / units.factor_to_si(self.recorded_unit, self.dimension)


@dataclass(frozen=True)
class Imperfections:
    """
    Errors of a measuring chain, as fractions of its range.

    Attributes
    ----------
    noise : float
        Standard deviation of white noise.
    drift : float
        Change of the zero over a record, even in time; its sign is drawn.
    zero : float
        The zero offset is drawn between ± this.
    """

    noise: float = 0.0005
    drift: float = 0.001
    zero: float = 0.02


def measure(
    value: Array,
    transducer: Transducer,
    imperfections: Imperfections,
    generator: np.random.Generator,
    spikes: tuple[int, ...] = (),
) -> tuple[Array, dict[str, Any]]:
    """
    Turn a physical value into volts as the recorder's converter sees them.

    At `spikes`, samples, a pulse of 2 to 5 V comes on top, towards the middle of the range. The errors are those of
    truth.json: `zero_volts`, `drift_volts` over the record, and `spikes`.
    """
    zero = VOLTS * imperfections.zero * generator.uniform(-1.0, 1.0)
    drift = VOLTS * imperfections.drift * generator.choice([-1.0, 1.0])
    volts = (value - transducer.offset) / transducer.full_scale * VOLTS
    volts = volts + zero + drift * np.linspace(0.0, 1.0, value.size)
    volts += VOLTS * imperfections.noise * generator.standard_normal(value.size)
    for sample in spikes:
        volts[sample] -= np.copysign(generator.uniform(2.0, 5.0), volts[sample])
    codes = np.clip(np.rint(volts / STEP), -(2 ** (BITS - 1)), 2 ** (BITS - 1) - 1)
    return codes * STEP, {"zero_volts": float(zero), "drift_volts": float(drift), "spikes": list(spikes)}
