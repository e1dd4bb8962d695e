"""What is taken from a page: its words as data, its pictures by name, and nothing that only a screen can use."""

from html import escape

import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.report.paper.content import Gatherer, as_data
from every import every


@pytest.fixture(scope="module")
def taken(tmp_path_factory):
    """Head and main part of a page as data, and who gathered them: `taken("<p>a</p>", head="<p>b</p>")`."""
    folder = tmp_path_factory.mktemp("report")
    (folder / "photos").mkdir()
    (folder / "photos" / "a-1.jpg").write_bytes(b"a photo")

    def take(inside, head=""):
        page = f"<html><body><header>{head}</header><main>{inside}</main></body></html>"
        (folder / "a.html").write_text(page, encoding="utf-8")
        gatherer = Gatherer(folder, {"b.html"})
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


def test_elements_keep_their_attributes_and_what_is_in_them(taken):
    (_, (found,)), _ = taken('<p class="soft">a\n <b>b</b> c<br>d</p>')
    bold, line = {"tag": "b", "in": ["b"]}, {"tag": "br", "in": []}
    assert found == {"tag": "p", "class": "soft", "in": ["a ", bold, " c", line, "d"]}


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
