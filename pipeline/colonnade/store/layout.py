"""Where everything that colonnade writes for a campaign lies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from colonnade.errors import StoreError

FILE_NAMES = {
    "ingest": "recorded",
    "condition": "conditioned",
    "rocking": "rocking",
    "restitution": "restitution",
    "predict": "predicted",
    "ensemble": "ensemble",
    "compare": "compared",
}
"""Stage -> stem of the file that it writes for a test."""


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

    Examples
    --------
    >>> Layout(Path("prism")).stage("span-2.0", "predict", "linear").as_posix()
    'prism/processed/tests/span-2.0/predicted-linear.nc'
    """

    folder: Path
    results: Path | None = None

    @classmethod
    def of(cls, folder: Path, results: Path | str | None) -> Layout:
        """
        Lay out the results of a campaign in the folder that was asked for.

        Raises
        ------
        StoreError
            If its path is invalid.
        """
        try:
            return cls(folder, None if results is None else Path(results).resolve())
        except (OSError, RuntimeError, ValueError) as error:
            raise StoreError(f"{results}: invalid path of a folder for results ({error}).") from None

    @property
    def home(self) -> Path:
        """Folder that holds `processed` and `report`."""
        return self.folder if self.results is None else self.results

    @property
    def processed(self) -> Path:
        """Folder of all results."""
        return self.home / "processed"

    @property
    def tests(self) -> Path:
        """Folder of the tests' folders."""
        return self.processed / "tests"

    @property
    def specimens(self) -> Path:
        """Folder of the specimens' files."""
        return self.processed / "specimens"

    @property
    def contacts(self) -> Path:
        """Folder of the specimens' laws of contact."""
        return self.processed / "contact"

    @property
    def maps(self) -> Path:
        """Folder of stability maps."""
        return self.processed / "maps"

    def map(self, specimen_id: str, model: str) -> Path:
        """File of a specimen's stability map by one model."""
        return self.maps / f"{specimen_id}-{model}.nc"

    def map_figure(self, specimen_id: str, model: str) -> Path:
        """Picture of a stability map, beside its file."""
        return self.map(specimen_id, model).with_suffix(".svg")

    def maps_figure(self, specimen_id: str, models: Sequence[str]) -> Path:
        """Picture of several models' limits together."""
        return self.maps / f"{specimen_id}-{'+'.join(models)}.svg"

    def response(self, specimen_id: str, model: str) -> Path:
        """File of a specimen's steady responses by one model."""
        return self.maps / f"{specimen_id}-{model}-response.nc"

    def response_figure(self, specimen_id: str, model: str) -> Path:
        """Picture of the steady responses, beside their file."""
        return self.response(specimen_id, model).with_suffix(".svg")

    def map_blocks(self, specimen_id: str, model: str) -> Path:
        """Folder of the finished blocks of a map that is under way."""
        return self.maps / f".{specimen_id}-{model}"

    def response_blocks(self, specimen_id: str, model: str) -> Path:
        """Folder of the finished blocks of steady responses that are under way."""
        return self.maps / f".{specimen_id}-{model}-response"

    @property
    def report(self) -> Path:
        """The report's page."""
        return self.home / "report" / "index.html"

    @property
    def summary_json(self) -> Path:
        """A record a test, for machines."""
        return self.processed / "summary.json"

    @property
    def summary_csv(self) -> Path:
        """A row a test, for spreadsheets."""
        return self.processed / "summary.csv"

    @property
    def raw_index(self) -> Path:
        """Size, time and SHA-256 of the raw files, as last seen."""
        return self.processed / "raw-files.json"

    @property
    def catalogue(self) -> Path:
        """What the results say of themselves, as last seen."""
        return self.processed / "catalogue.json"

    @property
    def report_key(self) -> Path:
        """Hash of what the report shows, and how its pages were written."""
        return self.processed / "report.key"

    @property
    def lock(self) -> Path:
        """Locked while a run writes."""
        return self.processed / ".lock"

    @property
    def lock_holder(self) -> Path:
        """Who holds the lock."""
        return self.processed / ".lock-holder.json"

    def results_there(self) -> list[Path]:
        """Results of tests and specimens that are there, in the order of their paths."""
        folders = (self.tests.glob("*/*.nc"), self.specimens.glob("*.nc"), self.contacts.glob("*.nc"))
        return sorted(path for found in folders for path in found)

    def test(self, test_id: str) -> Path:
        """Folder of a test's results."""
        return self.tests / test_id

    def error_log(self, test_id: str) -> Path:
        """Traceback of an internal error in a test."""
        return self.test(test_id) / "error.log"

    def specimen(self, specimen_id: str) -> Path:
        """File of a specimen's pooled restitution."""
        return self.specimens / f"{specimen_id}.nc"

    def contact(self, specimen_id: str) -> Path:
        """File of the contact law with which a specimen has its restitution."""
        return self.contacts / f"{specimen_id}.nc"

    def specimen_error_log(self, specimen_id: str) -> Path:
        """Traceback of an internal error in pooling a specimen."""
        return self.specimens / f"{specimen_id}.error.log"

    def stage(self, test_id: str, stage: str, model: str | None = None) -> Path:
        """File that a stage writes for a test; `model` where the stage has one file a model."""
        stem = FILE_NAMES[stage]
        return self.test(test_id) / (f"{stem}-{model}.nc" if model else f"{stem}.nc")
