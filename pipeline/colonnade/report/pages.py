"""Pages from templates, each with its path back to the report's folder."""

from __future__ import annotations

import re
from collections.abc import Mapping
from contextvars import ContextVar
from functools import cache
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from colonnade import __version__
from colonnade.campaign import Campaign
from colonnade.dynamics.models import MODELS
from colonnade.errors import count
from colonnade.figures.files.output import Picture, link_to
from colonnade.report.addresses import of_specimen, of_test, scripts_of, way
from colonnade.report.assessments_page import symbol
from colonnade.report.pictures import picture
from colonnade.report.rows import KINDS
from colonnade.report.test_page import facts
from colonnade.store.records import wording
from colonnade.store.records.forecast import shown_table
from colonnade.store.records.test import predicted_peak_time
from colonnade.store.results import models_shown
from colonnade.units import text
from colonnade.units.text import format_percent

_SECTION = re.compile(r'<section id="([\w-]+)"(?: data-paper="no")?>\s*<h2>(.*?)</h2>', re.DOTALL)
"""Id and title of a section, as templates write them: for the table of contents of a page."""

_MARK = re.compile(f'href="{link_to("")}([^"]+)"')
"""Link of a mark in a figure to a test."""


_DRAWN: ContextVar[list[Picture]] = ContextVar("drawn")
"""Pictures of the page that is being rendered."""


def rendered(campaign: Campaign, template: str, address: str, **given: Any) -> tuple[str, list[Picture]]:
    """Return the page that stands at an address within the report's folder, and its pictures."""
    drawn: list[Picture] = []
    token = _DRAWN.set(drawn)
    root = "../" * address.count("/")
    common = {
        "campaign": campaign,
        "models": models_shown(campaign),
        "forecasts": None,  # a forecast that is added draws no page of a test or specimen again
        "here": address,
        "root": root,
    }
    text = _environment().get_template(f"{template}.html.jinja").render(common | given)
    _DRAWN.reset(token)
    return _MARK.sub(lambda found: f'href="{root}{of_test(found[1])}"', text), drawn


def _drawn(picture: Picture) -> Markup:
    """Give the `<svg>` of a picture, and note that the page shows it."""
    _DRAWN.get().append(picture)
    return Markup(picture.svg)


@cache
def _environment() -> Environment:
    """Return the templates with what they use; text of users is escaped."""
    environment = Environment(
        loader=PackageLoader("colonnade.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.globals |= {
        "kinds": KINDS,
        "count": count,
        "picture": picture,
        "listed": text.listed,
        "test_page": of_test,
        "scripts_of": scripts_of,
        "specimen_page": of_specimen,
        "sections": _SECTION.findall,
        "peak_time": predicted_peak_time,
        "registry": MODELS,
        "symbol": symbol,
        "version": __version__,
        "way": way,
        "who_and_when": facts.who_and_when,
    }
    environment.filters |= {
        "setting": _setting,
        "number": text.number,
        "quantity": text.quantity,
        "acceleration": text.acceleration,
        "order": wording.order,
        "by_bodies": wording.by_bodies,
        "table": shown_table,
        "ratio": text.ratio,
        "signed_ratio": text.signed_ratio,
        "percent": format_percent,
        "drawn": _drawn,
    }
    for name in ("parts", "groups"):
        environment.globals |= vars(environment.get_template(f"{name}.html.jinja").module)
    return environment


def _setting(setting: Mapping[str, Any]) -> str:
    """Write a setting's value with its unit."""
    value = setting["value"]
    if isinstance(value, (list, tuple)):
        return ", ".join(map(str, value))
    if isinstance(value, str):
        return value
    return f"{value:g} {setting['unit']}".rstrip()
