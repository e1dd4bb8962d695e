"""Equations as MathML, made while the site is built: browsers draw and read them without a script."""

from html import escape, unescape
from xml.etree.ElementTree import tostring

from docutils import nodes
from latex2mathml.converter import convert_to_element
from sphinx.util import logging

LOGGER = logging.getLogger(__name__)


def setup(app):
    """Register the renderer, which `html_math_renderer` names."""
    app.add_html_math_renderer("mathml", inline_renderers=(visit_inline, None), block_renderers=(visit_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def visit_inline(writer, node):
    """An equation in a line of text."""
    writer.body.append(markup(node, "inline"))
    raise nodes.SkipNode


def visit_block(writer, node):
    """An equation of its own, with its number if it has one."""
    number = f'<span class="eqno">({node["number"]})</span>' if node.get("number") else ""
    writer.body.append(writer.starttag(node, "div", CLASS="math"))
    writer.body.append(f"{markup(node, 'block')}{number}</div>\n")
    raise nodes.SkipNode


def markup(node, display):
    """The MathML of a node, with its LaTeX as the text for those who cannot read it."""
    latex = node.astext()
    try:
        element = convert_to_element(latex, display=display)
    except Exception as reason:
        LOGGER.warning("no MathML for the equation %r: %r", latex, reason, location=node)
        return f"<code>{escape(latex)}</code>"
    for part in element.iter():
        # Its signs are written as references, which would be escaped once more.
        part.text = unescape(part.text) if part.text else part.text
        if part.tag == "mi" and part.text and len(part.text) > 1 and part.text.isalpha():
            # The name of a function, which has a thin space around it, as in LaTeX.
            part.tag = "mo"
            part.attrib.update(lspace="0.17em", rspace="0.17em")
    element.set("alttext", latex)
    return tostring(element, encoding="unicode")
