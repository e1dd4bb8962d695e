"""
Where a result comes from, and whether its values changed.

A result keeps that as CF and ACDD attributes and the hash of its values. A page, script, picture or PDF has a stamp: a
comment behind its end with the key of what it was made from, and a hash of the rest.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

import colonnade
from colonnade.signals.samples import side_by_side
from colonnade.store.results import STAGES, ResultId

if TYPE_CHECKING:
    import xarray as xr

    from colonnade.campaign import Campaign

_STAMP = re.compile(rb"(?:<!--|//|%) made from ([0-9a-f]+), content ([0-9a-f]+)(?: -->)?\n\Z")

_COMMENTS = {".html": "<!-- {} -->\n", ".svg": "<!-- {} -->\n", ".js": "// {}\n", ".jpg": "% {}\n", ".pdf": "% {}\n"}
"""How a comment is written behind the end of a file, by its suffix."""


def stamped(data: bytes, key: str, suffix: str) -> bytes:
    """Add to what a file of this suffix holds what it was made from."""
    return data + _COMMENTS[suffix].format(f"made from {key}, content {hashlib.sha256(data).hexdigest()}").encode()


def key_of(path: Path) -> str:
    """Return the key of what a file was made from; empty if it is missing, not stamped, or was altered."""
    try:
        data = path.read_bytes()
    except OSError:
        return ""
    found = _STAMP.search(data[-200:])
    if found is None or found[2].decode() != hashlib.sha256(data[: -len(found[0])]).hexdigest():
        return ""
    return found[1].decode()


CONVENTIONS = "CF-1.11, ACDD-1.3"
LONG = 500_000
"""Numbers of a long array; zlib would take ten times as long for a noisy record as reading it."""

KEYWORDS = "rocking, free-standing column, shake table, coefficient of restitution"

# What may differ between two results that are otherwise the same: it is not part of their content.
_CIRCUMSTANCES = frozenset(
    {
        *("Conventions", "title", "summary", "keywords", "id", "institution", "project", "processing_level", "source"),
        *("history", "date_created", "standard_name_vocabulary", "colonnade_version", "stage", "test", "specimen"),
        *("time_coverage_duration", "time_coverage_resolution", "status", "key", "ingredients", "settings", "content"),
        *("raw_files", "raw_sha256", "notes", "review", "recorded_at"),
    }
)


class Origin(NamedTuple):
    """What a file says of the campaign that it is of: id, title and, where it is known, the laboratory."""

    campaign: str
    title: str
    facility: str | None

    @classmethod
    def of(cls, campaign: Campaign) -> Origin:
        """Return what files say of a campaign."""
        return cls(campaign.campaign, campaign.title, campaign.facility)


def global_attributes(origin: Origin, result: ResultId, *, now: datetime | None = None) -> dict[str, str]:
    """
    Describe a file as CF and ACDD ask.

    Parameters
    ----------
    origin : Origin
    result : ResultId
        What the file holds.
    now : datetime, optional
        Instant of making; the present one by default.

    Returns
    -------
    attributes : dict of str
        Global attributes; those that are not known are left out.
    """
    instant = (now or datetime.now(UTC)).astimezone(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    subject, stage = result.subject, result.stage
    attributes = {
        "Conventions": CONVENTIONS,
        "title": f"{origin.title}: {subject}, {stage}",
        "summary": STAGES[stage].summary,
        "keywords": KEYWORDS,
        "id": "/".join((origin.campaign, subject, stage)),
        "institution": origin.facility,
        "project": origin.campaign,
        "processing_level": stage,
        "source": STAGES[stage].source,
        "history": f"{instant} colonnade {colonnade.__version__} {stage}",
        "date_created": instant,
        "colonnade_version": colonnade.__version__,
        "stage": stage,
        result.of: subject,
    }
    return {name: value for name, value in attributes.items() if value}


def coverage(dataset: xr.Dataset) -> dict[str, str]:
    """Give the span of a record's main clock as ACDD asks; empty without a clock."""
    if "elapsed" not in dataset or dataset["elapsed"].size < 2:
        return {}
    elapsed = dataset["elapsed"].to_numpy()
    duration, step = float(np.nanmax(elapsed) - np.nanmin(elapsed)), float(np.nanmedian(np.diff(elapsed)))
    return {"time_coverage_duration": f"PT{duration:.6g}S", "time_coverage_resolution": f"PT{step:.6g}S"}


def content_hash(dataset: xr.Dataset) -> str:
    """
    Hash what a result says: its values, and the attributes that a later stage may read.

    Parameters
    ----------
    dataset : xr.Dataset
        Described by `store.description.describe`.

    Returns
    -------
    content : str
        SHA-256. Dates, versions, titles and keys are not in it. Long arrays go into it by their own SHA-256,
        so that several are hashed at the same time.
    """
    long = {name: variable.values for name, variable in dataset.variables.items() if is_long(variable)}
    digests = side_by_side(lambda values: hashlib.sha256(_little_endian(values).data).digest(), long.values())
    hashed = dict(zip(long, digests, strict=True))
    digest = hashlib.sha256()
    attributes = {name: plain(value) for name, value in dataset.attrs.items() if name not in _CIRCUMSTANCES}
    digest.update(_canonical(attributes))
    for name in sorted(map(str, dataset.variables)):
        variable = dataset.variables[name]
        values = np.asarray(variable.values)
        data: bytes | memoryview
        if values.dtype.kind in "OUST":
            kind, data = "text", _canonical(values.tolist())
        else:
            kind, data = _little_endian(values).dtype.str, hashed.get(name) or _little_endian(values).data
        attributes = {key: plain(value) for key, value in variable.attrs.items()}
        digest.update(_canonical([name, list(map(str, variable.dims)), list(values.shape), kind, attributes]))
        digest.update(data)
    return digest.hexdigest()


def _little_endian(values: NDArray[Any]) -> NDArray[Any]:
    return np.ascontiguousarray(values, dtype=values.dtype.newbyteorder("<"))


def is_long(variable: xr.Variable) -> bool:
    """Whether a variable is a long array of numbers: it has its own hash, and is stored uncompressed."""
    return variable.size > LONG and variable.dtype.kind in "fiu"


def hash_of(value: Any) -> str:
    """SHA-256 of a value that JSON can hold, whatever the order of its keys."""
    return hashlib.sha256(_canonical(value)).hexdigest()


def plain(value: Any) -> Any:
    """Turn an attribute into what JSON can hold, the same before it is written and after it is read."""
    if isinstance(value, (np.ndarray, list, tuple)):
        items = [plain(item) for item in np.asarray(value).tolist()]
        return items[0] if len(items) == 1 else items
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    return value


def _canonical(value: Any) -> bytes:
    return json.dumps(value, sort_keys=True, ensure_ascii=False, separators=(",", ":")).encode()


class Inputs(BaseModel):
    """
    What a stage reads of the campaign: parts of specimen, set-up and test, and the models of its settings.

    It is stored with the result as JSON and enters the result's key, so that it holds nothing else. A field holds of a
    larger model only what its own type declares: `settings: QualitySettings` keeps four keys of `campaign.processing`.
    """

    model_config = ConfigDict(frozen=True)
