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
from colonnade.interruption import expect_none
from colonnade.readers.files import sha256_of
from colonnade.readers.photo import read_photo
from colonnade.report import addresses
from colonnade.report.addresses import UNWATCHED
from colonnade.report.asked import KIND, Asked, Photo, Photos, address_of, asked_of
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


QUALITY = 85
"""Of the JPEG files of photos."""

PHOTOS_BY = ("colonnade.readers.photo", __name__)
"""What the photos of the report are made by."""


def photos_shown(campaign: Campaign, layout: Layout, catalogue: Catalogue) -> tuple[dict[str, Photos], list[Finding]]:
    """
    Write the photos of all tests into the report, where they are not there already, and remove others.

    Parameters
    ----------
    campaign : Campaign
    layout : Layout
    catalogue : Catalogue
        Spares decoding photos that are as they were.

    Returns
    -------
    photos : dict of str to Photos
        Those of each test that has any.
    unshown : list of Finding
        A warning of each photo that cannot be shown.

    Raises
    ------
    StoreError
        If a photo cannot be written.
    """
    folder, code = layout.report.parent, catalogue.code(PHOTOS_BY)
    products = [
        Product(address, "", _upstream(campaign, written, catalogue), code, make, (folder / address,))
        for test, number, written in _photos(campaign)
        for address, make in [(address_of(test, number), partial(_copied, campaign.folder, written))]
    ]
    made = brought_up_to_date(products, catalogue)
    for stale in set(folder.glob("photos/*.jpg")) - {path for each in products for path in each.paths}:
        files.remove(stale)
    found, photos = [], dict[str, Photos]()
    for test, number, written in _photos(campaign):
        before, address = photos.get(test, Photos()), address_of(test, number)
        if reason := made[address].reason:
            files.remove(folder / address)
            found.append(finding_of(test, reason))
            photos[test] = replace(before, problems=(*before.problems, found[-1].text))
        else:
            shown = Photo(address, f"Photo {number} of test {test}", written)
            photos[test] = replace(before, shown=(*before.shown, shown))
    return photos, found


def unshown_photos(campaign: Campaign) -> list[Finding]:
    """Look at the photos of all tests, and give a warning of each that cannot be shown; nothing is written."""
    found = []
    for test, _, written in _photos(campaign):
        expect_none()
        try:
            read_photo(_source(campaign.folder, written), within=campaign.folder)
        except ReadError as error:
            found.append(finding_of(test, str(error)))
    return found


def finding_of(test: str, reason: str) -> Finding:
    """Make a finding of a photo's refusal."""
    return replace(warning(KIND, f"tests[{test}].photos: {reason}"), about=f"tests.{test}")


def _photos(campaign: Campaign) -> Iterator[tuple[str, int, str]]:
    for name, test in campaign.tests.items():
        for number, written in enumerate(test.photos, start=1):
            yield name, number, written


def _source(folder: Path, written: str) -> Path:
    try:
        inside(folder, written)
    except ValueError as error:
        raise ReadError(str(error)) from None
    return folder / written


def _upstream(campaign: Campaign, written: str, catalogue: Catalogue) -> dict[str, str | None]:
    """Hash a photo; one that is not there or lies outside is not opened, and refused when it is read."""
    path = campaign.folder / written
    is_inside = path.resolve().is_relative_to(campaign.folder)
    found = catalogue.entry("raw", path, sha256_of) if is_inside else None
    return {written: found[1] if found else None}


def _copied(folder: Path, written: str) -> Contents:
    """Read a photo, and write its pixels as JPEG with nothing else in it; the same pixels give the same bytes."""
    from PIL import Image

    copy = BytesIO()
    pixels = read_photo(_source(folder, written), within=folder)
    Image.fromarray(pixels).save(copy, "JPEG", quality=QUALITY, optimize=True)
    return [copy.getvalue()], ""
