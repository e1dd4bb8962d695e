"""
The generated reference: pages made from the code's own tables whenever the site is built.

Each module has `pages()`: text of MyST or reStructuredText by file name in docs/reference/generated.
"""

from pathlib import Path

from reference import files, keys, library, records

MAKERS = (library, keys, files, records)


def setup(app):
    """Write the pages before Sphinx looks for them."""
    app.connect("builder-inited", lambda app: write(Path(app.srcdir, "docs", "reference", "generated")))
    app.connect("autodoc-process-docstring", library.keep_bars, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def all_pages():
    """Every page of the reference, by its path."""
    return {name: text for maker in MAKERS for name, text in maker.pages().items()}


def write(folder):
    """Write what has changed, so that only that is read again, and remove what is no page any more."""
    pages = {folder / name: text for name, text in all_pages().items()}
    for path, text in pages.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
    for path in [path for path in folder.rglob("*.*") if path not in pages]:
        path.unlink()
