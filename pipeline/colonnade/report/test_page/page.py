"""The page of one test, put together from its sections; each section has a module of its own in `test_page`."""

from __future__ import annotations

from dataclasses import dataclass

from colonnade.campaign import Campaign
from colonnade.figures.files.output import Picture
from colonnade.report import drawings, who_and_when
from colonnade.report.drawings import Drawing
from colonnade.report.photos import Photos
from colonnade.report.pictures.registry import picture
from colonnade.report.pictures.subjects import OfTest
from colonnade.report.rows import TestRow
from colonnade.report.test_page import base, bodies, channels, decay, done, found, spread
from colonnade.report.test_page.base import Table
from colonnade.report.test_page.bodies import Bodies
from colonnade.report.test_page.channels import ChannelRow
from colonnade.report.test_page.decay import Decay
from colonnade.report.test_page.done import Done
from colonnade.report.test_page.found import Found
from colonnade.report.test_page.spread import ModelSpread
from colonnade.store.records.stored import Stored


@dataclass(frozen=True)
class TestPage:
    """What the page of a test shows: its row, what is stored, and a field for each section."""

    __test__ = False  # pytest takes a class of this name for a test

    row: TestRow
    stored: Stored
    review: list[str]
    photos: Photos
    done: Done
    drawing: Drawing
    found: Found
    bodies: Bodies
    closer: Picture | None
    base: Table
    spread: ModelSpread
    decay: Decay
    channels: tuple[ChannelRow, ...]
    recording: Picture | None


def of_test(campaign: Campaign, row: TestRow, stored: Stored, shown: Photos) -> TestPage:
    """Put all that is stored of a test into words and figures."""
    test, block = row.test, campaign.block(row.test.specimen)
    subject = OfTest(campaign, row, stored)
    return TestPage(
        row=row,
        stored=stored,
        review=stored.texts("ingest", "review") or list(campaign.review(test.id).sentences),
        photos=shown,
        done=done.of_test(row, stored, who_and_when.of_test(campaign, test)),
        drawing=drawings.of_setup(campaign, test.specimen, test.setup),
        found=found.of_test(subject),
        bodies=bodies.of_test(subject),
        closer=picture("closer", subject),
        base=base.of_test(campaign, row, stored, block),
        spread=spread.of_test(subject),
        decay=decay.of_test(subject),
        channels=channels.of_test(stored),
        recording=picture("channels", subject),
    )
