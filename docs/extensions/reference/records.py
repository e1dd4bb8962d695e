"""Fields of the JSON files that colonnade writes: the summary and the forecasts."""

from reference.markdown import table, target
from reference.schemas import tables

FILES = {
    "summary": (
        "summary.json",
        "`processed/summary.json`: a record for each specimen, test and assessment, and the forecasts. `null` means "
        "not known. `processed/summary.csv` has the records of the tests, one row a test, with the same names.",
    ),
    "forecast": ("Forecast files", "`forecasts/*.json`: one forecast a file, written once and never changed."),
}


def pages():
    """Make a page a file."""
    return {f"{name}.md": page(name, title, lead) for name, (title, lead) in FILES.items()}


def page(name, title, lead):
    """Write all tables of a file."""
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
