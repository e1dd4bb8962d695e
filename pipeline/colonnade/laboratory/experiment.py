"""A virtual campaign: what is tested, when, and how it is recorded."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime, time, timedelta

import numpy as np

from colonnade.dynamics.block import Block
from colonnade.laboratory.files import FileFormat, Flavour
from colonnade.laboratory.table import Imperfections, TableMotion, Transducer, still

MAIN = "main"

FIRST_DAY = np.datetime64("2013-05-14")
FIRST_TEST = time(9)
"""A working day begins with it."""
BETWEEN_TESTS = timedelta(minutes=24)
TESTS_A_DAY = 18
"""The last begins at 15:48."""


@dataclass(frozen=True)
class Specimen:
    """
    What is tested.

    Attributes
    ----------
    shape : mapping
        Its keys in the campaign file, such as `{"shape": "prism", "width": "86 mm"}`.
    block : Block
        The same for the simulation.
    restitution : float
        True e.
    """

    shape: Mapping[str, str | float]
    block: Block
    restitution: float


@dataclass(frozen=True)
class Recorder:
    """
    One recorder and the transducers wired to it.

    Attributes
    ----------
    transducers : tuple of Transducer
    sampling_rate_hz : float
    flavour : FileFormat
        How it writes its files.
    late : float
        How long after the main recorder it starts, about, s; its clock begins at its own start.
    align : pair of str, or None
        A channel of the main recorder and one of its own that link the two; None if they start together.
    """

    transducers: tuple[Transducer, ...]
    sampling_rate_hz: float
    flavour: FileFormat = field(default_factory=Flavour)
    late: float = 0.0
    align: tuple[str, str] | None = None


@dataclass(frozen=True)
class Setup:
    """
    Recorders, by id with "main" first, the safety frame's catch angle (rad) or None, and what it is, in a line.
    """

    recorders: Mapping[str, Recorder]
    catch: float | None = None
    comment: str = ""


@dataclass(frozen=True)
class Trial:
    """
    One test.

    Attributes
    ----------
    name : str
        Its id.
    kind, setup : str
    duration : float
        Of the record, s.
    table : TableMotion
    theta0, release : float
        Angle at which the specimen is held until it is released, rad and s.
    spikes : int
        Pulses of one sample spread over the channels of the record.
    entry : mapping
        Further keys of the test in the campaign file, such as `{"span": 2.0}`.
    specimen : str or None
        Id of what is tested; None if the plan has one specimen only.
    steady : pair of float, or None
        When the table shakes at full amplitude, s; None if it never does steadily.
    """

    name: str
    kind: str
    setup: str
    duration: float
    table: TableMotion = field(default_factory=still)
    theta0: float = 0.0
    release: float = 0.0
    spikes: int = 0
    entry: Mapping[str, str | float] = field(default_factory=dict)
    specimen: str | None = None
    steady: tuple[float, float] | None = None


@dataclass(frozen=True)
class Plan:
    """
    A whole campaign.

    Attributes
    ----------
    campaign, title : str
        As in the campaign file.
    specimens : mapping of str to Specimen
        By id.
    setups : mapping of str to Setup
    trials : tuple of Trial
    imperfections : Imperfections
    """

    campaign: str
    title: str
    specimens: Mapping[str, Specimen]
    setups: Mapping[str, Setup]
    trials: tuple[Trial, ...]
    imperfections: Imperfections = field(default_factory=Imperfections)

    def specimen_of(self, trial: Trial) -> str:
        """
        Id of the specimen of a trial.

        Raises
        ------
        ValueError
            If the trial names none and the plan has several.
        """
        if trial.specimen is not None:
            return trial.specimen
        if len(self.specimens) > 1:
            raise ValueError(f"{trial.name}: one of {', '.join(self.specimens)} was expected as its specimen")
        return next(iter(self.specimens))


def raw_path(trial: Trial, name: str, recorder: Recorder) -> str:
    """Path of the raw file that one recorder writes of a trial, from the campaign's folder."""
    return f"raw/{trial.name}{'' if name == MAIN else f'-{name}'}{recorder.flavour.suffix}"


def begun(position: int) -> datetime:
    """
    Return when a test is said to begin, by its place in the plan from 0: on working days, one after the other.

    Examples
    --------
    >>> begun(0).isoformat(" "), begun(4 * TESTS_A_DAY).isoformat(" ")
    ('2013-05-14 09:00:00', '2013-05-20 09:00:00')
    """
    days, before = divmod(position, TESTS_A_DAY)
    day = datetime.fromisoformat(str(np.busday_offset(FIRST_DAY, days)))
    return datetime.combine(day, FIRST_TEST) + before * BETWEEN_TESTS
