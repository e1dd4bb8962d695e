"""`colonnade check`: the campaign and its raw files, looked at as `ingest` would, and nothing written."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

import rich_click as click

from colonnade.cli.console import say, show_json
from colonnade.cli.findings import lines_of, records_of
from colonnade.cli.options import campaign_argument, json_option
from colonnade.cli.progress import counting

if TYPE_CHECKING:
    from colonnade.campaign import Campaign
    from colonnade.findings import Finding as Found
    from colonnade.readers.recording import Recording


@dataclass
class Finding:
    """What `check` has to say about one test."""

    problems: list[str] = field(default_factory=list)
    warnings: list[Found] = field(default_factory=list)


@click.command(epilog="Example: colonnade check demo")
@campaign_argument
@json_option
def check(campaign: Path, as_json: bool) -> int:
    """
    Validate a campaign and its raw files; write nothing.

    CAMPAIGN is a campaign.toml or its folder, by default the one you stand in. Every raw file is read as `run` would
    read it: missing files and columns, units, clocks and dead channels are told for all tests at once. The exit code
    is 1 where a test would fail.
    """
    from colonnade.campaign import load

    loaded = load(campaign)
    findings = _examine(loaded)
    if as_json:
        tests = {
            name: {"problems": finding.problems, "warnings": records_of(finding.warnings)}
            for name, finding in findings.items()
        }
        show_json({"campaign": str(loaded.path), "warnings": records_of(loaded.warnings), "tests": tests})
    else:
        _tell(loaded, findings)
    return int(any(finding.problems for finding in findings.values()))


def _examine(campaign: Campaign) -> dict[str, Finding]:
    from colonnade.errors import ReadError, StageError
    from colonnade.findings import note
    from colonnade.readers.registry import read
    from colonnade.stages.ingest import ingest, instructions

    @lru_cache(maxsize=2)  # tests that share a file stand beside each other in most campaigns
    def recording(path: Path, setup: str, recorder: str) -> Recording:
        file = campaign.setups[setup].recorders[recorder].file
        return read(path, file.format, file.options, within=campaign.folder)

    findings = {}
    with counting("Reading raw files", len(campaign.tests)) as advance:
        for name, test in campaign.tests.items():
            finding, recordings = Finding(), {}
            findings[name] = finding
            if excluded := campaign.review(name).excluded:
                finding.warnings.append(note("excluded", f"{excluded} (review.toml)."))
                advance()
                continue
            for recorder, path in test.files.items():
                try:
                    recordings[recorder] = recording(path, test.setup, recorder)
                except ReadError as error:
                    finding.problems.append(str(error))
            finding.problems += _missing_columns(campaign, name, recordings)
            if not finding.problems:
                try:
                    recorded = ingest(recordings, instructions(campaign, test))
                    finding.warnings += recorded.attrs["warnings"]
                except (ReadError, StageError) as error:
                    finding.problems.append(str(error))
            advance()
    return findings


def _missing_columns(campaign: Campaign, test: str, recordings: dict[str, Recording]) -> list[str]:
    """Find every column of a test that its files do not have; `ingest` stops at the first."""
    from colonnade.errors import ReadError

    problems = []
    for name, channel in campaign.channels(campaign.tests[test]).items():
        for column in (channel.column, channel.time):
            if channel.recorder in recordings and column is not None:
                try:
                    recordings[channel.recorder].channel(column)
                except ReadError as error:
                    problems.append(f"channel {name}: {error}")
    return problems


def _tell(campaign: Campaign, findings: dict[str, Finding]) -> None:
    say(f"{campaign.path}: {_count(len(campaign.tests), 'test')}, {_count(len(campaign.specimens), 'specimen')}")
    for line in lines_of(campaign.warnings):
        say(f"  {line}")
    for name, finding in findings.items():
        say(f"{name}: {'would fail' if finding.problems else 'good'}")
        for problem in finding.problems:
            say(f"  problem: {_indented(problem)}")
        for line in lines_of(finding.warnings):
            say(f"  {_indented(line)}")
    failing = sum(bool(finding.problems) for finding in findings.values())
    say(f"{_count(failing, 'test')} would fail." if failing else "All good; nothing was written.")


def _count(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number} {what}s"


def _indented(text: str) -> str:
    return text.replace("\n", "\n    ")
