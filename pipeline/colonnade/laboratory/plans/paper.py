"""The paper's whole programme on the virtual table: three specimens, free vibrations, sines, an earthquake."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.experiment import Plan, Setup, Specimen, Trial
from colonnade.laboratory.files import COMMAS, FileFormat, Matlab, Tdms
from colonnade.laboratory.plans import ladder
from colonnade.laboratory.plans.trials import LENGTH_SCALE, Placed, earthquakes, free_vibrations, sine
from colonnade.laboratory.programme import paper_prism
from colonnade.laboratory.rig import bench, frame, prism_setups, shake_table, table_acceleration, table_displacement

CYLINDER_RESTITUTION = 0.970
"""The paper gives none: that of a cylinder which loses the same share, 0.47, of what a rigid body would lose as the
paper's prism does."""

CONE_RESTITUTION = 0.962
"""The paper gives none: that of a share of 0.57, so that the three specimens cannot be taken for each other."""

ROUND_CATCH = 0.30
"""rad, about 1.4 α of cylinder and cone."""

TABLE_RANGE = 0.100
"""Range of the table's displacement transducer, m: at 1 Hz the table goes 61 mm."""


def paper_programme(name: str, record: Motion, *, seed: int = 0) -> Plan:
    """
    Plan the paper's programme.

    Three free vibrations and an earthquake at three Spans of prism, cylinder and truncated cone; sine tests of the
    prism from 1 to 7 Hz, of the other two at 4 Hz, with an amplitude ladder through both boundaries.

    Parameters
    ----------
    name : str
        Of the earthquake record.
    record : Motion
        At full scale.
    seed : int, optional
        Of the exact releases.
    """
    specimens = {"prism": paper_prism(), "cylinder": paper_cylinder(), "cone": paper_cone()}
    placed = [
        Placed(key, each.block, f"{key}-bench", f"{key}-table", "" if key == "prism" else f"{key}-")
        for key, each in specimens.items()
    ]
    ladders = (ladder.PRISM, ladder.CYLINDER, ladder.CONE)
    generator = np.random.default_rng(seed)
    trials: list[Trial] = []
    for place, steps in zip(placed, ladders, strict=True):
        trials += [*free_vibrations(place, generator), *_sines(place, steps), *earthquakes(place, name, record)]
    return Plan(
        campaign="virtual-columns",
        title="Rocking of three solid steel specimens on a virtual shake table",
        specimens=specimens,
        setups=paper_setups(),
        trials=tuple(trials),
    )


def paper_cylinder() -> Specimen:
    """Build the paper's cylinder."""
    return Specimen(
        {"shape": "cylinder", "diameter": "97 mm", "height": "455 mm", "mass": "26.30 kg", "scale": LENGTH_SCALE},
        Block.cylinder(diameter=0.097, height=0.455, mass=26.30),
        CYLINDER_RESTITUTION,
    )


def paper_cone() -> Specimen:
    """Build the paper's truncated cone."""
    return Specimen(
        {
            "shape": "cone",
            "base_diameter": "97 mm",
            "top_diameter": "75.5 mm",
            "height": "480 mm",
            "mass": "21.94 kg",
            "scale": LENGTH_SCALE,
        },
        Block.cone(base_diameter=0.097, top_diameter=0.0755, height=0.480, mass=21.94),
        CONE_RESTITUTION,
    )


def paper_setups() -> dict[str, Setup]:
    """Set up bench and table of each specimen: the prism's recorders write text, the others' LabVIEW's and MATLAB's."""
    columns = ("lvdt_top", "lvdt_bottom")
    return {
        **{f"prism-{name}": setup for name, setup in prism_setups(TABLE_RANGE).items()},
        **_round("cylinder", (0.0485, 0.0485), ("LVDT 1", "LVDT 2"), ("Tischweg", "ACC"), Tdms(), COMMAS),
        **_round("cone", (0.03865, 0.04760), columns, ("table_disp", "table_acc"), Matlab(), Tdms()),
    }


def _round(
    specimen: str,
    radii: tuple[float, float],
    columns: tuple[str, str],
    table_columns: tuple[str, str],
    main: FileFormat,
    second: FileFormat,
) -> dict[str, Setup]:
    """Set up a round specimen: its wider base asks for a wider range at the bottom."""
    transducers = frame(radii, (0.150, 0.020), columns)
    displacement, acceleration = table_displacement(TABLE_RANGE, table_columns[0]), table_acceleration(table_columns[1])
    return {
        f"{specimen}-bench": bench(transducers, main),
        f"{specimen}-table": shake_table(
            transducers, displacement, acceleration, main=main, second=second, catch=ROUND_CATCH
        ),
    }


def _sines(placed: Placed, steps: ladder.Ladder) -> Iterator[Trial]:
    for frequency, amplitudes in steps.items():
        cycles = ladder.CYCLES.get(frequency, ladder.LASTING)
        for amplitude in amplitudes:
            name = f"sine-{frequency:g}Hz-{amplitude:.3f}".removesuffix("0")
            yield sine(placed, name, frequency, amplitude, cycles=cycles, ramp=ladder.RAMPS.get(frequency, ladder.RAMP))
