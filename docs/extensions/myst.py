"""Pieces of Markdown that the generated pages are made of."""

import re


def table(heads, rows):
    """Write a table; empty if it has no rows."""
    rows = list(rows)
    if not rows:
        return ""
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join("| " + " | ".join(map(cell, line)) + " |\n" for line in lines) + "\n"


def cell(text):
    """Text in one line, its bars escaped."""
    return re.sub(r"(?<!\\)\|", r"\\|", " ".join(str(text).split()))


def code(text):
    """Write text as code; empty text stays empty."""
    return f"`{text}`" if str(text) else ""


def target(name):
    """Make a place that `[text](#name)` leads to, whatever the heading below it says."""
    return f"({name})=\n"


def contents(names, depth=1):
    """List pages as a table of contents."""
    return f"```{{toctree}}\n:maxdepth: {depth}\n\n" + "".join(f"{name}\n" for name in names) + "```\n"
