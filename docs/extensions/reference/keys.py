"""Keys of campaign.toml and review.toml, and columns of the test log: a page a table, a place a key."""

import re

from colonnade.campaign.test import Test
from reference.markdown import table, target
from reference.schemas import tables

TITLES = {"campaign": "campaign.toml", "review": "review.toml"}


def pages():
    """Make the pages of both files and of the test log."""
    made = {}
    for name, title in TITLES.items():
        found = tables(name)
        for each in found:
            made[f"{name}/{page_of(each.path)}.md"] = page(name, each)
        made[f"{name}/index.md"] = index(name, title, found)
    return made | {"test-log.md": test_log()}


def page_of(path):
    """Name of the page of a table."""
    return re.sub(r"\.<\w+>", "", path).replace(".", "-") or "top"


def place(name, path):
    """Anchor of a key."""
    return f"{name}-{re.sub(r'[<>]', '', path)}".replace(".", "-").replace("_", "-").lower()


def index(name, title, found):
    """List all keys of a file, each with a link to its place."""
    names = [page_of(each.path) for each in found]
    lines = [f"# {title}\n\nEvery key of `{title}`. A key that a table does not have is refused.\n\n"]
    for each in found:
        lines.append(f"## [{head(name, each)}]({page_of(each.path)}.md)\n\n{each.description}\n\n")
        rows = [(f"[`{key.name}`](#{place(name, key.path)})", key.description) for key in each.keys]
        lines.append(table(("key", "what it says"), unique(rows)))
    return "".join(lines) + "```{toctree}\n:hidden:\n\n" + "".join(f"{each}\n" for each in names) + "```\n"


def unique(rows):
    """Leave out rows that repeat the key of one before them."""
    return list({row[0]: row for row in reversed(rows)}.values())[::-1]


def head(name, each):
    """How the table is written in the file."""
    if not each.path:
        return "The file itself"
    lists = {"tests"} | ({"exclude", "trim", "flag", "correct"} if name == "review" else set())
    return f"`[[{each.path}]]`" if each.path in lists else f"`[{each.path}]`"


def page(name, each):
    """Write a table: its keys, each with what may be written."""
    lines = [f"# {head(name, each)}\n\n{each.description}\n\n"]
    seen = set()
    first = {key.path: place for place, key in reversed(list(enumerate(each.keys)))}
    for key in sorted(each.keys, key=lambda key: first[key.path]):
        if key.path not in seen:
            lines.append(target(place(name, key.path)))
            lines.append(f"## `{key.name}`\n\n")
            seen.add(key.path)
        of = f"Of {', '.join(f'`{one}`' for one in key.variants)}.\n\n" if key.variants else ""
        lines.append(f"{of}{key.description}\n\n")
        facts = {
            "key": f"`{key.path}`",
            "form": key.form,
            "unit": key.unit,
            "default": key.default or ("needed" if key.is_needed else "none: may be left out"),
            "bounds": f"between {key.bounds}" if " and " in key.bounds else key.bounds,
        }
        given = {name: fact for name, fact in facts.items() if fact}
        lines.append(table(tuple(given), [tuple(given.values())]))
    return "".join(lines)


def test_log():
    """List the columns of the test log: the keys of a test."""
    [found] = [each for each in tables("campaign") if each.path == "tests"]
    by_name = {key.name: key for key in found.keys}
    rows = [
        (f"[`{name}`](#{place('campaign', f'tests.{name}')})", purpose, by_name[name].form)
        for name, purpose in Test.purposes().items()
    ]
    return (
        '# Test log\n\nThe laboratory\'s own table of tests, CSV or Excel, named by `tests = "tests.csv"`: one row a '
        "test, these column heads. `file.<id>` is the file of another recorder. An empty cell is a key that is not "
        "given; a column with another head is ignored, with a note.\n\n"
        + table(("column", "what it says", "form"), rows)
    )
