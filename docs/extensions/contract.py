"""
The files of the contract, from their JSON Schemas: of each key its form, unit, default, bounds and meaning.

Of campaign.toml and review.toml a page a table and a place a key, the columns of the test log; of the JSON files that
colonnade writes, a page a file.
"""

import json
import re
from dataclasses import dataclass

from colonnade.campaign.forms.schema import json_schema
from colonnade.campaign.test import Test
from myst import table, target

TITLES = {"campaign": "campaign.toml", "review": "review.toml"}


WRITTEN = {
    "summary": (
        "summary.json",
        "`processed/summary.json`: a record for each specimen, test and assessment, and the forecasts. `null` means "
        "not known. `processed/summary.csv` has the records of the tests, one row a test, with the same names.",
    ),
    "forecast": ("Forecast files", "`forecasts/*.json`: one forecast a file, written once and never changed."),
}

IDS = {"motions": "<name>", "assessments": "<name>", "prototype": "<specimen>"}
"""How the key of an entry is written, if not `<id>`."""


def pages():
    """Make the pages of both files that people write, of the test log, and of each file that colonnade writes."""
    made = {}
    for name, title in TITLES.items():
        found = tables(name)
        for each in found:
            made[f"{name}/{page_of(each.path)}.md"] = page(name, each)
        made[f"{name}/index.md"] = index(name, title, found)
    fields = {f"{name}.md": fields_of(name, title, lead) for name, (title, lead) in WRITTEN.items()}
    return made | {"test-log.md": test_log()} | fields


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


def fields_of(name, title, lead):
    """Write all tables of a file that colonnade writes."""
    parts = [f"# {title}\n\n{lead}\n\n"]
    for each in tables(name):
        heading = f"`{each.path}`" if each.path else "The file itself"
        rows = [(f"`{key.name}`", key.form, key.unit, key.description) for key in each.keys]
        if not any(key.unit for key in each.keys):
            heads, rows = ("field", "form", "what it is"), [(row[0], row[1], row[3]) for row in rows]
        else:
            heads = ("field", "form", "unit", "what it is")
        parts.append(
            target(f"{name}-{each.path.replace('.', '-').replace('<', '').replace('>', '').replace('_', '-')}")
        )
        parts.append(f"## {heading}\n\n{each.description}\n\n{table(heads, rows)}")
    return "".join(parts)


@dataclass(frozen=True)
class Key:
    """One key of a table: `path` is written as in the file, `variants` are those of its table that have it."""

    path: str
    description: str
    form: str
    unit: str
    default: str
    bounds: str
    is_needed: bool
    variants: tuple[str, ...] = ()

    @property
    def name(self):
        """The key alone."""
        return self.path.rpartition(".")[2]


@dataclass(frozen=True)
class Table:
    """A table of a file with its keys; `path` is empty for the file itself."""

    path: str
    description: str
    keys: tuple[Key, ...]


def tables(name):
    """
    Tables of a contract, each before those within it.

    Raises
    ------
    ValueError
        If a key has no description: the schema, and with it this reference, is made from the models.
    """
    schema = json_schema(name)
    return list(_tables(schema, schema.get("$defs", {}), ""))


def _tables(node, definitions, path):
    variants = _variants(node, definitions)
    keys = [
        _key(f"{path}.{key}".lstrip("."), each, definitions, key in variant.get("required", ()), label)
        for label, variant in variants
        for key, each in variant.get("properties", {}).items()
    ]
    yield Table(path, _first_paragraph(node), tuple(_merged(keys, len(variants))))
    below = {key: each for _, variant in variants for key, each in variant.get("properties", {}).items()}
    for key, each in below.items():
        for within, suffix in _inner(each, definitions, key):
            yield from _tables(within, definitions, f"{path}.{key}{suffix}".lstrip("."))


def _variants(node, definitions):
    """Give the kinds of a table, each with its label, such as the shapes of a specimen."""
    choices = [_resolved(choice, definitions) for choice in node.get("oneOf", node.get("anyOf", []))]
    if "properties" in node or not choices:
        return [("", node)]
    return [(_label(choice), choice) for choice in choices if "properties" in choice]


def _label(choice):
    constants = [each["const"] for each in choice["properties"].values() if "const" in each]
    return str(constants[0]) if constants else ""


