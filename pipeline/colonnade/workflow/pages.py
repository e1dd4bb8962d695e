"""The report as products: drawings, photos, the page of each test and specimen, the pages of the whole campaign."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from io import BytesIO
from itertools import chain
from pathlib import Path

from colonnade.campaign import Campaign
from colonnade.campaign.forms.foreseen import ForecastsSummary
from colonnade.campaign.syntax.names import inside
from colonnade.errors import ReadError
from colonnade.findings import Finding, warning
from colonnade.readers.photo import read_photo
from colonnade.report import addresses
from colonnade.report.addresses import UNWATCHED
from colonnade.report.asked import KIND, Asked, Photo, address_of, asked_of
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.records.advice import Advice
from colonnade.store.results import ResultId, models_shown, results_of
from colonnade.workflow.graph import Graph
from colonnade.workflow.product import Contents, Made, Product, brought_up_to_date

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
    graph : Graph
    outdated : collection of str
        Tests whose stored results are out of date: they are pending, and not shown.
    forecasts : ForecastsSummary or None
        As in the summary: the hash of each forecast is in it.
    advice : sequence of Advice
        On the next tests.
    photos : mapping of str to sequence of Photo
        Of each test, as they are in the report.
    workers : int or None
        Processes in which pages are drawn; None for one a core.
    """

    graph: Graph
    outdated: Collection[str] = ()
    forecasts: ForecastsSummary | None = None
    advice: Sequence[Advice] = ()
    photos: Mapping[str, Sequence[Photo]] = field(default_factory=dict)
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
        layout, there = self.graph.layout, set[Path]()
        if not layout.state.is_file():
            files.write_text(layout.state, UNWATCHED)
        # The overview is written last: its change tells open pages that all are there.
        for in_order, *asked in ((False, self._drawings(), self._tests()), (True, self._specimens(), self._whole())):
            products = list(chain(*asked))
            self._made |= brought_up_to_date(products, self.graph.catalogue, workers=self.workers, in_order=in_order)
            there |= {path for product in products for path in product.paths}
        for stale in {path for pattern in OWN for path in layout.report.parent.glob(pattern)} - there:
            files.remove(stale)
        return layout.report

    def _drawings(self) -> Iterator[Product]:
        """Each specimen in each of its set-ups."""
        campaign = self.graph.campaign
        for specimen, setup in campaign.combinations:
            shows = repr((specimen, campaign.specimens[specimen], campaign.gravity, setup, campaign.setups[setup]))
            make, place = partial(_drawing, campaign, specimen, setup), addresses.of_setup(specimen, setup)
            yield self._product(f"drawing {specimen}+{setup}", shows, {}, make, [place])

    def _tests(self) -> Iterator[Product]:
        """The page of each test, with its part of the pages of all tests."""
        for name, asked in self._asked.items():
            page, results = addresses.of_test(name), results_of(self.graph.campaign, self.graph.campaign.tests[name])
            make, places = partial(_page, self.graph.layout, asked), [page, addresses.of_data(page)]
            yield self._product(f"page {name}", asked.shows, self._contents(results), make, places)

    def _specimens(self) -> Iterator[Product]:
        """The page of each specimen."""
        campaign, models = self.graph.campaign, models_shown(self.graph.campaign)
        around = (campaign.title, campaign.gravity, campaign.of_interest, models)
        for name in campaign.of_interest:
            results = [ResultId(name, "specimen"), ResultId(name, "contact")]
            results += [ResultId(name, "map", model) for model in models]
            tests = {test: key for test, key in self._keys.items() if campaign.tests[test].specimen == name}
            setups = {pair: tests for pair, tests in campaign.combinations.items() if pair[0] == name}
            shows = repr((around, campaign.specimens[name], setups, [campaign.setups[setup] for _, setup in setups]))
            page = addresses.of_specimen(name)
            places = [addresses.of_data(page), page]
            make = partial(_pages, campaign, self.graph.layout, self._parts(tests), places, specimen=name)
            yield self._product(f"specimen-page {name}", shows, self._contents(results) | tests, make, places)

    def _whole(self) -> Iterator[Product]:
        """The pages of the whole campaign, the overview last of them."""
        campaign, layout, forecasts = self.graph.campaign, self.graph.layout, self.forecasts
        optional = {addresses.ASSESSMENTS: bool(campaign.assessments), addresses.FORECASTS: forecasts is not None}
        places = addresses.of_campaign([page for page, is_there in optional.items() if is_there])
        foreseen = forecasts.model_dump_json() if forecasts else None
        shows = [campaign.told(campaign), sorted(self.outdated), foreseen, *map(repr, self.advice)]
        content = self.graph.catalogue.content
        contents = {str(path.relative_to(layout.processed)): content(path) for path in layout.results_there()}
        make = partial(_pages, campaign, layout, self._parts(self._asked), places, advice=self.advice)
        yield self._product("pages", json.dumps(shows), contents | self._keys, make, places)

    def _product(
        self,
        name: str,
        shows: str,
        upstream: Mapping[str, str | None],
        make: Callable[[], Contents],
        places: Iterable[str],
    ) -> Product:
        paths = tuple(self.graph.layout.report.parent / place for place in places)
        return Product(name, shows, upstream, self.graph.catalogue.code(MADE_BY), make, paths)

    def _contents(self, results: Iterable[ResultId]) -> dict[str, str | None]:
        return {str(result): self.graph.catalogue.content(self.graph.layout.path(result)) for result in results}

    @cached_property
    def _asked(self) -> dict[str, Asked]:
        asked = asked_of(self.graph.campaign, self.graph.layout, self.outdated, self.photos)
        return {each.test: each for each in asked}

    @property
    def _keys(self) -> dict[str, str]:
        return {name: self._made[f"page {name}"].key for name in self._asked}

    def _parts(self, tests: Iterable[str]) -> list[Drawn]:
        return [(self._asked[name], self._made[f"page {name}"].text) for name in tests]


