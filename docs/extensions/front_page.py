"""An index.html at the root of the built site, which leads to its first page."""

from pathlib import Path


def setup(app):
    """Write it once all pages are built."""
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def write(app, problem):
    """Lead from the root of the site to the page of `root_doc`."""
    if problem is None and app.builder.format == "html":
        target = app.builder.get_target_uri(app.config.root_doc)
        Path(app.outdir, "index.html").write_text(
            '<!doctype html><html lang="en"><meta charset="utf-8"><title>colonnade</title>'
            f'<meta http-equiv="refresh" content="0; url={target}"><a href="{target}">Documentation</a></html>\n',
            encoding="utf-8",
        )
