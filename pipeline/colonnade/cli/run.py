"""`colonnade run` and its kind: the commands that run a part of it, `check`, which writes nothing, and `watch`."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common import options
from colonnade.cli.common.console import complain, saved, say, say_marked, show_json, show_table, work_progress
from colonnade.cli.common.findings import STYLES, records_of, show_by_kind, show_failures
from colonnade.cli.show import show_tests
from colonnade.errors import count
from colonnade.findings import Severity
from colonnade.interruption import answered, noted
from colonnade.store.results import RUN_STAGES

if TYPE_CHECKING:
    from colonnade.campaign import Campaign
    from colonnade.store.records.advice import Advice
    from colonnade.workflow import RunResult, StageRun
    from colonnade.workflow.watching.measure import Line


@click.command(epilog="Example: colonnade run demo --from predict --only span-2.0")
@options.campaign_argument
@click.option("--until", type=click.Choice(RUN_STAGES), metavar="STAGE", help="Stop after this stage.")
@click.option(
    "--from", "start_from", type=click.Choice(RUN_STAGES), metavar="STAGE", help="Redo this stage and all that follow."
)
@options.work_options
def run(campaign: Path, **choices: Any) -> int:
    """
    Run all stages and the report; redo only what is out of date.

    {CAMPAIGN} Each redone test is a line: what was measured, and what each model predicts. ✓ is inside the 95 % band
    of the model's runs, ≠ outside or another outcome. A test that fails does not stop the others; the exit code is
    then 1.

    Stages are ingest, condition, rocking, restitution, predict, ensemble, compare and report.
    """
    return _run_and_show(campaign, {}, **choices)


def _run_and_show(
    campaign: Path,
    documents: Mapping[str, Callable[[], Path]],
    *,
    as_json: bool,
    strict: bool,
    verbose: bool,
    **choices: Any,
) -> int:
    """Run a campaign, write the documents that are asked for, and show what was done; return the exit code."""
    result = run_with_progress(campaign, **choices)
    written = {name: write() for name, write in documents.items()}
    if as_json:
        show_json(_record(result) | written)
    else:
        show_result(result, verbose=verbose)
        for name, path in written.items():
            say(f"{name}: {path}")
    return int(result.failed or (strict and result.has_warnings))


def _up_to(stage: str, name: str, what: str, writes: str) -> click.Command:
    """Make the command that runs as far as one stage."""

    def command(campaign: Path, **choices: Any) -> Any:
        return _run_and_show(campaign, {}, until=stage, **choices)

    text, example = f"{what}\n\n{options.CAMPAIGN}\n\nWrites {writes}", f"Example: colonnade {name} demo --only free-01"
    made: click.Command = click.command(name, help=text, epilog=example)(
        options.campaign_argument(options.work_options(command))
    )
    return made


IN = "processed/tests/<ID>/"

ingest = _up_to("ingest", "ingest", "Read the raw files into SI channels with quality flags.", f"{IN}recorded.nc.")
identify = _up_to(
    "restitution",
    "identify",
    "Identify the restitution, up to each specimen's pooled e.",
    f"results up to {IN}restitution.nc of each free vibration, and processed/specimens/<ID>.nc.",
)
predict = _up_to(
    "predict",
    "predict",
    "Run the models on the recorded base motion, after the stages that they need.",
    f"results up to {IN}predicted-<MODEL>.nc.",
)


@click.command(epilog="Example: colonnade report demo --pdf --bundle demo-report.zip")
@options.campaign_argument
@click.option("--pdf", "with_pdf", is_flag=True, help="Also typeset the report as report/report.pdf.")
@click.option("--no-appendix", "appendix", flag_value=False, default=True, help="Leave the tests' own pages out of it.")
@click.option("--bundle", type=options.FILE, metavar="FILE.zip", help="Also put the whole report into one zip file.")
@options.work_options
def report(
    campaign: Path, *, with_pdf: bool, appendix: bool, bundle: Path | None, results: Path | None, **choices: Any
) -> int:
    """
    Make the report, after the stages that it needs.

    {CAMPAIGN}

    Writes report/index.html next to campaign.toml, with a page for each test and specimen, even if tests failed.
    """
    from colonnade.workflow.documents import write_bundle, write_pdf

    documents: dict[str, Callable[[], Path]] = {}
    if with_pdf:
        documents["pdf"] = partial(write_pdf, *options.opened(campaign, results), appendix=appendix)
    elif not appendix:
        raise click.UsageError("--no-appendix is about the PDF: add --pdf")
    if bundle is not None:
        documents["bundle"] = partial(write_bundle, *options.opened(campaign, results), bundle)
    return _run_and_show(campaign, documents, until="report", results=results, **choices)


def run_with_progress(campaign: Path, **choices: Any) -> RunResult:
    """Run a campaign with a bar on stderr."""
    from colonnade.workflow import run

    def progress(stage: StageRun, done: int, total: int) -> None:
        show(done, total, f"{stage.subject} {stage.stage}")

    with work_progress("Looking for what is out of date") as show:
        return run(campaign, progress=progress, **choices)


def show_result(result: RunResult, *, verbose: bool = False) -> None:
    """Show each redone test, agreement, findings, failures, and the paths of the results."""
    from colonnade.campaign.forms.summary import Summary
    from colonnade.store.records.wording import agreement, pooled

    redone = [stage for stage in result.stages if stage.action == "done"]
    if verbose:
        rows = [(each.subject, each.stage, each.because, f"{each.seconds:.1f}") for each in redone]
        show_table(("redone", "stage", "why", "seconds"), rows)
    known = Summary.model_validate_json(result.summary.read_bytes())
    last = {stage.subject: stage.stage for stage in redone if stage.of == "test"}
    show_tests({name: test for name, test in known.tests.items() if name in last}, known.specimens, last)
    # Bodies of an assembly, and what they are made as, have no e of their own that a model takes.
    alone = {test.specimen for test in known.tests.values() if not test.bodies}
    for name in dict.fromkeys(stage.subject for stage in redone if stage.of == "specimen"):
        if name in alone or known.specimens[name].restitution.source != "rigid-body":
            say(f"specimen {name}  {pooled(known.specimens[name].restitution)}")
    for sentence in agreement(known.model_dump(mode="json")["tests"]):
        say(sentence)
    findings = result.findings
    show_by_kind(findings)
    show_failures(result, "failed in {}", where="above")
    for notice in result.notices:
        say(notice)
    actions = Counter(stage.action for stage in result.stages)
    say(f"{actions['done']} redone, {actions['up-to-date']} up to date, {actions['failed']} failed")
    say(f"summary: {result.summary}")
    if result.report is not None:
        if findings:
            say(f"all findings: {result.report.parent / 'problems.html'}")
        say(f"report: {result.report}")


def _record(result: RunResult) -> dict[str, Any]:
    return {
        "failed": result.failed,
        "summary": result.summary,
        "report": result.report,
        "warnings": [
            {"subject": subject, **vars(record)}
            for subject, ordered in result.findings.items()
            for record in records_of(ordered)
        ],
        "notices": result.notices,
        "stages": [
            {name: value for name, value in vars(stage).items() if name != "findings"} for stage in result.stages
        ],
    }


WRONG = "would give wrong results"


@click.command(epilog="Example: colonnade check demo")
@options.campaign_argument
@options.file_option("--drawing", "Draw specimens and transducers to this file: .svg, .pdf or .png.")
@options.strict_option
@options.json_option
def check(campaign: Path, drawing: Path | None, strict: bool, as_json: bool) -> int:
    """
    Check a campaign and its raw files; write nothing.

    {CAMPAIGN} Every raw file is read as `run` would read it, and each test is taken to the point where its prediction
    would begin. The ground motions and the hazard of assessments are read, too. Missing files and columns, units,
    gains, signs, swapped columns, clocks and dead channels are reported for all tests at once. The exit code is 1 if a
    test or an assessment would fail.

    With --drawing, specimens and transducers are drawn to scale as the campaign file places them: that is the one file
    that is written.
    """
    from colonnade.campaign import load
    from colonnade.workflow.check import check as check_campaign

    loaded = load(campaign)
    if drawing is not None:
        from colonnade.figures.drawing.described import of_campaign

        saved(lambda: of_campaign(loaded), drawing)
    with work_progress("Reading raw files") as progress:
        checked = check_campaign(loaded, progress)
    if as_json:
        show_json(_checked_record(loaded, checked) | ({} if drawing is None else {"drawing": drawing}))
    else:
        _show_checked(checked, drawing)
    return int(checked.failed or (strict and checked.has_warnings))


def _checked_record(campaign: Campaign, checked: RunResult) -> dict[str, Any]:
    findings = checked.findings
    found: dict[str, Any] = {"campaign": campaign.path, "warnings": records_of(findings.get("campaign file", ()))}
    found |= {"tests": {}, "assessments": {}}
    for stage in checked.stages:
        problems = [stage.reason] if stage.action == "failed" else []
        warnings = records_of(findings.get(stage.heading, ()))
        found[f"{stage.of}s"][stage.subject] = {"problems": problems, "warnings": warnings}
    return found


def _show_checked(checked: RunResult, drawing: Path | None) -> None:
    say_marked(*_verdict(checked), f" Nothing was written{'.' if drawing is None else f' but {drawing}.'}")
    show_failures(checked, "would fail", where="below")
    show_by_kind(checked.findings)


def _verdict(checked: RunResult) -> tuple[str, str]:
    """Say in a line how many tests are good, and give its colour."""
    failing = [stage for stage in checked.stages if stage.action == "failed"]
    whole = [stage for stage in checked.stages if stage.of == "test"]
    statuses = Counter("would fail" if each in failing else _good(checked, each) for each in whole)
    tests = count(len(whole), "test")
    parts = [f"{statuses[each]} {each}" for each in ("would fail", WRONG, "good") if statuses[each]]
    if unanswered := sum(each.of == "assessment" for each in failing):
        parts.append(f"{count(unanswered, 'assessment')} would fail")
    if failing or statuses[WRONG]:
        return f"{tests}: {', '.join(parts)}.", STYLES[Severity.SERIOUS]
    if checked.has_warnings:
        return f"No test would fail, but see the findings: {', '.join(parts)}.", STYLES[Severity.WARNING]
    return f"All good: {tests}.", "bold green"


def _good(checked: RunResult, stage: StageRun) -> str:
    """Say whether the results of a test would be wrong, by what was found of it and of its specimen and set-up."""
    found = (*stage.findings, *checked.concerning[stage.subject])
    return WRONG if any(each.severity is Severity.SERIOUS for each in found) else "good"


@click.command(epilog='Example: colonnade watch --from /media/recorder --notify "notify-send colonnade"')
@options.campaign_argument
@click.option(
    "--from",
    "share",
    type=click.Path(exists=True, file_okay=False, path_type=Path),
    metavar="DIR",
    help="Copy finished files from this folder, such as a recorder's share. No file is ever overwritten.",
)
@click.option("--notify", metavar="COMMAND", help="After each test run this command, its line as JSON on stdin.")
@click.option("--once", is_flag=True, help="Handle what is there, then end with the exit code of `run`.")
@options.workers_option
@options.result_options
def watch(campaign: Path, notify: str | None, once: bool, as_json: bool, **choices: Any) -> int:
    """
    Watch the raw folder: a line on each test as soon as its file is finished.

    {CAMPAIGN} The line says what happened, what the models predict, and what is wrong. Ensembles, the contact
    model, earlier tests and the report follow at lower priority. An open page of the report keeps itself up to date.

    Tests come from [[tests]], the test log, or the `pattern` in [watch]. Ctrl-C ends the watch with
    exit code 0; nothing is lost.
    """
    from colonnade.workflow.watching.measure import command_of
    from colonnade.workflow.watching.watch import watch as watch_campaign

    try:
        command = command_of(notify) if notify is not None else ()
        show = partial(_show_line, as_json=as_json)
        return watch_campaign(campaign, command=command, once=once, show=show, say=complain, **choices)
    except (KeyboardInterrupt, Exception) as error:  # the import of a compiled module makes an ImportError of it
        if once or not (noted() or isinstance(error, KeyboardInterrupt)):
            raise
        answered()
    complain("The watch has ended. All results are kept.")
    return 0


def _show_line(line: Line | Advice, *, as_json: bool) -> None:
    say(json.dumps(line.as_json(), ensure_ascii=False, allow_nan=False) if as_json else line.text())
