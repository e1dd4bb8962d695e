"""A digest is written in a line and as a table, in which nothing is markup."""

from xml.etree import ElementTree

from hypothesis import given
from hypothesis import strategies as st

from colonnade.digest import Digested, written

LETTERS = st.characters(codec="utf-8", exclude_categories=["Cc", "Cs"], exclude_characters="\ufffe\uffff")
TEXT = st.text(LETTERS, max_size=20)


class Told(Digested):
    def __init__(self, said):
        self.said = said

    def digest(self):
        return self.said


@given(st.dictionaries(TEXT, TEXT, max_size=4))
def test_any_text_is_shown_as_text(said):
    rows = ElementTree.fromstring(Told(said)._repr_html_()).iter("tr")
    assert {row[0].text or "": row[1].text or "" for row in rows} == said


def test_a_line_names_the_kind_and_the_values():
    assert repr(Told({"e": "0.97", "method": "peaks"})) == "<Told: e 0.97, method peaks>"


def test_a_number_has_its_unit_or_is_a_dash():
    assert (written(0.12345, "rad"), written(None), written(float("nan"), "s")) == ("0.1235 rad", "–", "–")
