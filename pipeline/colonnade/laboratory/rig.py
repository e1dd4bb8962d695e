"""How the virtual laboratory records its specimens: transducers, recorders, file formats, safety frame."""

from __future__ import annotations

from colonnade import units
from colonnade.laboratory.experiment import MAIN, Recorder, Setup
from colonnade.laboratory.files import COMMAS, GERMAN, TABS, FileFormat
from colonnade.laboratory.instruments import Transducer

PRISM_CATCH = 0.28
"""rad, about 1.5 α."""

LATE = 0.020
"""The second recorder starts this much after the main one, about, s."""

TOP, BOTTOM = 0.440, 0.040
"""Heights of the two displacement transducers on the specimen, m."""


def bench(frame: tuple[Transducer, ...], flavour: FileFormat) -> Setup:
    """Set up free vibrations, with one recorder."""
    return Setup(
        {MAIN: Recorder(frame, 500.0, flavour)},
        comment="Free vibrations: the specimen on the table at rest, one recorder.",
    )


def shake_table(
    frame: tuple[Transducer, ...],
    displacement: Transducer,
    acceleration: Transducer,
    *,
    main: FileFormat,
    second: FileFormat,
    catch: float,
) -> Setup:
    """Set up table tests, with two recorders of their own rates and starts."""
    return Setup(
        {
            MAIN: Recorder((*frame, displacement), 500.0, main),
            "daq2": Recorder(
                (acceleration,), 400.0, second, late=LATE, align=(displacement.channel, acceleration.channel)
            ),
        },
        catch=catch,
        comment="Table tests: a second recorder for the accelerometer, at its own rate, started a little later.",
    )


def frame(
    radii: tuple[float, float], ranges: tuple[float, float], columns: tuple[str, str] = ("LVDT 1", "LVDT 2")
) -> tuple[Transducer, ...]:
    """
    Wire two displacement transducers, fixed to the frame on the table, to the specimen's side.

    Parameters
    ----------
    radii : pair of float
        Half width of the specimen at `TOP` and `BOTTOM`, m.
    ranges : pair of float
        Physical value that gives 10 V, m.
    columns : pair of str, optional
        Names in the raw files.
    """
    return tuple(
        Transducer(channel, column, "displacement", "specimen", full_scale, "mm", at=(radius, 0.0, height))
        for channel, column, full_scale, radius, height in zip(
            ("top", "bottom"), columns, ranges, radii, (TOP, BOTTOM), strict=True
        )
    )


def table_displacement(full_scale: float, column: str = "Tischweg") -> Transducer:
    """Wire the actuator's displacement transducer."""
    return Transducer("table_displacement", column, "displacement", "table", full_scale, "mm")


def table_acceleration(column: str = "ACC") -> Transducer:
    """Wire an accelerometer of ±2 g on the table."""
    full_scale = 2.0 * units.factor_to_si("g", "acceleration")
    return Transducer("table_acceleration", column, "acceleration", "table", full_scale, "g")


def prism_setups(table_range: float = 0.050) -> dict[str, Setup]:
    """Set up the prism's tests, recorded as text; `table_range` is that of the table's displacement, m."""
    transducers = frame((0.043, 0.043), (0.150, 0.015))
    return {
        "bench": bench(transducers, TABS),
        "table": shake_table(
            transducers,
            table_displacement(table_range),
            table_acceleration(),
            main=GERMAN,
            second=COMMAS,
            catch=PRISM_CATCH,
        ),
    }
