"""The NetCDF files: the result of each stage with its variables, from the tables that describe them when written."""

from colonnade.store.description import FLAG_MEANINGS, FLAG_VALUES, VARIABLES
from colonnade.store.results import STAGES
from reference.markdown import code, table, target

LEAD = """# Result files

Every result is one NetCDF file in `processed/`: SI, CF-1.11, complete or absent. A file has those of its variables
that its test and its campaign give rise to. A result of a stage that failed has the attributes `status` and `reason`
and no data.

"""

CHANNELS = """Each channel of campaign.toml is a variable of its name, in SI along `elapsed` (or along the clock of its
recorder, `elapsed_<recorder>`), with `<channel>_quality`; `recorded.nc` also has `<channel>_recorded`, the values as
they were in the file.

"""


def pages():
    """Make the page of all result files."""
    parts = [LEAD]
    for name, stage in STAGES.items():
        path = stage.file.replace("{subject}", "<id>").replace("{model}", "<model>")
        parts.append(target(f"file-{name}") + f"## `processed/{path}.nc`\n\n{stage.summary} *(stage {name})*\n\n")
        parts.append(CHANNELS if name in ("ingest", "condition") else "")
        rows = [row(each) for each, entry in VARIABLES.items() if name in entry.stages]
        parts.append(table(("variable", "unit", "what it is"), rows))
    flags = zip(FLAG_VALUES, FLAG_MEANINGS.split(), strict=True)
    parts.append(
        "## Quality flags\n\n" + table(("flag", "means"), ((value, word.replace("_", " ")) for value, word in flags))
    )
    return {"files.md": "".join(parts)}


def row(name):
    """Describe a variable as the files do."""
    entry = VARIABLES[name]
    comment = f" {entry.comment}" if entry.comment else ""
    unit = {"1": "–", None: "text or flag"}.get(entry.units, code(entry.units))
    return code(name), unit, f"{entry.long_name[0].upper()}{entry.long_name[1:]}.{comment}"
