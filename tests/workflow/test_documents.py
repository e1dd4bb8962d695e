"""The report as one file: typeset once, again only when what it shows changed, and refused without a report."""

import shutil
import zipfile

import pytest

from colonnade.campaign import load
from colonnade.errors import CampaignError, StoreError
from colonnade.report.addresses import state_script
from colonnade.store.layout import Layout
from colonnade.store.provenance import stamped
from colonnade.workflow.documents import chosen, draw, write_bundle, write_pdf
from every import every


@pytest.fixture(scope="module")
def folder(undisturbed, tmp_path_factory):
    """The small campaign with its report, without raw files."""
    folder = tmp_path_factory.mktemp("documents") / "small"
    return shutil.copytree(undisturbed.folder, folder, ignore=shutil.ignore_patterns("raw"))


def pdf_of(folder, **options):
    return write_pdf(load(folder), Layout(folder), **options)


def bundle_of(folder, place):
    return write_bundle(load(folder), Layout(folder), place / "all.zip")


@pytest.fixture(scope="module")
def pdf(folder):
    return pdf_of(folder)


def test_it_is_typeset_again_if_a_page_changed_or_it_was_altered_and_bundled_if_it_shows_the_pages(
    folder, pdf, tmp_path
):
    before, whole = pdf.stat(), pdf.read_bytes()
    assert whole.startswith(b"%PDF-")
    pdf_of(folder)
    assert pdf.stat() == before
    pdf.write_bytes(whole[:1000] + whole[2000:])
    assert pdf_of(folder).read_bytes() == whole
    page = folder / "report" / "methods.html"
    text = page.read_text(encoding="utf-8")
    page.write_bytes(stamped(text.encode(), "abc", ".html"))
    with zipfile.ZipFile(bundle_of(folder, tmp_path)) as archive:
        assert "report/report.pdf" not in archive.namelist()
    pdf_of(folder)
    assert pdf.stat().st_mtime_ns > before.st_mtime_ns
    page.write_text(text, encoding="utf-8")


def test_one_without_its_appendix_takes_its_place_and_is_bundled(folder, pdf, tmp_path):
    whole = pdf_of(folder).read_bytes()
    assert len(pdf_of(folder, appendix=False).read_bytes()) < len(whole)
    with zipfile.ZipFile(bundle_of(folder, tmp_path)) as archive:
        assert "report/report.pdf" in archive.namelist()
    assert pdf_of(folder).read_bytes() == whole


def test_the_bundle_holds_the_whole_report_that_nobody_watches(folder, pdf, tmp_path):
    pdf_of(folder)
    pages = {path for path in (folder / "report").rglob("*") if path.is_file()}
    foreign, state = (folder / "report" / name for name in ("tests/notes.html", "state.js"))
    foreign.write_text("put here by somebody", encoding="utf-8")
    unwatched = state.read_bytes()
    state.write_text(state_script(is_watched=True, written=1.7e9, shown="1", line="free-01: rocking"), encoding="utf-8")
    with zipfile.ZipFile(bundle_of(folder, tmp_path)) as archive:
        names = set(archive.namelist())
        assert archive.read("report/state.js") == unwatched
    state.write_bytes(unwatched)
    foreign.unlink()
    assert names == {path.relative_to(folder).as_posix() for path in pages}
    assert {"report/index.html", "report/report.pdf"} <= names


@pytest.mark.parametrize("write", [pdf_of, lambda folder: bundle_of(folder, folder)])
def test_without_a_report_there_is_nothing_to_take_along(folder, tmp_path, write):
    shutil.copy(folder / "campaign.toml", tmp_path)
    with pytest.raises(StoreError, match="report not found"):
        write(tmp_path)
    assert not (tmp_path / "all.zip").exists()


SUBJECTS = {"span-2.0": ("angle", "test"), "prism": ("impacts", "specimen"), "free-01": ("impacts", "test")}


@every(("subject", "expected"), (SUBJECTS | {None: ("agreement", "campaign")}).items())
def test_a_figure_is_of_what_its_subject_is(filled_campaign, subject, expected):
    entry, found = chosen(filled_campaign[0], expected[0], subject)
    assert ((entry.name, entry.of), found) == (expected, subject or "")


def test_with_one_specimen_alone_nobody_has_to_name_it(empty_campaign):
    campaign = empty_campaign[0]
    alone = campaign.but(specimens={"prism": campaign.specimens["prism"]})
    entry, subject = chosen(alone, "estimators", None)
    assert (entry.of, subject) == ("specimen", "prism")


def test_before_any_run_it_says_to_run_first(empty_campaign, tmp_path):
    fresh = tmp_path / "fresh"
    shutil.copytree(empty_campaign[1].folder, fresh, ignore=shutil.ignore_patterns("processed", "report"))
    with pytest.raises(CampaignError, match="Nothing has been run yet; run `colonnade run` first"):
        draw(load(fresh), *chosen(load(fresh), "angle", "span-2.0"), None)
