"""The PDF: the same bytes anywhere, nothing of a campaign read as markup, and no file but the document's own."""

import json
import shutil
import subprocess
import sys
from io import BytesIO

import pytest
from PIL import Image

from colonnade.campaign import load
from colonnade.errors import StoreError
from colonnade.report.paper import typesetting
from colonnade.report.paper.typesetting import document_of, pdf_of, prepared, typeset

from .conftest import HOSTILE

TYPESET = """
import sys
from pathlib import Path
from colonnade.campaign import load
from colonnade.errors import StoreError
from colonnade.report.paper.typesetting import pdf_of
folder = Path(sys.argv[1])
sys.stdout.buffer.write(pdf_of(load(folder), folder / "report"))
"""


def texts_in(content):
    """Give the text of what a query found, as Typst will show it."""
    if isinstance(content, list):
        return "".join(map(texts_in, content))
    if not isinstance(content, dict):
        return ""
    if content.get("func") in ("space", "linebreak"):
        return " "
    return content["text"] if content.get("func") == "text" else texts_in(list(content.values()))


@pytest.mark.whole
def test_the_same_report_gives_the_same_bytes_in_another_process_and_folder(campaign, folder, tmp_path_factory):
    elsewhere = tmp_path_factory.mktemp("elsewhere") / "moved"
    shutil.copytree(campaign.folder, elsewhere)
    told = subprocess.run([sys.executable, "-c", TYPESET, elsewhere], check=True, capture_output=True)
    here = pdf_of(campaign, folder)
    assert here.startswith(b"%PDF-")
    assert told.stdout == here


def test_what_people_wrote_is_shown_as_text(campaign, folder):
    with prepared(document_of(campaign, folder)) as compiler:
        headings = [texts_in(each["body"]) for each in json.loads(compiler.query("heading"))]
        paragraphs = [texts_in(each["body"]) for each in json.loads(compiler.query("par"))]
    assert headings[1:5] == ["Summary", "Specimen prism", "Spans", "El Centro"]
    assert paragraphs.count(HOSTILE) == 3, "on the cover and in both tests"


@pytest.mark.parametrize(
    "name", ["]", "#", '"', "\\", "$", "<a>", "@a", "*", "// x", "/* x", '#include "x"', "https://a.b"]
)
def test_no_title_breaks_the_document(campaign, folder, name):
    text = campaign.path.read_text(encoding="utf-8").replace(f"'{HOSTILE}'", json.dumps(name))
    campaign.path.write_text(text, encoding="utf-8")
    document = document_of(load(campaign.folder), folder)
    assert document.data["title"] == name
    assert typeset(document)[0].startswith(b"%PDF-")


def test_the_compiler_sees_only_the_files_of_the_document(campaign, folder):
    with prepared(document_of(campaign, folder)) as compiler:
        for path in (str(campaign.path), "/etc/passwd", "../x"):
            with pytest.raises(Exception, match=r"not found|escape"):
                compiler.compile(f"#read({json.dumps(path)})".encode())
        assert compiler.compile(b'#json("/report.json").title')


def test_pages_are_whole_as_pictures(campaign, folder):
    pages = [Image.open(BytesIO(page)) for page in typeset(document_of(campaign, folder), "png")]
    assert len(pages) == 8  # cover, contents, summary, specimen, Spans, methods, two tests
    for page in pages:
        darkest = min(low for low, _ in page.convert("RGB").getextrema())
        assert darkest < 100, "the page is not empty"
        assert page.convert("L").crop((0, 0, page.width, 30)).getextrema() == (255, 255), "nothing runs off its top"
        right = page.convert("L").crop((page.width - 30, 0, page.width, page.height))
        assert right.getextrema() == (255, 255), "nothing runs off its side"


def test_a_character_that_no_svg_may_have_does_not_stop_the_pdf(campaign, folder):
    page = folder / "tests" / "free-01.html"
    text = page.read_text(encoding="utf-8")
    page.write_text(text.replace("falls</desc>", "falls\x01\uffff</desc>"), encoding="utf-8")
    assert "\x01" in page.read_text(encoding="utf-8")
    assert pdf_of(campaign, folder).startswith(b"%PDF-")


def test_a_page_that_cannot_be_typeset_is_a_sentence(campaign, folder):
    page = folder / "tests" / "free-01.html"
    page.write_text('<main><section id="found"><svg>broken</section></svg></main>', encoding="utf-8")
    with pytest.raises(StoreError, match="cannot be typeset"):
        pdf_of(campaign, folder)


def test_a_full_disk_is_a_sentence(campaign, folder, monkeypatch):
    def full(*_, **__):
        raise OSError(28, "No space left on device", "report.json")

    monkeypatch.setattr(typesetting, "TemporaryDirectory", full)
    with pytest.raises(StoreError, match="No space left on device"):
        pdf_of(campaign, folder)
