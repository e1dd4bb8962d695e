"""The stamp of a page: what it was made from, as long as it is as it was written."""

from hypothesis import given
from hypothesis import strategies as st

from colonnade.store.stamps import key_of, stamped, stamped_pdf


@given(st.text(st.characters(codec="utf-8")), st.text("0123456789abcdef", min_size=1, max_size=64), st.booleans())
def test_a_stamped_page_says_what_it_was_made_from(tmp_path_factory, text, key, script):
    path = tmp_path_factory.mktemp("page") / "page.html"
    path.write_bytes(stamped(text, key, script=script).encode())
    assert key_of(path) == key
    path.write_bytes(b"x" + path.read_bytes())
    assert key_of(path) == ""


def test_a_page_that_is_cut_short_without_a_stamp_or_gone_says_nothing(tmp_path):
    path = tmp_path / "page.html"
    assert key_of(path) == ""
    path.write_text("<html></html>\n")
    assert key_of(path) == ""
    path.write_text(stamped("<html></html>\n", "ab")[:-3])
    assert key_of(path) == ""


def test_the_last_stamp_counts(tmp_path):
    path = tmp_path / "page.html"
    path.write_text(stamped(stamped("<html></html>\n", "ab"), "cd"))
    assert key_of(path) == "cd"


@given(st.binary(), st.text("0123456789abcdef", min_size=1, max_size=64))
def test_a_stamped_pdf_says_what_it_was_made_from(tmp_path_factory, data, key):
    path = tmp_path_factory.mktemp("pdf") / "report.pdf"
    path.write_bytes(stamped_pdf(data, key))
    assert key_of(path) == key
    path.write_bytes(b"x" + path.read_bytes())
    assert key_of(path) == ""
