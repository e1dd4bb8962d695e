"""Photos of the tests for the report: decoded with care, written anew without hidden data; a bad one is a finding."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from io import BytesIO
from pathlib import Path

from colonnade.campaign import Campaign
from colonnade.campaign.syntax.names import inside
from colonnade.errors import ReadError
from colonnade.findings import Finding, warning
from colonnade.interruption import expect_none
from colonnade.readers.files import sha256_of
from colonnade.readers.photo import read_photo
from colonnade.report.asked import KIND, Photo, Photos, address_of
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.product import Catalogue, Contents, Product, brought_up_to_date

QUALITY = 85
"""Of the JPEG files that are written."""

MADE_BY = ("colonnade.readers.photo", "colonnade.workflow.photos")
"""What the photos of the report are made by."""


def photos_shown(campaign: Campaign, layout: Layout, catalogue: Catalogue) -> tuple[dict[str, Photos], list[Finding]]:
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
    photos : dict of str to Photos
        Those of each test that has any.
    unshown : list of Finding
        A warning of each photo that cannot be shown.

    Raises
    ------
    StoreError
        If a photo cannot be written.
    """
    folder, code = layout.report.parent, catalogue.code(MADE_BY)
    products = [
        Product(address, "", _upstream(campaign, written, catalogue), code, make, (folder / address,))
        for test, number, written in _photos(campaign)
        for address, make in [(address_of(test, number), partial(_copied, campaign.folder, written))]
    ]
    made = brought_up_to_date(products, catalogue)
    for stale in set(folder.glob("photos/*.jpg")) - {path for each in products for path in each.paths}:
        files.remove(stale)
    found, photos = [], dict[str, Photos]()
    for test, number, written in _photos(campaign):
        before, address = photos.get(test, Photos()), address_of(test, number)
        if reason := made[address].reason:
            files.remove(folder / address)
            found.append(finding_of(test, reason))
            photos[test] = replace(before, problems=(*before.problems, found[-1].text))
        else:
            shown = Photo(address, f"Photo {number} of test {test}", written)
            photos[test] = replace(before, shown=(*before.shown, shown))
    return photos, found


def unshown_photos(campaign: Campaign) -> list[Finding]:
    """Look at the photos of all tests, and give a warning of each that cannot be shown; nothing is written."""
    found = []
    for test, _, written in _photos(campaign):
        expect_none()
        try:
            read_photo(_source(campaign.folder, written), within=campaign.folder)
        except ReadError as error:
            found.append(finding_of(test, str(error)))
    return found


def finding_of(test: str, reason: str) -> Finding:
    """Make a finding of a photo's refusal."""
    return replace(warning(KIND, f"tests[{test}].photos: {reason}"), about=f"tests.{test}")


def _photos(campaign: Campaign) -> Iterator[tuple[str, int, str]]:
    for name, test in campaign.tests.items():
        for number, written in enumerate(test.photos, start=1):
            yield name, number, written


def _source(folder: Path, written: str) -> Path:
    try:
        inside(folder, written)
    except ValueError as error:
        raise ReadError(str(error)) from None
    return folder / written


def _upstream(campaign: Campaign, written: str, catalogue: Catalogue) -> dict[str, str | None]:
    """Hash a photo; one that is not there or lies outside is not opened, and refused when it is read."""
    path = campaign.folder / written
    is_inside = path.resolve().is_relative_to(campaign.folder)
    found = catalogue.entry("raw", path, sha256_of) if is_inside else None
    return {written: found[1] if found else None}


def _copied(folder: Path, written: str) -> Contents:
    """Read a photo, and write its pixels as JPEG with nothing else in it; the same pixels give the same bytes."""
    from PIL import Image

    copy = BytesIO()
    pixels = read_photo(_source(folder, written), within=folder)
    Image.fromarray(pixels).save(copy, "JPEG", quality=QUALITY, optimize=True)
    return [copy.getvalue()], ""
