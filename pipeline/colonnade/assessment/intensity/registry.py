"""The measures of a ground motion by their ids: a new one is its entry here."""

from __future__ import annotations

from dataclasses import dataclass, replace

from colonnade.assessment.intensity.ground import Ground
from colonnade.assessment.intensity.naming import quantity_of, split_name
from colonnade.dynamics.block import Block
from colonnade.errors import nearest
from colonnade.validation import text

RAW = "the motion as it is"
UNDRIFTING = "the motion as it is, integrated from rest; only of records without drift"


@dataclass(frozen=True)
class Measure:
    """
    A measure of a ground motion.

    Attributes
    ----------
    id : str
        Its name in files and options.
    symbol, name, definition, source : str
    filter : str
        What filtering and baseline it takes the motion to have.
    dimension : str
        A key of `units.DIMENSIONS`.
    unit : str
        SI, as it is written for people.
    power : int
        A motion n times as strong has n**power times the measure; 0 of one that does not grow with it.
    is_integrated : bool
        Whether it needs a record without drift.
    needs_block : bool
    period : float or None
        s, of a spectral acceleration.
    """

    id: str
    symbol: str
    name: str
    definition: str
    source: str
    dimension: str
    unit: str
    power: int
    filter: str = RAW
    is_integrated: bool = False
    needs_block: bool = False
    period: float | None = None

    def value(self, ground: Ground, block: Block | None = None) -> float:
        """Compute it of a motion, SI; a block is needed if `needs_block`."""
        from colonnade.assessment.intensity.quantities import QUANTITIES, spectral_acceleration

        if self.period is not None:
            return spectral_acceleration(ground, self.period)
        return QUANTITIES[self.id](ground, block)


def measure_of(name: str) -> Measure:
    """
    Find a measure by its id; a spectral acceleration is "sa(0.5 s)", with its period.

    Raises
    ------
    ValueError
        If it is not known, or its period is not a positive time.

    Examples
    --------
    >>> measure_of("pgv").unit, measure_of("sa(500 ms)").id
    ('m/s', 'sa(0.5 s)')
    """
    bare, given = split_name(text("measure", name, "the id of a measure of intensity"))
    if bare == SPECTRAL.id:
        if given is None:
            raise ValueError('"sa" has no period; one was expected in brackets, such as "sa(0.5 s)"')
        return _spectral(quantity_of(name, given, "time"))
    if bare not in MEASURES or given is not None:
        raise ValueError(f'Unknown measure of intensity "{name}".{nearest(name, (*MEASURES, "sa(0.5 s)"))}')
    return MEASURES[bare]


def _spectral(period: float) -> Measure:
    return replace(
        SPECTRAL,
        id=f"sa({period:.6g} s)",
        symbol=f"Sa({period:.6g} s)",
        period=period,
    )


SPECTRAL = Measure(
    "sa",
    "Sa(T)",
    "spectral acceleration",
    "pseudo-acceleration ω² max |u| of an oscillator of period T, damped by 5 %",
    "Nigam and Jennings 1969",
    "acceleration",
    "m/s²",
    1,
)
"""What all spectral accelerations have in common; `measure_of` gives one with its period."""

MEASURES: dict[str, Measure] = {
    each.id: each
    for each in (
        Measure(
            "pga",
            "PGA",
            "peak ground acceleration",
            "max |a|",
            "",
            "acceleration",
            "m/s²",
            1,
        ),
        Measure(
            "pgv",
            "PGV",
            "peak ground velocity",
            "max |v|, v = ∫ a dt",
            "",
            "velocity",
            "m/s",
            1,
            UNDRIFTING,
            True,
        ),
        Measure(
            "pgd",
            "PGD",
            "peak ground displacement",
            "max |∫ v dt|",
            "",
            "length",
            "m",
            1,
            UNDRIFTING,
            True,
        ),
        Measure(
            "pgv_pga",
            "PGV/PGA",
            "ratio of the peaks",
            "max |v| over max |a|",
            "Zhu, Tso and Heidebrecht 1988",
            "time",
            "s",
            0,
            UNDRIFTING,
            True,
        ),
        Measure(
            "arias",
            "I_A",
            "Arias intensity",
            "π/(2g) ∫ a² dt",
            "Arias 1970",
            "velocity",
            "m/s",
            2,
        ),
        Measure(
            "cav",
            "CAV",
            "cumulative absolute velocity",
            "∫ |a| dt",
            "EPRI 1988",
            "velocity",
            "m/s",
            1,
        ),
        Measure(
            "d5_95",
            "D₅₋₉₅",
            "significant duration",
            "time in which ∫ a² dt grows from 5 to 95 % of its final value",
            "Trifunac and Brady 1975",
            "time",
            "s",
            0,
        ),
        Measure(
            "housner",
            "SI",
            "Housner's intensity",
            "integral of the pseudo-velocity ω max |u| over periods from 0.1 to 2.5 s, damped by 5 %",
            "Housner 1952; damping of 5 % as is usual today",
            "length",
            "m",
            1,
        ),
        Measure(
            "pulse_period",
            "T_p",
            "pulse period",
            "period of the wavelet with the largest coefficient of the velocity, Daubechies 4; 1.4 times its scale",
            "Baker 2007",
            "time",
            "s",
            0,
            UNDRIFTING,
            True,
        ),
        Measure(
            "pulse_indicator",
            "PI",
            "pulse indicator",
            "1/(1 + exp(−23.3 + 14.6 r + 20.5 E)), r and E the PGV and the energy that are left without the pulse; "
            "pulse-like above 0.85",
            "Baker 2007",
            "dimensionless",
            "",
            0,
            UNDRIFTING,
            True,
        ),
        Measure(
            "pga_ratio",
            "PGA/(g tan α)",
            "peak acceleration over that of uplift",
            "max |a| over g tan α of the block",
            "Housner 1963; Dimitrakopoulos and Paraskeva 2015",
            "dimensionless",
            "",
            1,
            needs_block=True,
        ),
        Measure(
            "pgv_ratio",
            "p PGV/(g tan α)",
            "peak velocity over that of the block",
            "p max |v| over g tan α of the block",
            "Dimitrakopoulos and Paraskeva 2015",
            "dimensionless",
            "",
            1,
            UNDRIFTING,
            True,
            True,
        ),
    )
}
"""All measures by id, in the order of tables."""
