"""The campaign: its keys, as the file writes them, and with what is around the file: reviews, findings, raw files."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, GetPydanticSchema

from colonnade.campaign.assembly import AssemblyTable, Whole
from colonnade.campaign.assessment import Assessment, Prototype
from colonnade.campaign.channel import Channel
from colonnade.campaign.review import Review
from colonnade.campaign.settings import OVERNIGHT, EnsembleSettings, NextSettings, Processing
from colonnade.campaign.setup import Setup, ShakeTable
from colonnade.campaign.specimen import AnySpecimen, Specimen
from colonnade.campaign.syntax.fields import Quantity, Text
from colonnade.campaign.syntax.names import Identifier
from colonnade.campaign.syntax.table import Table
from colonnade.campaign.test import ReferenceMotion, Test
from colonnade.campaign.watched import Watched
from colonnade.dynamics.block import STANDARD_GRAVITY, Block
from colonnade.dynamics.models import model_of
from colonnade.findings import Finding

Known = Annotated[Specimen, GetPydanticSchema(lambda _, handler: handler.generate_schema(AnySpecimen))]
"""A specimen as it is written; assemblies join them as wholes."""


class CampaignKeys(Table):
    """The keys of a campaign file but its tests; all numbers in SI."""

    version: Literal[1] = Field(alias="schema")
    """Version of the campaign file's form: 1."""
    campaign: Identifier
    """Id of the campaign, such as "prism-2013"."""
    title: Text
    """Title of the report."""
    facility: Text | None = None
    """Laboratory and shake table."""
    gravity: Annotated[float, Quantity("acceleration", example="9.81 m/s^2")] = STANDARD_GRAVITY
    """Gravity at the laboratory; 9.81 m/s² if it is not given."""
    specimens: dict[Identifier, Known] = Field(min_length=1)
    """Specimens, by id."""
    assemblies: dict[Identifier, AssemblyTable] = Field(default={})
    """Assemblies of bodies that are made as specimens, by id; a test's `specimen` may be one."""
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

    @property
    def bodies(self) -> tuple[str, ...]:
        """Ids of the bodies on the table, one of which a channel may be on."""
        return (*self.specimens, *(name for each in self.assemblies.values() for name in each.placed))


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
    of_interest: tuple[str, ...] = ()
    """Specimens with a page and advice of their own: not those that are only bodies of an assembly."""

    @classmethod
    def of(cls, written: CampaignFile, path: Path, warnings: tuple[Finding, ...]) -> Campaign:
        """Make the campaign of a valid file."""
        parts = {body.specimen for table in written.assemblies.values() for body in table.placed.values()}
        tested = {test.specimen for test in written.tests}
        found: dict[str, Any] = {
            "tests": {test.id: test for test in written.tests},
            "awaited": missing_files((test for test in written.tests if test.planned), path.parent),
            "of_interest": tuple(name for name in written.specimens if name in tested or name not in parts),
        }
        return cls.model_construct(**dict(written) | found, path=path, folder=path.parent, warnings=warnings)

    def but(self, **changed: Any) -> Campaign:
        """Return the campaign with some attributes changed."""
        return self.model_copy(update=changed)

    def warned(self, findings: Iterable[Finding]) -> Campaign:
        """Return the campaign with some findings more."""
        return self.but(warnings=(*self.warnings, *findings))

    def told(self, value: object) -> str:
        """Write a part of the campaign as text, without its folder, so that a copy elsewhere gives the same."""
        return repr(value).replace(self.folder.as_posix(), ".")

    def review(self, test: str) -> Review:
        """Decisions of the manual review about a test; empty ones if it has none."""
        return self.reviews.get(test, Review())

    def awaiting(self) -> Campaign:
        """Return the campaign with every test that lacks a raw file planned."""
        return self.but(awaited=missing_files(self.tests.values(), self.folder))

    def left_out(self, test: str) -> str:
        """Why a test is not run: people excluded it, or it is planned and has no raw file; empty if it is run."""
        awaited = self.awaited.get(test, "")
        return self.review(test).excluded or (awaited and f"expected: {awaited}")

    def block(self, specimen: str) -> Block:
        """Block of a specimen, with the campaign's gravity."""
        return self.specimens[specimen].block(self.gravity)

    def members(self, test: Test, model: str) -> int:
        """Runs of a model's ensemble on the motion of a test; 0 for no ensemble."""
        ensemble = self.processing.predict.ensemble
        if not model_of(model).in_space:
            return ensemble.members
        asked = ensemble.contact.members
        return asked if asked != "auto" else OVERNIGHT * self.specimens[test.specimen].is_assembly

    def ensemble_settings(self, specimen: str) -> EnsembleSettings:
        """Settings of a specimen's ensembles, with what its own `uncertainty` says."""
        settings, own = self.processing.predict.ensemble, self.specimens[specimen].uncertainty
        return settings if own is None else settings.model_copy(update=own.model_dump(exclude_none=True))

    @property
    def combinations(self) -> dict[tuple[str, str], list[str]]:
        """Ids of the tests by specimen and setup, in the order in which these first come together."""
        found: dict[tuple[str, str], list[str]] = {}
        for test in self.tests.values():
            found.setdefault((test.specimen, test.setup), []).append(test.id)
        return found

    def channels(self, test: Test) -> dict[str, Channel]:
        """Channels of a test's specimen, table and ground for which it has a raw file, by id."""
        channels = self.channels_in(test.specimen, test.setup)
        return {name: channel for name, channel in channels.items() if channel.recorder in test.files}

    def channels_in(self, specimen: str, setup: str) -> dict[str, Channel]:
        """Channels of a specimen in a set-up, by id; of an assembly as of the one block as which it rocks."""
        whole = self.specimens[specimen]
        if isinstance(whole, Whole):
            return whole.as_seen(self.setups[setup].channels_of(specimen, tuple(whole.placed)))
        return self.setups[setup].channels_of(specimen)

    def concerning(self, test: str) -> tuple[Finding, ...]:
        """Warnings about a test's specimen or set-up, or the test itself."""
        tables = (f"specimens.{self.tests[test].specimen}", f"setups.{self.tests[test].setup}", f"tests.{test}")
        return tuple(found for found in self.warnings if found.about in tables)


def missing_files(tests: Iterable[Test], folder: Path) -> dict[str, str]:
    """Give the first raw file that is not there, as a path from the campaign's folder, of each test that lacks one."""
    found: dict[str, str] = {}
    for test in tests:
        missing = [path for path in test.files.values() if not path.exists()]
        if missing:
            found[test.id] = missing[0].relative_to(folder).as_posix()
    return found
