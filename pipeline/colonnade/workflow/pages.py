"""The report as products: drawings, the page of each test and specimen, the pages of the whole campaign."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import chain
from pathlib import Path

from colonnade.campaign import Campaign
from colonnade.campaign.forms.foreseen import ForecastsSummary
from colonnade.report import addresses
from colonnade.report.addresses import UNWATCHED
from colonnade.report.asked import Asked, Photos, asked_of
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.advice import Advice
from colonnade.store.results import ResultId, models_shown, results_of
from colonnade.workflow.product import Catalogue, Contents, Made, Product, brought_up_to_date

MADE_BY = ("colonnade.report", "colonnade.store")
"""Packages whose code makes the pages; what they import counts too."""

OWN = ("tests/*.html", "specimens/*.html", "data/**/*.js", "scripts/*.js", "setups/*.svg", *addresses.OPTIONAL)
"""Files of the report's folders; one that nothing of the campaign leads to any more is removed."""


Drawn = tuple[Asked, str]
"""A test whose page was asked for, and what was kept of it: its part of other pages is read from that."""


@dataclass
class Report:
    """
    The report of a campaign, as products.

    Attributes
    ----------
    campaign : Campaign
    layout : Layout
    catalogue : Catalogue
    outdated : collection of str
        Tests whose stored results are out of date: they are pending, and not shown.
    forecasts : ForecastsSummary or None
        As in the summary: the hash of each forecast is in it.
    advice : sequence of Advice
        On the next tests.
    photos : mapping of str to Photos
        Of each test, as they are in the report.
    workers : int or None
        Processes in which pages are drawn; None for one a core.
    """

    campaign: Campaign
    layout: Layout
    catalogue: Catalogue
    outdated: Collection[str] = ()
    forecasts: ForecastsSummary | None = None
    advice: Sequence[Advice] = ()
    photos: Mapping[str, Photos] = field(default_factory=dict)
    workers: int | None = 1
    _made: dict[str, Made] = field(default_factory=dict)

    def bring_up_to_date(self) -> Path:
        """
        Make what is out of date.

        Returns
        -------
        overview : Path
            The same results give the same bytes, and an unchanged page is not written again. Pages of what has left the
            campaign are removed. The state script is written only if it is missing: it may be that of a watch.

        Raises
        ------
        StoreError
            If a page cannot be written.
        """
        layout, there = self.layout, set[Path]()
        if not layout.state.is_file():
            files.write_text(layout.state, UNWATCHED)
        # The overview is written last: its change tells open pages that all are there.
        for asked in (chain(self.drawings(), self.tests()), self.specimens(), self.whole()):
            products = list(asked)
            self._made |= brought_up_to_date(products, self.catalogue, workers=self.workers)
            there |= {path for product in products for path in product.paths}
        for stale in {path for pattern in OWN for path in layout.report.parent.glob(pattern)} - there:
            files.remove(stale)
        return layout.report

    def drawings(self) -> Iterator[Product]:
        """Each specimen in each of its set-ups."""
        campaign = self.campaign
        for specimen, setup in campaign.combinations:
            shows = repr((specimen, campaign.specimens[specimen], campaign.gravity, setup, campaign.setups[setup]))
            make, place = partial(_drawing, campaign, specimen, setup), addresses.of_setup(specimen, setup)
            yield self._product(f"drawing {specimen}+{setup}", shows, {}, make, [place])

    def tests(self) -> Iterator[Product]:
        """The page of each test, with its part of the pages of all tests."""
        for name, asked in self._asked.items():
            page, results = addresses.of_test(name), results_of(self.campaign, self.campaign.tests[name])
            make, places = partial(_page, self.layout, asked), [page, addresses.of_data(page)]
            product = self._product(f"page {name}", asked.shows, self._contents(results), make, places)
            yield replace(product, keeps=True)

    def specimens(self) -> Iterator[Product]:
        """The page of each specimen."""
        campaign, models = self.campaign, models_shown(self.campaign)
        around = (campaign.title, campaign.gravity, campaign.of_interest, models)
        for name in campaign.of_interest:
            results = [ResultId(name, "specimen"), ResultId(name, "contact")]
            results += [ResultId(name, "map", model) for model in models]
            tests = {test: key for test, key in self._keys.items() if campaign.tests[test].specimen == name}
            setups = {pair: tests for pair, tests in campaign.combinations.items() if pair[0] == name}
            shows = repr((around, campaign.specimens[name], setups, [campaign.setups[setup] for _, setup in setups]))
            page, own = addresses.of_specimen(name), self._parts(tests)
            places, make = [addresses.of_data(page), page], partial(_specimen, campaign, self.layout, name, own)
            yield self._product(f"specimen-page {name}", shows, self._contents(results) | tests, make, places)

    def whole(self) -> Iterator[Product]:
        """The pages of the whole campaign, the overview last of them."""
        forecasts = self.forecasts
        optional = {addresses.ASSESSMENTS: bool(self.campaign.assessments), addresses.FORECASTS: forecasts is not None}
        places = addresses.of_campaign([page for page, is_there in optional.items() if is_there])
        foreseen = [] if forecasts is None else [forecasts.model_dump_json()]
        shows = [self.campaign.told(self.campaign), sorted(self.outdated), *foreseen, *map(repr, self.advice)]
        there = {str(path.relative_to(self.layout.processed)): path for path in self.layout.results_there()}
        contents = {name: self.catalogue.content(path) for name, path in there.items()}
        make = partial(_whole, self.campaign, self.layout, self._parts(self._asked), self.advice, places)
        yield self._product("pages", json.dumps(shows), contents | self._keys, make, places)

    def _product(
        self,
        name: str,
        shows: str,
        upstream: Mapping[str, str | None],
        make: Callable[[], Contents],
        places: Iterable[str],
    ) -> Product:
        paths = tuple(self.layout.report.parent / place for place in places)
        return Product(name, shows, upstream, self.catalogue.code(MADE_BY), make, paths)

    def _contents(self, results: Iterable[ResultId]) -> dict[str, str | None]:
        return {str(result): self.catalogue.content(self.layout.path(result)) for result in results}

    @cached_property
    def _asked(self) -> dict[str, Asked]:
        return {each.test: each for each in asked_of(self.campaign, self.layout, self.outdated, self.photos)}

    @property
    def _keys(self) -> dict[str, str]:
        return {name: self._made[f"page {name}"].key for name in self.campaign.tests}

    def _parts(self, tests: Iterable[str]) -> list[Drawn]:
        return [(self._asked[name], self._made[f"page {name}"].text) for name in tests]


def _drawing(campaign: Campaign, specimen: str, setup: str) -> Contents:
    from colonnade.figures.drawing.described import picture

    return [f"{picture(campaign, specimen, setup).svg}\n"], ""


def _page(layout: Layout, asked: Asked) -> Contents:
    from colonnade.report.build import drawn

    return drawn(layout, asked)


def _specimen(campaign: Campaign, layout: Layout, name: str, parts: Sequence[Drawn]) -> Contents:
    from colonnade.report.build import Part, seldom_collected, specimen_page

    with seldom_collected():
        return [text for _, text in specimen_page(campaign, layout, name, [Part.of(*each) for each in parts])], ""


def _whole(
    campaign: Campaign, layout: Layout, parts: Sequence[Drawn], advice: Sequence[Advice], places: Sequence[str]
) -> Contents:
    from colonnade.report.build import Part, seldom_collected, whole_pages

    with seldom_collected():
        texts = dict(whole_pages(campaign, layout, [Part.of(*each) for each in parts], advice))
    return [texts[place] for place in places], ""
