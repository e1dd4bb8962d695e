"""The paths of everything that colonnade writes for a campaign."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path

from colonnade.campaign.loading import FILE_NAME
from colonnade.errors import StoreError
from colonnade.store.files import own_files
from colonnade.store.results import STAGES, ResultId

STATE = "state.js"
"""Name of the state script in the report's folder."""


def _in(folder: str, name: str) -> cached_property[Path]:
    """Make a path in a folder of the layout, put together when it is first asked for."""
    return cached_property(lambda layout: getattr(layout, folder) / name)


@dataclass(frozen=True)
class Layout:
    """
    Paths of a campaign's results; nothing is created.

    Attributes
    ----------
    folder : Path
        The folder of campaign.toml.
    results : Path or None
        The folder that holds `processed` and `report`, such as one on another disk; None: the folder of campaign.toml.
    file : str
        Name of the campaign's file in its folder.

    Examples
    --------
    >>> Layout(Path("prism")).stage("span-2.0", "predict", "linear").as_posix()
    'prism/processed/tests/span-2.0/predicted-linear.nc'
    """

    folder: Path
    results: Path | None = None
    file: str = FILE_NAME

    @classmethod
    def of(cls, campaign: Path, results: Path | str | None) -> Layout:
        """
        Return the layout of the results of the campaign of a file, in the given folder.

        Raises
        ------
        StoreError
            If its path is invalid.
        """
        try:
            return cls(campaign.parent, None if results is None else Path(results).resolve(), campaign.name)
        except (OSError, RuntimeError, ValueError) as error:
            raise StoreError(f"{results}: invalid path of a folder for results ({error}).") from None

    @property
    def home(self) -> Path:
        """Folder that holds `processed` and `report`."""
        return self.folder if self.results is None else self.results

    processed = _in("home", "processed")
    """Folder of all results."""
    tests = _in("processed", "tests")
    """Folder of the tests' folders."""
    summary_json = _in("processed", "summary.json")
    """A record a test, for machines."""
    summary_csv = _in("processed", "summary.csv")
    """A row a test, for spreadsheets."""
    catalogue = _in("processed", "catalogue.json")
    """What raw files, results and pages say of themselves, as last seen."""
    lock = _in("processed", ".lock")
    """Locked while a run writes."""
    lock_holder = _in("processed", ".lock-holder")
    """Who holds the lock."""
    owner = _in("processed", ".campaign")
    """The campaign file whose results these are: its name if they are in its own folder, else its path."""
    watch_log = _in("processed", "watch.log")
    """What `watch` said and did."""
    report = _in("home", "report/index.html")
    """The report's page."""
    pdf = _in("home", "report/report.pdf")
    """The report on paper."""
    state = _in("home", f"report/{STATE}")
    """The script by which an open page of the report learns that something changed."""
    forecasts = _in("home", "forecasts")
    """Folder of the forecasts, which are no results: nothing removes or replaces them."""

    def test(self, test_id: str) -> Path:
        """Folder of a test's results."""
        return self.tests / test_id

    def path(self, result: ResultId) -> Path:
        """File of a result."""
        return _path(self.processed, result)

    def stage(self, subject: str, stage: str, model: str | None = None) -> Path:
        """File of the result of a stage for a test or a specimen; `model` if the stage has one file for each model."""
        return self.path(ResultId(subject, stage, model))

    def figure(self, result: ResultId) -> Path:
        """Picture of a map or of steady responses, next to its file."""
        return self.path(result).with_suffix(".svg")

    def blocks(self, result: ResultId) -> Path:
        """Folder of the finished blocks of an unfinished result."""
        path = self.path(result)
        return path.with_name(f".{path.stem}")

    def results_there(self) -> list[Path]:
        """Results that are there, in the order of their paths; StoreError as of `own_files`."""
        made = "|".join(stage.file.format(subject="[^/]+", model="[^/]+") for stage in STAGES.values())
        is_result = re.compile(rf"{re.escape(self.processed.as_posix())}/(?:{made})\.nc").fullmatch
        return [path for path in sorted(own_files(self.processed)) if is_result(path.as_posix())]


@lru_cache(1 << 16)  # a run asks for each ten times, and a path that is known has its text too
def _path(processed: Path, result: ResultId) -> Path:
    return processed / result.file
