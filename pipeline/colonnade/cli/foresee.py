"""`colonnade foresee` and `next`: forecasts, kept before the test, and which test tells most."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import rich_click as click

from colonnade.cli.common.console import say, show_json, show_paragraph, show_table, work_progress
from colonnade.cli.common.options import (
    Asking,
    campaign_argument,
    opened,
    options_of,
    result_options,
    specimen_option,
)

if TYPE_CHECKING:
    from colonnade.store.records.advice import Advice
    from colonnade.workflow.foresee import Forecast


def _foresee_keys() -> list[click.Option]:
    from colonnade.workflow.foresee import AskedForecast

    return options_of(AskedForecast.model_fields, alone=True)


@click.command(
    cls=Asking,
    keys=_foresee_keys,
    epilog='Example: colonnade foresee demo --specimen prism --motion "El Centro 1940 NS" --level "0.3 g" --level 1.5x',
)
@campaign_argument
@result_options
def foresee(campaign: Path, given: dict[str, Any], results: Path | None, as_json: bool) -> int:
    """
    Forecast what a specimen does on a base motion.

    {CAMPAIGN} Run it first: a forecast takes the e that is identified so far.

    Writes a file for each level into forecasts/, which is never changed. After the test `run` scores the last one with
    --test that was made before the raw file of that test was there.
    """
    from colonnade.workflow.foresee import AskedForecast
    from colonnade.workflow.foresee import foresee as make
    from colonnade.workflow.real_column import picked

    with work_progress("Foreseeing") as progress:
        made = make(*opened(campaign, results), picked(AskedForecast, given), progress)
    if as_json:
        show_json([{"file": each.path, **each.forecast.model_dump(by_alias=True)} for each in made])
        return 0
    for each in made:
        _show(each)
        say(f"forecast: {each.path}")
    return 0


def _show(made: Forecast) -> None:
    """Write what the table must do, and under it what each model foresees, side by side."""
    from colonnade.store.records.forecast import FORESEEN, shown_model, shown_table

    forecast = made.forecast
    acceleration, velocity, displacement = shown_table(forecast.table)
    show_paragraph(f"{forecast.level}: the table reaches {acceleration}; velocity {velocity}; stroke {displacement}")
    columns = [shown_model(model) for model in forecast.models.values()]
    show_table(("", *forecast.models), list(zip(FORESEEN, *columns, strict=True)))


@click.command(
    "next",
    epilog="Example: colonnade next demo --specimen prism",
)
@campaign_argument
@specimen_option
@result_options
def next_command(campaign: Path, specimen: tuple[str, ...], results: Path | None, as_json: bool) -> int:
    """
    Say which test tells most: the next one, and the others of all specimens by what they tell.

    {CAMPAIGN} It uses the results of the last run. Each advice has its reason, its risk of overturning and what the
    table must do; "enough" means that no test of this kind is needed. A Span is advised at most a fifth above the
    largest that was tested. The settings are in [next], the limits of the table in [table]. Nothing is written.
    """
    from colonnade.workflow.advising.next import advise
    from colonnade.workflow.product import Catalogue

    loaded, layout = opened(campaign, results)
    loaded = loaded.awaiting()
    with work_progress("Looking for the test that tells most"):
        found = advise(loaded, layout, Catalogue(layout), specimen)
    if as_json:
        show_json({"advice": found, "awaited": loaded.awaited})
        return 0
    _show_advice(found)
    for test, file in loaded.awaited.items():
        show_paragraph(f"{test}: expected: {file}")
    return 0


def _show_advice(advice: Sequence[Advice]) -> None:
    """Write the test to do next with its reason, then the others."""
    if not advice:
        say("Nothing to advise: no free vibration, sine test or earthquake has been run.")
        return
    needed = [each for each in advice if not each.is_enough and not each.beyond]
    others = [each for each in advice if each not in needed[:1]]
    if needed:
        show_paragraph(f"Do this next: {needed[0].what()}")
        show_paragraph(f"Because {needed[0].reason}.")
    else:
        say("No test that the table can do is needed.")
    if others:
        say("\nThen, by what they tell:" if needed else "")
    for each in others:
        reasons = [each.reason] if each.is_enough else each.beyond
        show_paragraph("; ".join((each.what(), *reasons)), bullet="- ")