def _drawing(campaign: Campaign, specimen: str, setup: str) -> Contents:
    from colonnade.figures.drawing.described import picture

    return [f"{picture(campaign, specimen, setup).svg}\n"], ""


def _page(layout: Layout, asked: Asked) -> Contents:
    from colonnade.report.build import drawn

    return drawn(layout, asked)


def _pages(
    campaign: Campaign,
    layout: Layout,
    parts: Sequence[Drawn],
    places: Sequence[str],
    *,
    specimen: str = "",
    advice: Sequence[Advice] = (),
) -> Contents:
    """Give the page of a specimen, or those of the whole campaign."""
    from colonnade.report.build import Part, seldom_collected, specimen_page, whole_pages

    with seldom_collected():
        own = [Part.of(*each) for each in parts]
        is_whole = not specimen
        pages = (
            whole_pages(campaign, layout, own, advice) if is_whole else specimen_page(campaign, layout, specimen, own)
        )
        texts = dict(pages)
    return [texts[place] for place in places], ""


QUALITY = 85
"""Of the JPEG files of photos."""

PHOTOS_BY = ("colonnade.readers.photo", __name__)
"""What the photos of the report are made by."""


def photos_shown(graph: Graph) -> tuple[dict[str, list[Photo]], list[Finding]]:
    """
    Write the photos of all tests into the report, where they are not there already, and remove others.

    Parameters
    ----------
    graph : Graph
        Its catalogue spares decoding photos that are as they were.

    Returns
    -------
    photos : dict of str to list of Photo
        Those of each test that can be shown.
    unshown : list of Finding
        A warning of each photo that cannot be shown.

    Raises
    ------
    StoreError
        If a photo cannot be written.
    """
    source, folder, code = graph.campaign.folder, graph.layout.report.parent, graph.catalogue.code(PHOTOS_BY)
    photos, unshown, shown = dict[str, list[Photo]](), list[Finding](), set[Path]()
    for name, test in graph.campaign.tests.items():
        for number, written in enumerate(test.photos, start=1):
            photo = Photo(address_of(name, number), f"Photo {number} of test {name}", written)
            path, upstream = folder / photo.address, {written: graph.hashed(source / written).sha256}
            product = Product(photo.address, "", upstream, code, partial(_copied, source, written), (path,))
            if reason := brought_up_to_date([product], graph.catalogue)[photo.address].reason:
                said = warning(KIND, f"tests[{name}].photos: {reason}")
                unshown.append(replace(said, about=f"tests.{name}"))
            else:
                photos.setdefault(name, []).append(photo)
                shown.add(path)
    for stale in set(folder.glob("photos/*.jpg")) - shown:
        files.remove(stale)
    return photos, unshown


def _copied(folder: Path, written: str) -> Contents:
    """Read a photo, and write its pixels as JPEG with nothing else in it; the same pixels give the same bytes."""
    from PIL import Image

    try:
        inside(folder, written)
    except ValueError as error:
        raise ReadError(str(error)) from None
    copy = BytesIO()
    pixels = read_photo(folder / written, within=folder)
    Image.fromarray(pixels).save(copy, "JPEG", quality=QUALITY, optimize=True)
    return [copy.getvalue()], ""
