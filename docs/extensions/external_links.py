"""The addresses that the site's pages link to, in docs/build/external-links.txt: listed, never fetched."""

from pathlib import Path

from docutils import nodes


def setup(app):
    """Collect while pages are written, list when all are."""
    app.connect("doctree-read", collect)
    app.connect("env-purge-doc", forget)
    app.connect("env-merge-info", merge)
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True, "env_version": 1}


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


def write(app, problem):
    """One line an address: the address, then the pages that link to it."""
    if problem is None:
        pages = {}
        for docname, found in sorted(links(app.env).items()):
            for address in found:
                pages.setdefault(address, []).append(docname)
        lines = [f"{address}\t{' '.join(names)}\n" for address, names in sorted(pages.items())]
        Path(app.outdir).with_name("external-links.txt").write_text("".join(lines), encoding="utf-8")
