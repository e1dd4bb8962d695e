"""Equations as MathML, made while the site is built: browsers draw and read them without a script."""

from html import escape
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
    element.set("alttext", latex)
    return tostring(element, encoding="unicode")
