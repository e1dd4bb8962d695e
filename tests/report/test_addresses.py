"""Where the pages are."""

from colonnade.report.addresses import addresses


def test_every_page_has_its_address_and_the_overview_comes_last(filled_campaign):
    tests, others = addresses(filled_campaign[0])
    assert "tests/span-2.0.html" in tests
    assert "specimens/statue.html" in others
    assert others[-1] == "index.html"
    assert "data/span-2.0.js" in tests
    assert "scripts/colonnade.js" in others
    assert len({*tests, *others}) == len(tests) + len(others) == 2 * 9 + 2 + 4 + 3
