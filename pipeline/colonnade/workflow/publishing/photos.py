"""Photos of the tests for the report: decoded with care, written anew without hidden data; a bad one is a finding."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import replace
from io import BytesIO
from pathlib import Path

from colonnade.campaign import Campaign
from colonnade.campaign.syntax.names import inside
from colonnade.errors import ReadError
from colonnade.findings import Finding, warning
from colonnade.interruption import expect_none
from colonnade.readers.files import sha256_of
from colonnade.readers.photo import Pixels, read_photo
from colonnade.report.photos import KIND, address_of
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.catalogue import Catalogue

QUALITY = 85
"""Of the JPEG files that are written."""

MADE_BY = ("colonnade.readers.photo", "colonnade.workflow.publishing.photos")
"""What the photos of the report are made by."""


def with_photos(campaign: Campaign, layout: Layout, catalogue: Catalogue) -> Campaign:
    """
    Write the photos of all tests into the report, where they are not there already, and remove others.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    catalogue : Catalogue
        Spares decoding photos that are as they were.

    Returns
    -------
    campaign : Campaign
        With a warning of each photo that cannot be shown.

    Raises
    ------
    StoreError
        If a photo cannot be written.
    """
    folder, code = layout.report.parent, catalogue.code(MADE_BY)
    found: list[Finding] = []
    there: set[Path] = set()
    for test, written, address in _photos(campaign):
        expect_none()
        try:
            source = _source(campaign, written)
            _bring_up_to_date(source, folder / address, campaign.folder, catalogue, code)
            there.add(folder / address)
        except ReadError as error:
            found.append(finding_of(test, error))
    for stale in set(folder.glob("photos/*.jpg")) - there:
        files.remove(stale)
    return campaign.but(warnings=(*campaign.warnings, *found))


def unshown_photos(campaign: Campaign) -> list[Finding]:
    """Look at the photos of all tests, and give a warning of each that cannot be shown; nothing is written."""
    found = []
    for test, written, _ in _photos(campaign):
        expect_none()
        try:
            read_photo(_source(campaign, written), within=campaign.folder)
        except ReadError as error:
            found.append(finding_of(test, error))
    return found


def finding_of(test: str, error: ReadError) -> Finding:
    """Make a finding of a photo's refusal."""
    return replace(warning(KIND, f"tests[{test}].photos: {error}"), about=f"tests.{test}")


def _photos(campaign: Campaign) -> Iterator[tuple[str, str, str]]:
    for name, test in campaign.tests.items():
        for number, written in enumerate(test.photos, start=1):
            yield name, written, address_of(name, number)


def _source(campaign: Campaign, written: str) -> Path:
    try:
        inside(campaign.folder, written)
    except ValueError as error:
        raise ReadError(str(error)) from None
    return campaign.folder / written


def _bring_up_to_date(source: Path, target: Path, within: Path, catalogue: Catalogue, code: str) -> None:
    """Write a photo unless it is there, made from this file by this code; ReadError where it cannot be shown."""
    known = catalogue.lookup("photos", target, sha256_of)
    made: list[bytes] = []

    def ask(path: Path) -> dict[str, str]:
        try:
            made.append(as_jpeg(read_photo(path, within=within)))
        except ReadError as error:
            if isinstance(error.__cause__, OSError):  # the machine's fault: the photo is tried again
                raise
            return {"refusal": str(error)}
        return {"sha256": hashlib.sha256(made[0]).hexdigest()}

    answer = catalogue.lookup("photos", source, ask, code)
    if answer is None:  # there is no such file: say so
        read_photo(source, within=within)
        return
    if "refusal" in answer[1]:
        raise ReadError(answer[1]["refusal"])
    if known is None or known[1] != answer[1]["sha256"]:
        files.write_bytes(target, made[0] if made else as_jpeg(read_photo(source, within=within)))
        catalogue.lookup("photos", target, sha256_of)


def as_jpeg(pixels: Pixels) -> bytes:
    """Write pixels as JPEG, with nothing else in it; the same pixels give the same bytes."""
    from PIL import Image

    written = BytesIO()
    Image.fromarray(pixels).save(written, "JPEG", quality=QUALITY, optimize=True)
    return written.getvalue()
