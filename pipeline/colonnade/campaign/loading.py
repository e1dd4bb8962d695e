"""Loading of campaign.toml and review.toml: text to tables, tables to models; all problems are reported at once."""

from __future__ import annotations

from pathlib import Path

from colonnade.campaign.assembly import Whole
from colonnade.campaign.campaign import Campaign, CampaignFile
from colonnade.campaign.found import find_tests
from colonnade.campaign.notices import notices
from colonnade.campaign.references import dangling
from colonnade.campaign.review import read_review
from colonnade.campaign.syntax.document import Place, read, refusal, validated
from colonnade.campaign.testlog import with_log
from colonnade.errors import CampaignError
from colonnade.findings import Finding

FILE_NAME = "campaign.toml"


def load(path: Path | str) -> Campaign:
    """
    Read a campaign file.

    Parameters
    ----------
    path : Path or str
        A campaign.toml or its folder.

    Returns
    -------
    campaign : Campaign
        All numbers in SI. Raw files need not exist.

    Raises
    ------
    CampaignError
        If the file, its test log or its review cannot be used; its text has a paragraph for each problem.
    """
    path = _found(Path(path))
    source, paragraphs, ignored = read(path), list[str](), list[Finding]()
    if isinstance(source.document.get("tests"), str):
        source, paragraphs, ignored = with_log(source, path.parent)
    written, problems = validated(CampaignFile, source.document, path.parent)
    findings: tuple[Finding, ...] = ()
    if written is not None:
        tests, findings = find_tests(written, path.parent)
        written = written.model_copy(update={"tests": (*written.tests, *tests)})
        written, wrong = _with_wholes(written)
        problems += [*wrong, *dangling(written)]
    paragraphs += source.paragraphs(problems)
    if paragraphs or written is None:
        raise refusal(paragraphs)
    campaign = Campaign.of(written, path, (*ignored, *findings, *notices(written)))
    return campaign.but(reviews=read_review(path.parent, campaign.tests, campaign.setups))


def _with_wholes(written: CampaignFile) -> tuple[CampaignFile, list[tuple[Place, str]]]:
    """Add each assembly to the specimens, as the one block as which it rocks; say why one cannot be."""
    wholes: dict[str, Whole] = {}
    wrong: list[tuple[Place, str]] = []
    for name, table in written.assemblies.items():
        if any(body.specimen not in written.specimens for body in table.placed.values()) or name in written.specimens:
            continue
        try:
            wholes[name] = Whole.of(table, written.specimens)
        except (ValueError, ArithmeticError) as error:
            wrong.append((("assemblies", name), f"{str(error).rstrip('.')}."))
    return written.model_copy(update={"specimens": written.specimens | wholes}), wrong


def _found(path: Path) -> Path:
    try:
        if path.is_dir():
            path = path / FILE_NAME
        path = path.parent.resolve() / path.name  # a campaign file that is a link belongs to the folder of the link
        if path.exists():
            return path
    except (OSError, RuntimeError, ValueError) as error:
        raise CampaignError(f"{path}: invalid path ({error}).") from None
    raise CampaignError(f"{path.name}: not found in {path.parent}. Name a {FILE_NAME} or its folder.")
