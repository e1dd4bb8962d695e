"""A virtual campaign before it is shaken: its file, its tests, how they are recorded, the true e of its specimens."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime, time, timedelta
from pathlib import Path

import numpy as np

from colonnade.campaign import FILE_NAME
from colonnade.campaign.channel import MAIN
from colonnade.campaign.syntax.document import toml_key, toml_value
from colonnade.errors import CampaignError
from colonnade.laboratory.files import COMMAS, FileFormat
from colonnade.laboratory.table import Imperfections, TableMotion, still
from colonnade.readers.files import irregular
from colonnade.store.files import own_files

MARK = "# Written by colonnade's virtual laboratory"
"""First words of every campaign file that may be overwritten by another one of the laboratory."""

_HEAD = (
    MARK
    + """: no real specimen was shaken.
# Its truth is in truth/, which no stage of the processing reads. Facility, days and operator are made up.
# Every quantity is text with its unit; paths are relative to this file.
"""
)

FIRST_DAY = np.datetime64("2013-05-14")
FIRST_TEST = time(9)
"""A working day begins with it."""
BETWEEN_TESTS = timedelta(minutes=24)
TESTS_A_DAY = 18
"""The last begins at 15:48."""


@dataclass(frozen=True)
class Recorder:
    """How a recorder samples and writes; `late`, s, is about how long after the main one it starts, with its clock."""

    sampling_rate_hz: float = 500.0
    format: FileFormat = COMMAS
    late: float = 0.0


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
        Id of what is tested; None for the first of the plan.
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


@dataclass(frozen=True)
class Plan:
    """
    A whole campaign.

    Attributes
    ----------
    head : str
        Its campaign file but for the tests: specimens, set-ups, channels with the chains that the laboratory has.
    restitution : mapping of str to float
        True e of each specimen.
    recorders : mapping
        By set-up and recorder, "main" first.
    trials : tuple of Trial
    imperfections : Imperfections
    """

    head: str
    restitution: Mapping[str, float]
    recorders: Mapping[str, Mapping[str, Recorder]]
    trials: tuple[Trial, ...]
    imperfections: Imperfections = field(default_factory=Imperfections)

    def campaign_text(self) -> str:
        """Write out the campaign file."""
        lines = [f"{_HEAD}\n{self.head.strip()}\n\n# The tests, in the order in which they were done."]
        for position, trial in enumerate(self.trials):
            paths = {
                name: f"raw/{trial.name}{'' if name == MAIN else f'-{name}'}{recorder.format.suffix}"
                for name, recorder in self.recorders[trial.setup].items()
            }
            entry = {
                "id": trial.name,
                "kind": trial.kind,
                "specimen": trial.specimen or next(iter(self.restitution)),
                "setup": trial.setup,
                "file": paths[MAIN] if len(paths) == 1 else paths,
                "date": begun(position).date(),
                "operator": "virtual laboratory",
                **trial.entry,
            }
            lines += ["", "[[tests]]", *(f"{toml_key(key)} = {toml_value(value)}" for key, value in entry.items())]
        return "\n".join([*lines, ""])


def begun(position: int) -> datetime:
    """
    Return the date and time at which a test starts, by its number in the plan from 0; tests are run on working days.

    Examples
    --------
    >>> begun(0).isoformat(" "), begun(4 * TESTS_A_DAY).isoformat(" ")
    ('2013-05-14 09:00:00', '2013-05-20 09:00:00')
    """
    days, before = divmod(position, TESTS_A_DAY)
    day = datetime.fromisoformat(str(np.busday_offset(FIRST_DAY, days)))
    return datetime.combine(day, FIRST_TEST) + before * BETWEEN_TESTS


def claim(folder: Path) -> None:
    """Refuse a folder with a campaign file that the laboratory did not write, or with a link in place of a folder."""
    path = folder / FILE_NAME
    if path.exists() and (irregular(path) or not path.read_bytes().startswith(MARK.encode())):
        raise CampaignError(
            f"{path}: this campaign was not written by the virtual laboratory and was not changed. Name another folder "
            "for the demo."
        )
    for place in ("raw", "truth"):
        own_files(folder / place)
