"""The report on paper: what is taken from a page, the document of a report written by hand, and its PDF."""

import json
import shutil
import subprocess
import sys
from hashlib import sha256
from html import escape
from io import BytesIO

import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure
from PIL import Image

from colonnade.campaign import load
from colonnade.errors import StoreError
from colonnade.figures.files.output import to_svg
from colonnade.report import paper
from colonnade.report.paper import Document, as_data, document_of, pdf_of, prepared
from every import every
from prism import SPECIMEN, entry


@pytest.fixture(scope="module")
def taken(tmp_path_factory):
    """Head and main part of a page as data, and who gathered them: `taken("<p>a</p>", head="<p>b</p>")`."""
    folder = tmp_path_factory.mktemp("report")
    (folder / "photos").mkdir()
    (folder / "photos" / "a-1.jpg").write_bytes(b"a photo")

    def take(inside, head=""):
        page = f"<html><body><header>{head}</header><main>{inside}</main></body></html>"
        (folder / "a.html").write_text(page, encoding="utf-8")
        gatherer = Document(folder, {"b.html"})
        return [list(map(as_data, part)) for part in gatherer.page("a.html")], gatherer

    return take


def texts(element):
    """Give the texts in an element, in their order."""
    return [text for part in element["in"] for text in ([part] if isinstance(part, str) else texts(part))]


@given(st.text(st.characters(codec="utf-8", exclude_categories=["Cc", "Cn"]), max_size=60))
def test_what_people_wrote_stays_text(taken, written):
    (_, (found,)), _ = taken(f"<p>begin {escape(written)} end</p>")
    assert found.keys() == {"tag", "in"}
    assert all(isinstance(part, str) for part in found["in"])
    assert "".join(found["in"]).split() == f"begin {written} end".split()


def test_the_head_gives_its_lines_but_not_the_way_to_other_pages(taken):
    head = "<nav>x</nav><p class='soft above'>title</p><h1>a</h1><p>Sine test</p><p class='steps'>next</p>"
    (found, _), _ = taken("", head)
    assert found == [{"tag": "p", "in": ["Sine test"]}]


def test_links_lead_to_pages_of_the_document_or_are_none(taken):
    (_, (found,)), _ = taken('<p><a href="b.html#e">b</a> and <a href="c.html">c</a></p>')
    assert found["in"] == [{"tag": "a", "href": "b.html", "in": ["b"]}, " and c"]


def test_figures_are_numbered_and_described(taken):
    (_, (drawn, photo)), gatherer = taken(
        "<figure><svg><desc>a &lt; b</desc><path/></svg><figcaption>one</figcaption></figure>"
        '<figure><img src="photos/a-1.jpg" alt="a photo"></figure><figure><img src="data:x"></figure>'
    )
    picture = {"tag": "img", "src": "figure-1.svg", "alt": "a < b", "in": []}
    assert drawn["in"] == [picture, {"tag": "figcaption", "in": ["one"]}]
    assert gatherer.pictures == {"figure-1.svg": "<svg><desc>a &lt; b</desc><path/></svg>"}
    assert photo["in"] == [{"tag": "img", "src": "photos-a-1.jpg", "alt": "a photo", "in": []}]
    assert list(gatherer.files) == ["photos-a-1.jpg"]


@every(
    "screen",
    [
        *("<script>x</script>", "<style>x</style>", "<nav>x</nav>", "<details><p>x</p></details>"),
        *("<button>x</button>", "<select><option>x</option></select>", '<p data-paper="no">x</p>', "<p hidden>x</p>"),
        *("<div hidden><p>x</p></div>", '<p class="steps">x</p>', "<!-- x -->"),
        '<table><tr><td>a</td><td data-paper="no">x</td></tr></table>',
    ],
)
def test_what_only_a_screen_can_use_is_left_out(taken, screen):
    (_, found), _ = taken(f"<p>before</p>{screen}<p>after</p>")
    assert "x" not in str([texts(each) for each in found])
    assert [texts(found[0]), texts(found[-1])] == [["before"], ["after"]]


def test_nothing_is_lost_of_a_page_with_a_very_long_text(taken):
    (_, (said, after)), _ = taken(f"<p>{'x' * 11_000_000}</p><p>after</p>")
    assert len(said["in"][0]) == 11_000_000
    assert after["in"] == ["after"]


HOSTILE = '#read("/etc/passwd") $x^2$ @all *bold* <label> \\ _emph_ `raw` ] " /* // no comment'
"""A title that Typst would act on if it were markup."""

CAMPAIGN = f"""
schema = 1
campaign = "two"
title = '{HOSTILE}'
facility = "Ευστάθεια & Söhne"

[specimens]
{SPECIMEN}

[setups.frame.channels]
top = {{column = 1, quantity = "other"}}
"""
TESTS = {"free-01": ("2013-04-26", "M. Rossi"), "free-02": ("2013-04-29", "K. #Papas")}


def page(title, inside):
    return f"<html><body><header><h1>{title}</h1></header><main>{inside}</main></body></html>"


