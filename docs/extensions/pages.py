"""
What the site's pages have beyond Sphinx's own: equations as MathML, pictures that move, and what helps all readers.

Browsers draw and read MathML without a script. The addresses that pages link to are listed in
docs/build/external-links.txt, never fetched.
"""

from html import escape, unescape
from pathlib import Path
from xml.etree.ElementTree import tostring

from docutils import nodes
from latex2mathml.converter import convert_to_element
from matplotlib import pyplot
from matplotlib.animation import FuncAnimation
from sphinx.util import logging
from sphinx_gallery.scrapers import figure_rst

LOGGER = logging.getLogger(__name__)

LACKING = (
    # A long line is read by scrolling its block, with the keys as well.
    ("<pre>", '<pre tabindex="0">'),
    # A heading says its level.
    ('role="heading">', 'role="heading" aria-level="2">'),
)


def setup(app):
    """Register the renderer, which `html_math_renderer` names, and what is done to pages as they are made."""
    app.add_html_math_renderer("mathml", inline_renderers=(visit_inline, None), block_renderers=(visit_block, None))
    app.connect("html-page-context", complete)
    app.connect("doctree-read", collect)
    app.connect("env-purge-doc", forget)
    app.connect("env-merge-info", merge)
    app.connect("build-finished", finish)
    return {"parallel_read_safe": True, "parallel_write_safe": True, "env_version": 1}


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


def complete(app, pagename, templatename, context, doctree):
    """Add what its elements lack."""
    for found, replacement in LACKING:
        context["body"] = context.get("body", "").replace(found, replacement)


def links(env):
    """The addresses of each page."""
    if not hasattr(env, "external_links"):
        env.external_links = {}
    return env.external_links


def collect(app, doctree):
    """Keep the addresses of one page."""
    found = {node["refuri"] for node in doctree.findall(nodes.reference) if "://" in node.get("refuri", "")}
    if found:
        links(app.env)[app.env.docname] = found


def forget(app, env, docname):
    """A page that is read again gives its addresses again."""
    links(env).pop(docname, None)


def merge(app, env, docnames, other):
    """Take over what another process has read."""
    links(env).update({name: found for name, found in links(other).items() if name in docnames})


def finish(app, problem):
    """List the addresses, a line each with the pages that link to it, and lead from the site's root to `root_doc`."""
    if problem is not None:
        return
    pages = {}
    for docname, found in sorted(links(app.env).items()):
        for address in found:
            pages.setdefault(address, []).append(docname)
    lines = [f"{address}\t{' '.join(names)}\n" for address, names in sorted(pages.items())]
    Path(app.outdir).with_name("external-links.txt").write_text("".join(lines), encoding="utf-8")
    if app.builder.format == "html":
        target = app.builder.get_target_uri(app.config.root_doc)
        Path(app.outdir, "index.html").write_text(
            '<!doctype html><html lang="en"><meta charset="utf-8"><title>colonnade</title>'
            f'<meta http-equiv="refresh" content="0; url={target}"><a href="{target}">Documentation</a></html>\n',
            encoding="utf-8",
        )


def animations(block, block_vars, gallery_conf):
    """Write the animations that a block of an example made, and close their figures."""
    pictures = []
    made = [each for each in block_vars["example_globals"].values() if isinstance(each, FuncAnimation)]
    for animation in made:
        figure = animation._fig
        if pyplot.fignum_exists(figure.number):
            path = next(block_vars["image_path_iterator"]).replace(".png", ".gif")
            animation.save(path, writer="pillow", dpi=80)
            pictures.append(path)
            pyplot.close(figure)
    return figure_rst(pictures, gallery_conf["src_dir"])
