"""Equations of the site: signs stay signs, names of functions have their space, and none is left as LaTeX."""

import re
from xml.etree import ElementTree

import pytest

from page_blocks import PROJECT

pytest.importorskip("latex2mathml", reason="the extra `docs` is not installed")
pytestmark = pytest.mark.whole
SPACE = "{http://www.w3.org/1998/Math/MathML}"


@pytest.fixture
def markup():
    from docutils import nodes

    import pages

    return lambda latex: pages.markup(nodes.math(latex, latex), "inline")


def test_greek_letters_and_signs_are_characters(markup):
    root = ElementTree.fromstring(markup(r"\ddot\theta < -p^2 \sin\psi"))
    texts = [part.text for part in root.iter() if part.text]
    assert {"θ", "ψ", "<", "−"} <= set(texts)
    assert not any("&" in text for text in texts)
    assert root.get("alttext") == r"\ddot\theta < -p^2 \sin\psi"


def test_the_name_of_a_function_has_space_around_it(markup):
    names = {part.text: part for part in ElementTree.fromstring(markup(r"a \sin b")).iter() if part.text}
    assert names["sin"].tag == f"{SPACE}mo"
    assert names["sin"].get("lspace") == names["sin"].get("rspace") == "0.17em"
    assert names["a"].tag == f"{SPACE}mi"


def test_no_command_is_left_in_the_equations_of_the_pages(markup):
    left = []
    for page in sorted((PROJECT / "docs").rglob("*.md")):
        text = re.sub(r"```.*?```|`[^`\n]*`", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
        for block, inline in re.findall(r"\$\$(.+?)\$\$|\$([^$\n]+?)\$", text, flags=re.DOTALL):
            texts = ElementTree.fromstring(markup(block or inline)).itertext()
            left += [(page.name, block or inline) for text in texts if "\\" in text]
    assert left == []
