"""One figure of a campaign at the size of a journal, from the stored results."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from colonnade.campaign import Campaign
from colonnade.errors import CampaignError, nearest
from colonnade.store.layout import Layout

if TYPE_CHECKING:
    from colonnade.figures.files.output import Movie, Picture
    from colonnade.report.pictures.registry import Entry


def chosen(campaign: Campaign, name: str, subject: str | None) -> tuple[Entry, str]:
    """
    Find a figure by its name, and what it is of.

    Parameters
    ----------
    campaign : Campaign
    name : str
    subject : str or None
        Id of a test or specimen; None for the whole campaign, or if there is only one.

    Returns
    -------
    entry : Entry
    subject : str
        Id of the test or specimen, empty for the campaign.

    Raises
    ------
    CampaignError
        If there is no such figure, test or specimen.
    """
    from colonnade.report.pictures.registry import FIGURES

    entries = {entry.of: entry for entry in FIGURES if entry.name == name}
    if not entries:
        known = dict.fromkeys(entry.name for entry in FIGURES)
        raise CampaignError(
            f'Unknown figure "{name}".{nearest(name, known)} All are listed by `colonnade figure --list`.'
        )
    ids = {"test": list(campaign.tests), "specimen": list(campaign.specimens)}
    possible = {of: ids[of] for of in entries if of in ids}
    if subject is None:
        if "campaign" in entries:
            return entries["campaign"], ""
        alone = {of: names[0] for of, names in possible.items() if len(names) == 1}
        for of, only in alone.items():
            return entries[of], only
        raise CampaignError(
            f'"{name}" is a figure of a {" or a ".join(possible)}. Name one.'
            f"{nearest('', [each for names in possible.values() for each in names])}"
        )
    for of, names in possible.items():
        if subject in names:
            return entries[of], subject
    if not possible:
        raise CampaignError(f'"{name}" is a figure of the whole campaign. Leave out "{subject}".')
    hint = nearest(subject, [each for names in possible.values() for each in names])
    raise CampaignError(f'The campaign has no {" or ".join(possible)} "{subject}" that "{name}" could show.{hint}')


def draw(campaign: Campaign, entry: Entry, subject: str, results: Path | None) -> Picture | Movie:
    """
    Draw a figure from the results of the last run.

    Raises
    ------
    CampaignError
        If what is stored has nothing that it shows; the message says why.
    StoreError
        If a result is damaged.
    """
    from colonnade.report.pictures import subjects

    layout = Layout.of(campaign.path, results)
    found: subjects.Subject
    if entry.of == "test":
        found = subjects.read_of_test(campaign, layout, subject)
    elif entry.of == "specimen":
        found = subjects.read_of_specimen(campaign, layout, subject)
    else:
        found = subjects.read_of_campaign(campaign, layout)
    picture = entry.draw(found)
    if picture is None:
        why = "; ".join(f"{failure.stage}: {failure.text}".removeprefix(": ") for failure in found.failures)
        if not layout.summary_json.is_file():
            why = "nothing has been run yet; run `colonnade run` first"
        about = subject or campaign.campaign
        reason = f" The results say: {why}." if why else ""
        raise CampaignError(f'{about}: there is nothing to draw for "{entry.name}". {entry.needs}{reason}')
    return picture
