"""Equations of the site: signs stay signs, names of functions have their space, and none is left as LaTeX."""

import re
from xml.etree import ElementTree

import pytest

from page_blocks import PROJECT

pytest.importorskip("latex2mathml", reason="the extra `docs` is not installed")
pytestmark = pytest.mark.whole


@pytest.fixture
def markup():
    from docutils import nodes

    import pages

    return lambda latex: pages.markup(nodes.math(latex, latex), "inline")


def test_no_command_is_left_in_the_equations_of_the_pages(markup):
    left = []
    for page in sorted((PROJECT / "docs").rglob("*.md")):
        text = re.sub(r"```.*?```|`[^`\n]*`", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
        for block, inline in re.findall(r"\$\$(.+?)\$\$|\$([^$\n]+?)\$", text, flags=re.DOTALL):
            texts = ElementTree.fromstring(markup(block or inline)).itertext()
            left += [(page.name, block or inline) for text in texts if "\\" in text]
    assert left == []
