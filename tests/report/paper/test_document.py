"""The document: chapters in their order, pictures by name, links only to its own places."""

from hashlib import sha256

from colonnade.report.paper.typesetting import document_of

from .conftest import HOSTILE


def test_chapters_are_the_summary_specimens_spans_and_methods(campaign, folder):
    data = document_of(campaign, folder).data
    titles = [chapter["title"] for chapter in data["chapters"]]
    assert titles == ["Summary", "Specimen prism", "Spans", "Methods"]
    assert [chapter["equations"] for chapter in data["chapters"]] == [False, False, False, True]
    assert [sheet["title"] for sheet in data["appendix"]] == ["free-01", "free-02"]


def test_without_its_appendix_nothing_leads_to_a_test(campaign, folder):
    data = document_of(campaign, folder, appendix=False).data
    assert [chapter["title"] for chapter in data["chapters"]][0::3] == ["Summary", "Methods"]
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
    assert data["cover"] == {"tag": "img", "src": "photos-free-02-1.jpg", "alt": "it lies", "in": []}


def test_each_figure_has_a_file_of_its_own(campaign, folder):
    document = document_of(campaign, folder)
    assert list(document.pictures) == ["figure-1.svg", "figure-2.svg"]
    assert document.files == {"photos-free-02-1.jpg": folder / "photos" / "free-02-1.jpg"}
    assert "not on paper" not in str(document.data)


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


def test_without_a_photo_the_cover_has_the_first_drawing_of_a_setup(campaign, folder):
    (folder / "photos" / "free-02-1.jpg").unlink()
    (folder / "setups").mkdir()
    (folder / "setups" / "prism+frame.svg").write_text("<svg/>", encoding="utf-8")
    drawn = '<section id="setups"><figure><img src="../setups/prism+frame.svg" alt="drawn"></figure></section>'
    (folder / "specimens" / "prism.html").write_text(f"<main>{drawn}</main>", encoding="utf-8")
    cover = document_of(campaign, folder).data["cover"]
    assert cover == {"tag": "img", "src": "setups-prism+frame.svg", "alt": "drawn", "in": []}


def test_every_section_of_a_test_is_printed_unless_it_says_no(campaign, folder):
    kinds = ("found", "channels", "a-new-one")
    inside = "".join(f'<section id="{kind}"><p>{kind}</p></section>' for kind in kinds)
    no = '<section id="setup" data-paper="no"><p>no</p></section><section id="histories" hidden><p>no</p></section>'
    (folder / "tests" / "free-01.html").write_text(f"<main>{inside}{no}</main>", encoding="utf-8")
    sheet = document_of(campaign, folder).data["appendix"][0]
    assert [section["in"] for section in sheet["in"]] == [[{"tag": "p", "in": [kind]}] for kind in kinds]
