"""Pages from templates: one environment, and for each page its path back to the report's folder."""

from __future__ import annotations

import re
from typing import Any

from jinja2 import BytecodeCache, Environment, PackageLoader, StrictUndefined
from jinja2.bccache import Bucket
from markupsafe import Markup

from colonnade import __version__
from colonnade.campaign import Campaign
from colonnade.campaign.settings import Setting
from colonnade.dynamics.models import MODELS
from colonnade.errors import count
from colonnade.figures.files.output import Picture, link_to
from colonnade.report.addresses import of_specimen, of_test, scripts_of, way
from colonnade.report.assessments_page import symbol
from colonnade.report.pictures.registry import picture
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


class _Compiled(BytecodeCache):
    """Templates that were compiled in this process: the environments of all renderers share their code."""

    def __init__(self) -> None:
        self._known: dict[tuple[str, str], Any] = {}

    def load_bytecode(self, bucket: Bucket) -> None:
        """Give a template its code if it was compiled before."""
        bucket.code = self._known.get((bucket.key, bucket.checksum))

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Keep the code of a template."""
        self._known[bucket.key, bucket.checksum] = bucket.code


_COMPILED = _Compiled()


class Renderer:
    """
    Renders templates; text of users is escaped.

    Parameters
    ----------
    **common
        What every page is given.

    Attributes
    ----------
    pictures : list of Picture
        Those of the page that was rendered last.
    """

    def __init__(self, **common: Any) -> None:
        self.pictures: list[Picture] = []
        self._environment = Environment(
            loader=PackageLoader("colonnade.report"),
            autoescape=True,
            undefined=StrictUndefined,
            bytecode_cache=_COMPILED,
            trim_blocks=True,
            lstrip_blocks=True,
            keep_trailing_newline=True,
        )
        self._environment.globals |= {
            **common,
            "kinds": KINDS,
            "count": count,
            "picture": picture,
            "listed": text.listed,
            "test_page": of_test,
            "scripts_of": scripts_of,
            "specimen_page": of_specimen,
            "sections": _SECTION.findall,
            "peak_time": predicted_peak_time,
            "symbol": symbol,
            "way": way,
            "forecasts": None,  # a forecast that is added draws no page of a test or specimen again
        }
        self._environment.filters |= {
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
            "drawn": self._drawn,
        }
        for name in ("parts", "groups"):
            self._environment.globals |= vars(self._environment.get_template(f"{name}.html.jinja").module)

    def page(self, template: str, address: str, **given: Any) -> str:
        """Return the page that stands at an address within the report's folder."""
        self.pictures = []
        root = "../" * address.count("/")
        text = self._environment.get_template(f"{template}.html.jinja").render(here=address, root=root, **given)
        return _MARK.sub(lambda found: f'href="{root}{of_test(found[1])}"', text)

    def _drawn(self, picture: Picture) -> Markup:
        """Give the `<svg>` of a picture, and note that the page shows it."""
        self.pictures.append(picture)
        return Markup(picture.svg)


def _setting(setting: Setting) -> str:
    """Write a setting's value with its unit."""
    value = setting.value
    if isinstance(value, (list, tuple)):
        return ", ".join(map(str, value))
    if isinstance(value, str):
        return value
    return f"{value:g} {setting.unit}".rstrip()


def renderer_of(campaign: Campaign) -> Renderer:
    """Return the renderer of a campaign's pages."""
    return Renderer(
        campaign=campaign,
        who_and_when=facts.who_and_when(campaign),
        models=models_shown(campaign),
        registry=MODELS,
        gravity=text.quantity(campaign.gravity, "m/s²", 5),
        version=__version__,
    )