@pytest.fixture
def campaign(tmp_path):
    tests = (entry(name, "other", f"date = {day}", f'operator = "{who}"') for name, (day, who) in TESTS.items())
    (tmp_path / "campaign.toml").write_text(CAMPAIGN + "".join(tests), encoding="utf-8")
    return load(tmp_path)


@pytest.fixture
def folder(tmp_path):
    """The pages of the report."""
    figure = Figure(figsize=(4, 2))
    figure.add_subplot().plot([0, 1], [1, 0], label="θ/α")
    svg = to_svg(figure, identity="f", title="t", description="falls")
    folder = tmp_path / "report"
    for name in ("tests", "specimens", "photos"):
        (folder / name).mkdir(parents=True)
    image = BytesIO()
    Image.new("RGB", (40, 30), "navy").save(image, "JPEG")
    (folder / "photos" / "free-02-1.jpg").write_bytes(image.getvalue())
    photo = '<section id="photos"><figure><img src="../photos/free-02-1.jpg" alt="it lies"></figure></section>'
    for name in TESTS:
        found = f'<section id="found"><h2>What was found</h2><p>{escape(HOSTILE)}</p><figure>{svg}</figure></section>'
        setup = f'<section id="setup" data-paper="no"><p>not on paper</p><figure>{svg}</figure></section>'
        inside = found + setup + (photo if name == "free-02" else "")
        (folder / "tests" / f"{name}.html").write_text(page(name, inside), encoding="utf-8")
    spans = '<section id="spans"><h2>Spans</h2><h3>El Centro</h3><p>first</p><h3>Kobe</h3><p>second</p></section>'
    listed = '<section id="tests" data-paper="no"><table><tr><td>long</td></tr></table></section>'
    told = (
        '<section id="summary"><h2>Summary</h2><p>See <a href="tests/free-01.html">it</a>, <a href="x.html">x</a>.</p>'
    )
    (folder / "index.html").write_text(page("Overview", f"{told}</section>{listed}{spans}"), encoding="utf-8")
    for address in ("specimens/prism.html", "methods.html"):
        table = '<table><thead><tr><th>a</th></tr></thead><tbody><tr><td class="number">1</td></tr></tbody></table>'
        (folder / address).write_text(page(address, f'<section id="text">{table}</section>'), encoding="utf-8")
    return folder


def test_chapters_are_the_summary_specimens_spans_and_methods_and_tests_its_appendix(campaign, folder):
    data = document_of(campaign, folder).data
    titles = [chapter["title"] for chapter in data["chapters"]]
    assert titles == ["Summary", "Specimen prism", "Spans", "Methods"]
    assert [sheet["title"] for sheet in data["appendix"]] == ["free-01", "free-02"]
    # Without its appendix nothing leads to a test.
    data = document_of(campaign, folder, appendix=False).data
    assert data["appendix"] == []
    assert "tests/free-01.html" not in str(data)


def test_the_cover_says_who_where_when_and_by_which_campaign_file(campaign, folder):
    data = document_of(campaign, folder).data
    assert data["title"] == HOSTILE
    digest = sha256(campaign.path.read_bytes()).hexdigest()
    assert data["facts"].pop() == ("campaign file", f"campaign.toml, SHA-256 {digest[:16]}…")
    assert data["facts"] == [
        ("facility", "Ευστάθεια & Söhne"),
        ("tested", "2013-04-26 to 2013-04-29"),
        ("operators", "M. Rossi, K. #Papas"),
    ]
    assert data["cover"] == "photos-free-02-1.jpg"


def test_no_picture_is_taken_from_outside_the_report(campaign, folder, tmp_path):
    (tmp_path / "secret.jpg").write_bytes(b"secret")
    (folder / "photos" / "link.jpg").symlink_to(tmp_path / "secret.jpg")
    page = folder / "tests" / "free-02.html"
    for source in (
        "../../secret.jpg",
        "../index.html",
        "../photos/../../secret.jpg",
        "../photos/missing.jpg",
        "../photos/link.jpg",
        "/etc/passwd",
    ):
        page.write_text(f'<main><section id="photos"><img src="{source}" alt=""></section></main>', encoding="utf-8")
        document = document_of(campaign, folder)
        assert document.files == {}
        assert document.data["cover"] is None


TYPESET = """
import sys
from pathlib import Path
from colonnade.campaign import load
from colonnade.report.paper import pdf_of
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


def test_the_compiler_sees_only_the_files_of_the_document(campaign, folder):
    with prepared(document_of(campaign, folder)) as compiler:
        for path in (str(campaign.path), "/etc/passwd", "../x"):
            with pytest.raises(Exception, match=r"not found|escape"):
                compiler.compile(f"#read({json.dumps(path)})".encode())
        assert compiler.compile(b'#json("/report.json").title')


def test_pages_are_whole_as_pictures(campaign, folder):
    with prepared(document_of(campaign, folder)) as compiler:
        pages = [Image.open(BytesIO(page)) for page in compiler.compile(format="png", ppi=80)]
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

    monkeypatch.setattr(paper, "TemporaryDirectory", full)
    with pytest.raises(StoreError, match="No space left on device"):
        pdf_of(campaign, folder)
