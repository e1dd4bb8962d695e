"""The campaign: its keys, as the file writes them, and with what is around the file: reviews, findings, raw files."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from pydantic import Field

from colonnade.campaign.assessing.assessment import Assessment
from colonnade.campaign.assessing.prototype import Prototype
from colonnade.campaign.channel import Channel
from colonnade.campaign.review import Review
from colonnade.campaign.settings import NextSettings, Processing
from colonnade.campaign.setup import Setup, ShakeTable
from colonnade.campaign.specimen import AnySpecimen
from colonnade.campaign.syntax.fields import Gravity, Text, schema_version
from colonnade.campaign.syntax.names import Identifier
from colonnade.campaign.syntax.table import Table
from colonnade.campaign.test import ReferenceMotion, Test
from colonnade.campaign.watched import Watched
from colonnade.dynamics.block import STANDARD_GRAVITY, Block
from colonnade.findings import Finding

SCHEMA = 1
"""Version of the contract of campaign.toml."""


class CampaignKeys(Table):
    """The keys of a campaign file but its tests; all numbers in SI."""

    version: Annotated[int, schema_version(SCHEMA, "campaign files")] = Field(alias="schema")
    """Version of the campaign file's form: 1."""
    campaign: Identifier
    """Id of the campaign, such as "prism-2013"."""
    title: Text
    """Title of the report."""
    facility: Text | None = None
    """Laboratory and shake table."""
    gravity: Gravity = STANDARD_GRAVITY
    """Gravity at the laboratory; 9.81 m/s² if it is not given."""
    specimens: dict[Identifier, AnySpecimen] = Field(min_length=1)
    """Specimens, by id."""
    setups: dict[Identifier, Setup] = Field(default={})
    """Set-ups, by id; a campaign without tests, about a real column alone, needs none."""
    motions: dict[Text, ReferenceMotion] = Field(default={})
    """Reference motions, by the names that tests give them: files that recorded table motions are compared with."""
    processing: Processing = Processing()
    """Settings of the processing, each with a default."""
    watch: Watched = Watched()
    """Where raw files appear, and what their names say."""
    table: ShakeTable = ShakeTable()
    """What the shake table can do."""
    next: NextSettings = NextSettings()
    """Settings of the advice on the next test."""
    prototype: dict[Identifier, Prototype] = Field(default={})
    """The real columns, by the specimen that is a model of each."""
    assessments: dict[Identifier, Assessment] = Field(default={})
    """What is asked about the real columns, by name."""


class CampaignFile(CampaignKeys):
    """A campaign file as written; `tests` may also be the path of a test log, which is read before this."""

    tests: tuple[Test, ...] = ()
    """The tests, or the path of the test log (CSV or Excel)."""


class Campaign(CampaignKeys):
    """A campaign, read and found valid: its keys, and what was found with them."""

    tests: dict[str, Test]
    """By id, in the order of the file."""
    path: Path
    """The campaign file, absolute and resolved."""
    folder: Path
    """Its folder."""
    warnings: tuple[Finding, ...] = ()
    """Findings on entries that are not used yet or look odd."""
    reviews: dict[str, Review] = Field(default={})
    """Decisions in review.toml, for the tests that it names."""
    awaited: dict[str, str] = Field(default={})
    """The raw file that each planned test still has to get, by test."""

    @classmethod
    def of(cls, written: CampaignFile, path: Path, warnings: tuple[Finding, ...]) -> Campaign:
        """Make the campaign of a valid file."""
        tests = {test.id: test for test in written.tests}
        missing = {name: missing_file(test, path.parent) for name, test in tests.items() if test.planned}
        awaited = {name: file for name, file in missing.items() if file}
        keys: dict[str, Any] = {name: getattr(written, name) for name in CampaignKeys.model_fields}
        keys |= {"tests": tests, "path": path, "folder": path.parent, "warnings": warnings, "awaited": awaited}
        return cls.model_construct(**keys)

    def but(self, **changed: Any) -> Campaign:
        """Return the campaign with some attributes changed."""
        return self.model_copy(update=changed)

    def with_relative_paths(self) -> Campaign:
        """Return the campaign with paths relative to its folder, so that a copy elsewhere gives the same."""

        def within(path: Path) -> Path:
            return path.relative_to(self.folder)

        tests = {
            name: test.model_copy(update={"files": {recorder: within(path) for recorder, path in test.files.items()}})
            for name, test in self.tests.items()
        }
        motions = {
            name: motion.model_copy(update={"file": within(motion.file)}) for name, motion in self.motions.items()
        }
        assessments = {
            name: each.model_copy(
                update={"records": within(each.records), "hazard": each.hazard and within(each.hazard)}
            )
            for name, each in self.assessments.items()
        }
        return self.but(path=within(self.path), folder=Path(), tests=tests, motions=motions, assessments=assessments)

    def review(self, test: str) -> Review:
        """Decisions of the manual review about a test; empty ones if it has none."""
        return self.reviews.get(test, Review())

    def awaiting(self) -> Campaign:
        """Return the campaign with every test that lacks a raw file planned."""
        missing = {name: missing_file(test, self.folder) for name, test in self.tests.items()}
        return self.but(awaited={name: file for name, file in missing.items() if file})

    def left_out(self, test: str) -> str:
        """Why a test is not run: people excluded it, or it is planned and has no raw file; empty if it is run."""
        awaited = self.awaited.get(test, "")
        return self.review(test).excluded or (awaited and f"expected: {awaited}")

    def block(self, specimen: str) -> Block:
        """Block of a specimen, with the campaign's gravity."""
        return self.specimens[specimen].block(self.gravity)

    @property
    def combinations(self) -> dict[tuple[str, str], list[str]]:
        """Ids of the tests by specimen and setup, in the order in which these first come together."""
        found: dict[tuple[str, str], list[str]] = {}
        for test in self.tests.values():
            found.setdefault((test.specimen, test.setup), []).append(test.id)
        return found

    def channels(self, test: Test) -> dict[str, Channel]:
        """Channels of a test's specimen, table and ground for which it has a raw file, by id."""
        channels = self.setups[test.setup].channels_of(test.specimen)
        return {name: channel for name, channel in channels.items() if channel.recorder in test.files}

    def concerning(self, test: str) -> tuple[Finding, ...]:
        """Warnings about a test's specimen or set-up, or the test itself."""
        tables = (f"specimens.{self.tests[test].specimen}", f"setups.{self.tests[test].setup}", f"tests.{test}")
        return tuple(found for found in self.warnings if found.about in tables)


def missing_file(test: Test, folder: Path) -> str:
    """Give the first raw file of a test that is not there, as a path from the campaign's folder; empty if all are."""
    return next((path.relative_to(folder).as_posix() for path in test.files.values() if not path.exists()), "")
