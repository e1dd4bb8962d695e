"""Forecast files: written once and never again, found altered by their hash."""

from __future__ import annotations

import json
import os
import re
import stat
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from pydantic import ValidationError

from colonnade.campaign.forms.forecast import ForecastFile
from colonnade.errors import StoreError
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of

LARGEST = 100_000_000
"""Bytes of a forecast file: more than that of the largest ensembles."""

HASH = "sha256"
"""Key of the hash of all others."""

_LONGEST = 40
"""Characters of a part of a name."""

_ODD = re.compile(r"[^A-Za-z0-9.]+")


class Known(NamedTuple):
    """
    A forecast as it was made.

    Attributes
    ----------
    name : str
        Of its file.
    sha256 : str
        Of its content.
    forecast : ForecastFile
    """

    name: str
    sha256: str
    forecast: ForecastFile


class Refused(NamedTuple):
    """A file that cannot be taken as a forecast, and why: a sentence."""

    name: str
    reason: str


class Forecasts(NamedTuple):
    """All forecasts of a campaign in the order in which they were made, and the files that cannot be taken."""

    known: tuple[Known, ...] = ()
    refused: tuple[Refused, ...] = ()


def write_forecast(layout: Layout, forecast: ForecastFile) -> Path:
    """
    Write a forecast under a name that no other has.

    Returns
    -------
    path : Path

    Raises
    ------
    StoreError
        If the folder is a link, or the file cannot be written.
    """
    folder = layout.forecasts
    if folder.is_symlink():
        raise StoreError(f"{folder}: this is a link. Forecasts are not written through links. Remove it.")
    content = forecast.model_dump(mode="json", by_alias=True)
    text = json.dumps(content | {HASH: hash_of(content)}, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    parts = (forecast.specimen, forecast.motion.name, forecast.level)
    stem = "-".join([f"{forecast.made:%Y%m%dT%H%M%SZ}", *(_ODD.sub("_", part)[:_LONGEST] for part in parts)])
    path = _reserved(folder, stem)
    try:
        files.write_bytes(path, text.encode())
    except BaseException:
        path.unlink(missing_ok=True)
        raise
    return path


def read_forecasts(layout: Layout) -> Forecasts:
    """Read all forecasts; nothing in their folder stops another."""
    folder = layout.forecasts
    if folder.is_symlink():
        return Forecasts(refused=(Refused(f"{folder.name}/", "it is a link; forecasts are not read through links."),))
    try:
        names = sorted(entry.name for entry in os.scandir(folder) if entry.name.endswith(".json"))
    except (FileNotFoundError, NotADirectoryError):
        return Forecasts()
    except OSError as error:
        return Forecasts(refused=(Refused(f"{folder.name}/", f"it cannot be read ({error.strerror})."),))
    found = [_read(folder / name) for name in names if not name.startswith(".")]
    known = sorted((each for each in found if isinstance(each, Known)), key=lambda each: each.forecast.made)
    return Forecasts(tuple(known), tuple(each for each in found if isinstance(each, Refused)))


def _reserved(folder: Path, stem: str) -> Path:
    """Make an empty file under a new name: no other process can take it."""
    number = 1
    while True:
        path = folder / (f"{stem}.json" if number == 1 else f"{stem}-{number}.json")
        try:
            folder.mkdir(parents=True, exist_ok=True)
            path.open("x").close()
        except FileExistsError:
            if not folder.is_dir():
                raise StoreError(f"{folder}: a folder for forecasts was expected. Remove this file.") from None
            number += 1
        except OSError as error:
            raise StoreError(f"{path}: it cannot be written ({error.strerror}). Make its folder writable.") from error
        else:
            return path


def _read(path: Path) -> Known | Refused:
    try:
        status = path.lstat()
        if not stat.S_ISREG(status.st_mode):
            return Refused(path.name, "it is a link or no file; forecasts are not read through links.")
        if status.st_size > LARGEST:
            return Refused(path.name, f"it has {status.st_size / 1e6:.0f} MB; no forecast is as large.")
        content = dict(json.loads(path.read_text(encoding="utf-8")))
        digest = content.pop(HASH, None)
        if digest != hash_of(content):
            return Refused(path.name, "it was altered after it was made: its hash is another.")
        return Known(path.name, str(digest), ForecastFile.model_validate(content))
    except OSError as error:
        return Refused(path.name, f"it cannot be read ({error.strerror}).")
    except ValidationError as error:
        first: Mapping[str, Any] = error.errors(include_url=False, include_input=False)[0]
        place = ".".join(map(str, first["loc"]))[:200]
        said = f"{place}: {first['msg']}" if place else str(first["msg"])
        why = f"it is no forecast of schema 1 ({said}). Another version of colonnade may have made it."
        return Refused(path.name, why)
    except (ValueError, TypeError, RecursionError):  # not JSON, no object, or text that has no UTF-8
        return Refused(path.name, "it is damaged: it is not the JSON that was written.")
