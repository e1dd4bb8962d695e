"""What is taken from a page: its words as data, its figures by number, and nothing that only a screen can use."""

from html import escape

from hypothesis import given
from hypothesis import strategies as st

from colonnade.report.paper.content import Page
from every import every


def blocks_of(inside):
    return Page(f"<main><section id='all'>{inside}</section></main>").sections().get("all", [])


@given(st.text(st.characters(codec="utf-8", exclude_characters="\r\0"), max_size=60))
def test_what_people_wrote_stays_text(written):
    (block, *others) = blocks_of(f"<p>begin {escape(written)} end</p>")
    assert not others
    assert all(isinstance(part, str) for part in block["in"])
    assert "".join(block["in"]).split() == f"begin {written} end".split()


def test_sections_are_found_by_their_ids_and_what_is_before_them_has_none():
    page = Page("<header><h1>a</h1></header><main><p>first</p><section id='found'><h2>Found</h2></section></main>")
    assert page.sections() == {
        "": [{"is": "paragraph", "soft": False, "in": ["first"]}],
        "found": [{"is": "heading", "depth": 1, "in": ["Found"]}],
    }


def test_the_head_gives_its_lines_but_not_the_way_to_other_pages():
    page = Page(
        "<header><nav><a href='index.html'>Overview</a></nav><p class='soft above'>title</p><h1>a</h1>"
        "<p>Sine test of <a href='../specimens/prism.html'>prism</a></p><p class='steps'>next</p></header><main></main>"
    )
    link = {"is": "link", "to": "../specimens/prism.html", "in": ["prism"]}
    assert page.below_title() == [{"is": "paragraph", "soft": False, "in": ["Sine test of ", link]}]


def test_a_table_keeps_its_spans_and_where_numbers_are():
    (table,) = blocks_of(
        '<div class="scroll"><table><caption> <b>both</b> </caption>'
        '<thead><tr><th rowspan="2">a</th><th colspan="2">b</th></tr>'
        "<tr><th>c</th><th>d</th></tr></thead><tbody>"
        '<tr><td class="wide">x<br>y</td><td class="number">1</td><td></td></tr></tbody></table></div>'
    )
    assert (table["columns"], len(table["head"]), len(table["body"])) == (3, 2, 1)
    assert table["caption"] == [{"is": "strong", "in": ["both"]}]
    assert [(cell["columns"], cell["rows"]) for cell in table["head"][0]] == [(1, 2), (2, 1)]
    wide, number, empty = table["body"][0]
    assert (wide["wide"], wide["number"], number["number"], empty["in"]) == (True, False, True, [])
    assert wide["in"] == [{"is": "paragraph", "in": ["x", {"is": "break"}, "y"]}]


def test_lists_facts_and_boxes_keep_their_parts():
    listed, facts, box = blocks_of(
        "<ol><li>one</li><li>two <strong>three</strong></li></ol><dl><dt>e</dt><dd>0.9</dd></dl>"
        '<div class="failure"><p>gone</p></div>'
    )
    assert listed["numbered"]
    assert listed["items"][1][0]["in"] == ["two ", {"is": "strong", "in": ["three"]}]
    assert facts["items"] == [[["e"], [{"is": "paragraph", "in": ["0.9"]}]]]
    assert (box["kind"], box["in"][0]["in"]) == ("failure", ["gone"])


def test_figures_are_numbered_and_described():
    page = Page(
        "<main><figure><svg><desc>a &lt; b</desc><path/></svg><figcaption>one</figcaption></figure>"
        '<figure><img src="../photos/a-1.jpg" alt="a photo"></figure><figure><img src="data:x"></figure></main>'
    )
    drawn, photo = page.sections()[""]
    assert drawn["pictures"] == [{"is": "picture", "number": 0, "alt": "a < b"}]
    assert drawn["caption"] == ["one"]
    assert page.pictures == ["<svg><desc>a &lt; b</desc><path/></svg>"]
    assert photo["pictures"] == [{"is": "picture", "file": "../photos/a-1.jpg", "alt": "a photo"}]


def test_a_column_for_the_screen_is_left_out_of_a_table():
    row = '<tr><td>a</td><td data-paper="no">x</td><td>b</td></tr>'
    (table,) = blocks_of(f"<table>{row}</table>")
    assert [cell["in"][0]["in"] for cell in table["body"][0]] == [["a"], ["b"]]


@every(
    "screen",
    [
        *("<script>x</script>", "<style>x</style>", "<nav>x</nav>", "<details><p>x</p></details>"),
        *("<button>x</button>", "<select><option>x</option></select>", '<p data-paper="no">x</p>', "<p hidden>x</p>"),
        *("<div hidden><p>x</p></div>", '<p class="steps">x</p>', "<p></p>"),
    ],
)
def test_what_only_a_screen_can_use_is_left_out(screen):
    assert blocks_of(f"<p>before</p>{screen}<p>after</p>") == blocks_of("<p>before</p><p>after</p>")


def test_nothing_is_lost_of_a_page_with_a_very_long_text():
    said, after = blocks_of(f"<p>{'x' * 11_000_000}</p><p>after</p>")
    assert len(said["in"][0]) == 11_000_000
    assert after["in"] == ["after"]