def _merged(keys, variants):
    """Put the same key of several variants into one; name the variants unless all have it."""
    alike = {}
    for key, label in keys:
        shown = Key(**{**vars(key), "form": ""}) if key.form.startswith("`") and label else key
        alike.setdefault(shown, []).append((key, label))
    for group in alike.values():
        labels = tuple(label for _, label in group if label)
        forms = dict.fromkeys(key.form for key, _ in group)
        merged = {**vars(group[0][0]), "form": " or ".join(forms)}
        yield Key(**{**merged, "variants": labels if len(labels) < variants else ()})


def _inner(node, definitions, key):
    """Find the tables that a key holds: itself one, one an id, or a list of them."""
    entry = IDS.get(key, "<id>")
    for choice in (node, *node.get("anyOf", ())):
        if "$ref" in choice:
            found = _resolved(choice, definitions)
            if "properties" in found or "anyOf" in found or "oneOf" in found:
                yield found, ""
        for many, suffix in ((choice.get("items"), ""), (choice.get("additionalProperties"), f".{entry}")):
            if isinstance(many, dict) and "$ref" in many:
                yield _resolved(many, definitions), suffix
        for each in choice.get("patternProperties", {}).values():
            if "$ref" in each or "oneOf" in each:
                yield {"description": node.get("description", "")} | _resolved(each, definitions), f".{entry}"


def _resolved(node, definitions):
    if "$ref" not in node:
        return node
    return definitions[node["$ref"].rpartition("/")[2]] | {key: node[key] for key in node if key != "$ref"}


def _key(path, node, definitions, is_needed, label):
    node = _resolved(node, definitions)
    if not node.get("description"):
        raise ValueError(f"{path} has no description: write it at its model.")
    default = node.get("default")
    shown = "" if default is None or default == [] else f"`{json.dumps(default, ensure_ascii=False)}`"
    key = Key(
        path,
        " ".join(node["description"].split()),
        form(node, definitions),
        str(_found(node, "unit") or ""),
        shown,
        bounds(node),
        is_needed,
    )
    return key, label


def form(node, definitions):
    """Say in words what is written."""
    node = _resolved(node, definitions)
    if "const" in node:
        return f"`{json.dumps(node['const'], ensure_ascii=False)}`"
    if "enum" in node:
        return ", ".join(f"`{json.dumps(each, ensure_ascii=False)}`" for each in node["enum"])
    if node.get("type") == "array" or "prefixItems" in node:
        return _list(node, definitions)
    choices = node.get("anyOf", node.get("oneOf"))
    if choices:
        return " or ".join(dict.fromkeys(form(choice, definitions) for choice in choices))
    if node.get("type") == "string":
        return "quantity" if "unit" in node and "between" in node else _text(node)
    names = {"integer": "whole number", "number": "number", "boolean": "`true` or `false`", "null": "`null`"}
    return names.get(node.get("type"), "table")


def _text(node):
    formats = {"date": "date", "date-time": "date and time"}
    return formats.get(node.get("format"), "text")


def _list(node, definitions):
    items = node.get("items") or (node.get("prefixItems") or [{}])[0]
    count = node.get("minItems") if node.get("minItems") == node.get("maxItems") else None
    what = form(items, definitions)
    return f"list of {count or ''} × {what}" if count else f"list: {what}"


def bounds(node):
    """Write the least and largest value, wherever in the form they are."""
    if between := _found(node, "between"):
        return str(between)
    least, above = _found(node, "minimum"), _found(node, "exclusiveMinimum")
    most, below = _found(node, "maximum"), _found(node, "exclusiveMaximum")
    parts = [
        *([f"at least {least:g}"] if least is not None else []),
        *([f"above {above:g}"] if above is not None else []),
        *([f"at most {most:g}"] if most is not None else []),
        *([f"below {below:g}"] if below is not None else []),
    ]
    return ", ".join(parts)


def _found(node, word):
    """Find a keyword in a schema or in the choices and items below it."""
    if word in node:
        return node[word]
    items = node.get("items")
    below = [*node.get("anyOf", ()), *([items] if isinstance(items, dict) else ())]
    return next((found for each in below if (found := _found(each, word)) is not None), None)


def _first_paragraph(node):
    return " ".join(node.get("description", "").split("\n\n")[0].split())
