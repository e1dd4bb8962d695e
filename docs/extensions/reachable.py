"""What the theme leaves out for people who do not use a mouse or do not see the page."""

LACKING = (
    # A long line is read by scrolling its block, with the keys as well.
    ("<pre>", '<pre tabindex="0">'),
    # A heading says its level.
    ('role="heading">', 'role="heading" aria-level="2">'),
)


def setup(app):
    """Complete each page when it is written."""
    app.connect("html-page-context", complete)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def complete(app, pagename, templatename, context, doctree):
    """Add what its elements lack."""
    for found, replacement in LACKING:
        context["body"] = context.get("body", "").replace(found, replacement)
