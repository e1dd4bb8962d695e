"""Where the pages are."""

from colonnade.report.addresses import addresses, of_data, scripts_of


def test_every_page_has_its_address_and_the_overview_comes_last(filled_campaign):
    single, whole = addresses(filled_campaign[0], [])
    assert "tests/span-2.0.html" in single
    assert "specimens/statue.html" in single
    assert whole[-1] == "index.html"
    assert "data/span-2.0.js" in single
    assert "scripts/colonnade.js" in whole
    assert len({*single, *whole}) == len(single) + len(whole) == 2 * (9 + 2 + 4) + 2 + 3


def test_data_of_pages_of_one_name_are_apart():
    pages = ["index.html", "tests/index.html", "specimens/index.html"]
    assert [of_data(page) for page in pages] == [
        "data/pages/index.js",
        "data/index.js",
        "data/pages/specimens/index.js",
    ]


def test_a_page_loads_its_data_last_and_the_plots_only_if_it_has_any():
    assert scripts_of("methods.html") == ["scripts/colonnade.js", "state.js", "data/pages/methods.js"]
    assert scripts_of("tests/a.html")[-3:] == ["scripts/colonnade.js", "state.js", "data/a.js"]
