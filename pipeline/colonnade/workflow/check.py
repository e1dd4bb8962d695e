"""Check: what a run would refuse or warn of, found by running its first stages in memory; nothing is written."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from itertools import groupby
from pathlib import Path

from colonnade.campaign import Campaign, Test
from colonnade.campaign.assessment import Assessment
from colonnade.dynamics.models import CONTACT
from colonnade.errors import ReadError, StageError, count
from colonnade.findings import Finding, Severity, at_stage, in_order, note, warning
from colonnade.readers.recording import Recording
from colonnade.store.results import models_of
from colonnade.workflow.chain import WORKER_LOST
from colonnade.workflow.executors import Counted, spread
from colonnade.workflow.photos import unshown_photos
from colonnade.workflow.pooling import with_contradictions
from colonnade.workflow.raw_files import digests_of_equal_sizes, with_copies


@dataclass
class Checked:
    """
    The problems and findings of one test.

    Attributes
    ----------
    problems : list of str
        Why it would fail.
    findings : list of Finding
        What a run would warn of, without identification and prediction.
    concerning : tuple of Finding
        Findings on its specimen and set-up in the campaign file.
    """

    problems: list[str] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    concerning: tuple[Finding, ...] = ()

    @property
    def status(self) -> str:
        """In a word: would fail, doubtful (results would be wrong) or good."""
        if self.problems:
            return "would fail"
        is_doubtful = any(found.severity is Severity.SERIOUS for found in (*self.findings, *self.concerning))
        return "doubtful" if is_doubtful else "good"


@dataclass(frozen=True)
class CampaignCheck:
    """
    The problems and findings of a campaign.

    Attributes
    ----------
    campaign : Campaign
        With a warning of raw files that are copies, and of free vibrations that contradict what shaken tests use.
    tests : dict of str to Checked
    assessments : dict of str to Checked
    """

    campaign: Campaign
    tests: dict[str, Checked]
    assessments: dict[str, Checked] = field(default_factory=dict)

    @property
    def fails(self) -> bool:
        """Whether a test or an assessment would fail."""
        return any(each.problems for each in (*self.tests.values(), *self.assessments.values()))

    @property
    def has_warnings(self) -> bool:
        """Whether any finding is more serious than a note."""
        findings = [*self.campaign.warnings, *(found for _, each in self._subjects() for found in each.findings)]
        return any(found.severity is not Severity.NOTE for found in findings)

    @property
    def findings(self) -> dict[str, list[tuple[Finding, bool]]]:
        """What was found, by test, assessment or "campaign file", each put in order by `in_order`."""
        ordered = {"campaign file": in_order(self.campaign.warnings)}
        return ordered | {name: in_order(each.findings, each.concerning) for name, each in self._subjects()}

    def _subjects(self) -> list[tuple[str, Checked]]:
        return [*self.tests.items(), *((f"assessment {name}", each) for name, each in self.assessments.items())]


MANY = 16
"""Files from which starting other processes is sooner done than reading them one after the other."""


def check(campaign: Campaign, progress: Counted = lambda done, total: None) -> CampaignCheck:
    """
    Read every raw file of a campaign, and run each test as far as the start of its prediction.

    Parameters
    ----------
    campaign : Campaign
    progress : callable, optional
        Called with the number of tests that are done, and of all.

    Returns
    -------
    checked : CampaignCheck
    """
    campaign = with_copies(campaign, digests_of_equal_sizes(campaign))
    campaign = campaign.but(warnings=(*campaign.warnings, *unshown_photos(campaign), *_overnight(campaign)))
    found: dict[str, Checked] = {}
    for name in campaign.tests:
        if excluded := campaign.review(name).excluded:
            found[name] = Checked(findings=[note("excluded", f"{excluded} (review.toml).")])
        elif awaited := campaign.left_out(name):
            found[name] = Checked(findings=[note("planned", f"{awaited}. This planned test has not been run yet.")])
    waiting = [test for name, test in campaign.tests.items() if name not in found]
    # Tests that share a file follow each other in most campaigns: it is read once.
    together = [list(tests) for _, tests in groupby(waiting, lambda test: test.files)]
    parts = [campaign.but(tests={test.id: test for test in tests}) for tests in together]
    progress(len(found), len(campaign.tests))
    for read in spread(_read_and_checked, parts, workers=None if len(parts) >= MANY else 1, lost=_lost):
        found |= read
        progress(len(found), len(campaign.tests))
    found = {name: found[name] for name in campaign.tests}
    campaign = with_contradictions(campaign, {name: each.findings for name, each in found.items()})
    for name, each in found.items():
        each.concerning = campaign.concerning(name)
    assessments = {name: _records_checked(campaign, asked) for name, asked in campaign.assessments.items()}
    return CampaignCheck(campaign, found, assessments)


def _overnight(campaign: Campaign) -> list[Finding]:
    """Say how often several bodies are moved, which takes hours."""
    tests = [test for test in campaign.tests.values() if campaign.specimens[test.specimen].is_assembly]
    runs = sum(campaign.members(test, CONTACT.name) for test in tests)
    if not runs:
        return []
    first = "For a first look without them, write `members = 0` under [processing.predict.ensemble.contact]."
    return [_on_contact(f"the bodies of {count(len(tests), 'test')}", runs, first)]


def _on_contact(what: str, runs: int, remedy: str = "Fewer `levels` and `draws` take less.") -> Finding:
    """Say how often bodies are moved by the contact model, and that it takes hours."""
    said = (
        f"The contact model moves {what} {count(runs, 'time')}, over what is not known. Four drums over 20 s take "
        f"about two minutes of one core each time; the runs are spread over all cores. {remedy}"
    )
    return note("runs on contact", said)


def _read_and_checked(part: Campaign) -> dict[str, Checked]:
    """Check tests that share their files."""
    from colonnade.readers.registry import read

    @cache
    def reading(path: Path, setup: str, recorder: str) -> Recording:
        file = part.setups[setup].recorders[recorder].file
        return read(path, file.format, file.options, within=part.folder)

    return {name: _checked(part, test, reading) for name, test in part.tests.items()}


def _lost(part: Campaign) -> dict[str, Checked]:
    return {name: Checked(problems=[WORKER_LOST]) for name in part.tests}


def _checked(campaign: Campaign, test: Test, reading: Callable[[Path, str, str], Recording]) -> Checked:
    checked = Checked()
    recordings: dict[str, Recording] = {}
    for recorder, path in test.files.items():
        try:
            recordings[recorder] = reading(path, test.setup, recorder)
        except ReadError as error:
            checked.problems.append(str(error))
    checked.problems += _missing_columns(campaign, test, recordings)
    if not checked.problems:
        try:
            _measure(campaign, test, recordings, checked.findings)
        except (ReadError, StageError) as error:
            checked.problems.append(str(error))
    return checked


def _records_checked(campaign: Campaign, asked: Assessment) -> Checked:
    """Read the ground motions and the hazard of an assessment; no history is run."""
    from colonnade.assessment.outcomes import FEWEST
    from colonnade.readers.ground_motions.hazard import read_hazard
    from colonnade.readers.ground_motions.record_set import read_record_set

    checked = Checked()
    try:
        records = read_record_set(asked.records)
    except ReadError as error:
        checked.problems.append(str(error))
    else:
        if len(records.records) < FEWEST:
            checked.problems.append(
                f"{count(len(records.records), 'ground motion')} can be used; at least {FEWEST} were expected."
            )
        said = (
            f"{each.name} is left out: {each.reason.removeprefix(f'{each.name}: ').splitlines()[0]}"
            for each in records.left_out
        )
        checked.findings += at_stage((warning("ground motion", each) for each in said), "assessment")
        checked.findings += at_stage((note("ground motion", each) for each in records.notes), "assessment")
        if not campaign.specimens[asked.specimen].is_in_plane:
            motions = sum(2 - (each.motion.transverse is None) for each in records.records)
            runs = motions * len(asked.levels or ()) * (1 + asked.draws)
            checked.findings += at_stage([_on_contact(asked.specimen, runs)], "assessment")
    if asked.hazard is not None:
        try:
            read_hazard(asked.hazard, asked.measure)
        except ReadError as error:
            checked.problems.append(str(error))
    return checked


def _missing_columns(campaign: Campaign, test: Test, recordings: dict[str, Recording]) -> list[str]:
    """Find every column of a test that its files do not have; `ingest` stops at the first."""
    problems = []
    for name, channel in campaign.channels(test).items():
        for column in (channel.column, channel.time):
            if channel.recorder in recordings and column is not None:
                try:
                    recordings[channel.recorder].channel(column)
                except ReadError as error:
                    problems.append(f"channel {name}: {error}")
    return problems


def _measure(campaign: Campaign, test: Test, recordings: dict[str, Recording], findings: list[Finding]) -> None:
    """
    Run the stages up to the start of a prediction; the warnings of each stage are added to the findings.

    Raises
    ------
    ReadError, StageError
        As the stages do.
    """
    from colonnade.stages import compare, condition, ingest, predict, restitution, rocking
    from colonnade.stages.parts.beginning import begin

    recorded = ingest.ingest(recordings, ingest.IngestInputs.of(campaign, test))
    findings += at_stage(recorded.attrs["warnings"], "ingest")
    conditioned = condition.condition(recorded, condition.ConditionInputs.of(campaign, test))
    findings += at_stage(conditioned.attrs["warnings"], "condition")
    measured = rocking.rocking(conditioned, rocking.RockingInputs.of(campaign, test))
    findings += at_stage(measured.attrs["warnings"], "rocking")
    if test.kind == "free-vibration":
        restitution.expect_angle(measured)
    elif test.kind == "sine":
        forcing = compare.forcing_of(measured)
        findings += at_stage(compare.contradictions(forcing, test.frequency, test.amplitude), "compare")
    for model in models_of(campaign, test)[:1]:  # the base motion and the start are the same for all
        beginning = begin(measured, predict.PredictInputs.of(campaign, test, model))
        findings += at_stage(beginning.warnings, "predict")
