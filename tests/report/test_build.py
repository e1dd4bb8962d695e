"""The report written again: what is drawn, what is kept, and campaigns without results."""

import shutil

import pytest

from colonnade.report import addresses, build
from colonnade.report.build import rendered
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.workflow.product import Catalogue
from read_pages import Page, built, words_of, written


@pytest.fixture
def two_tests(filled_campaign, tmp_path):
    """The campaign with the results of two of its tests alone."""
    campaign, layout = filled_campaign[0], Layout(tmp_path)
    for name in ("span-2.0", "span-2.5"):
        shutil.copytree(filled_campaign[1].test(name), layout.test(name))
    return campaign, layout


def times(layout):
    return {path: path.stat().st_mtime_ns for path in layout.report.parent.rglob("*.html")}


@pytest.mark.whole
def test_the_page_of_a_specimen_is_drawn_again_only_if_what_it_shows_changed(two_tests, undrawn, monkeypatch):
    campaign, layout = two_tests
    drawn = []
    monkeypatch.setattr(build, "rendered", lambda *given, **shown: drawn.append(given[2]) or rendered(*given, **shown))

    def drawn_now(campaign=campaign):
        drawn.clear()
        built(campaign, layout)
        return [address for address in drawn if address.startswith("specimens/")]

    both = ["specimens/prism.html", "specimens/statue.html"]
    assert drawn_now() == both
    texts, before = written(layout), times(layout)
    assert drawn_now() == []
    assert (written(layout), times(layout)) == (texts, before)
    path = layout.stage("span-2.0", "compare")
    compared = files.read(path)
    compared["nrmse"] = compared["nrmse"] * 2
    files.write(compared.drop_attrs(deep=False), path, attributes={"stage": "compare"})
    assert drawn_now() == both[:1]
    files.write_failed(layout.stage("statue", "map", "linear"), "no map", attributes={"stage": "map", "key": "1"})
    assert drawn_now() == both[1:]
    files.write_failed(layout.stage("prism", "specimen"), "no e", attributes={"stage": "specimen"})
    assert drawn_now() == both[:1]
    (layout.report.parent / addresses.of_data(both[1])).unlink()
    assert drawn_now() == both[1:]
    assert drawn_now(campaign.but(title="Another")) == both
    monkeypatch.setattr(Catalogue, "code", lambda *given: "other sources")
    assert drawn_now() == both


@pytest.mark.whole
def test_outdated_results_are_pending_and_not_shown(two_tests):
    built(*two_tests, outdated={"span-2.0"})
    texts = written(two_tests[1])
    assert "pending" in words_of(texts["tests/span-2.0.html"])
    assert "<svg" not in texts["tests/span-2.0.html"]
    assert "<svg" in texts["tests/span-2.5.html"]


@pytest.mark.whole
def test_pages_of_what_is_no_longer_there_are_removed(empty_campaign, tmp_path):
    campaign, layout = empty_campaign[0], Layout(tmp_path)
    built(campaign, layout)
    folder = layout.report.parent
    strangers = [folder / place for place in ("tests/gone.html", "specimens/gone.html", "setups/gone+frame.svg")]
    own = folder / "tests" / "notes.txt"
    for path in (*strangers, own):
        path.write_text("old", encoding="utf-8")
    built(campaign, layout)
    assert not any(path.exists() for path in strangers)
    assert own.exists()
    drawn = {path.relative_to(folder).as_posix() for path in (folder / "setups").iterdir()}
    assert drawn == {addresses.of_setup(*pair) for pair in campaign.combinations}


def test_a_campaign_without_any_result_has_a_report(empty_campaign):
    built(*empty_campaign)
    texts = written(empty_campaign[1])
    words = words_of(texts["index.html"])
    assert "9 tests: 0 done, none failed, 9 not finished." in words
    assert "prism – not yet known 0.9485" in words
    assert not [address for address, text in texts.items() if "<svg" in text]
    assert "No result is stored yet." in words_of(texts["methods.html"])


def test_a_damaged_result_is_told_as_a_failure(empty_campaign, tmp_path):
    campaign, layout = empty_campaign[0], Layout(tmp_path)
    layout.test("free-01").mkdir(parents=True)
    layout.stage("free-01", "rocking").write_bytes(b"no NetCDF")
    text = built(campaign, layout).read_text(encoding="utf-8")
    assert "rocking:</span>" in text[text.index('id="failures"') :]
    assert "1 failed" in Page(text).words
