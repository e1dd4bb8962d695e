"""
The generated reference: pages made from the code's own tables whenever the site is built.

Pages are text of MyST or reStructuredText, by file name in docs/reference/generated.
"""

import inspect
import re
from pathlib import Path

import colonnade
import contract
from colonnade.store.description import QUALITY_FLAGS, VARIABLES
from colonnade.store.results import STAGES
from myst import code, contents, table, target

GROUPS = {
    "Block and base motion": ("Block", "RestitutionLaw", "Motion", "read_motion"),
    "From transducers to angle and e": ("rocking_angle", "identify_restitution", "Restitution"),
    "Rocking": ("rock", "History", "reactions", "Reactions"),
    "Several bodies": ("Assembly", "Placed", "AssemblyHistory"),
    "What is not known exactly": ("ensemble", "Ensemble", "Uncertainty"),
    "Maps and spectra": (
        *("stability_map", "StabilityMap", "rocking_spectrum", "RockingSpectrum"),
        *("overturning_spectrum", "OverturningSpectrum"),
    ),
    "The real column": ("intensity_measures", "IntensityMeasures", "fragility", "Fragility"),
    "Pictures": ("plot", "animate"),
    "Campaigns": ("run", "ColonnadeError"),
}

LIBRARY = """# Library

Everything that the commands do to one record works on plain arrays, without a campaign: `import colonnade`. Values are
in SI, angles in rad, and a missing sample is NaN. A wrong argument raises a `ValueError` that names it. Each
result shows itself in a line, and `colonnade.plot(result)` draws it.

"""

RESULTS = """# Result files

Every result is one NetCDF file in `processed/`: SI, CF-1.11, complete or absent. A file has those of its variables
that its test and its campaign give rise to. A result of a stage that failed has the attributes `status` and `reason`
and no data.

"""

CHANNELS = """Each channel of campaign.toml is a variable of its name, in SI along `elapsed` (or along the clock of its
recorder, `elapsed_<recorder>`), with `<channel>_quality`; `recorded.nc` also has `<channel>_recorded`, the values as
they were in the file.

"""


def setup(app):
    """Write the pages before Sphinx looks for them."""
    app.connect("builder-inited", lambda app: write(Path(app.srcdir, "docs", "reference", "generated")))
    app.connect("autodoc-process-docstring", keep_bars, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def all_pages():
    """Every page of the reference, by its path."""
    return pages_of_library() | contract.pages() | pages_of_results()


def write(folder):
    """Write what has changed, so that only that is read again, and remove what is no page any more."""
    pages = {folder / name: text for name, text in all_pages().items()}
    for path, text in pages.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
    for path in [path for path in folder.rglob("*.*") if path not in pages]:
        path.unlink()


def pages_of_library():
    """Make a page for each public name, from its docstring, and the list of all."""
    listed = {name for names in GROUPS.values() for name in names}
    if listed != (public := set(colonnade.__all__) - {"__version__"}):
        raise ValueError(f"public names that are in no group, or the other way round: {sorted(listed ^ public)}")
    parts = [LIBRARY]
    for group, names in GROUPS.items():
        rows = [(f"[`{name}`]({name}.rst)", summary(name)) for name in names]
        parts.append(f"## {group}\n\n" + table(("name", "is"), rows))
    parts.append(contents(name for names in GROUPS.values() for name in names).replace(":maxdepth: 1", ":hidden:"))
    return {"library/index.md": "".join(parts)} | {f"library/{name}.rst": page_of(name) for name in sorted(listed)}


def summary(name):
    """Give the first paragraph of a docstring."""
    return " ".join(inspect.getdoc(getattr(colonnade, name)).split("\n\n")[0].split())


def page_of(name):
    """Write the page of a function or of a class with its members."""
    found = getattr(colonnade, name)
    if not inspect.isclass(found):
        return f"{name}\n{'=' * len(name)}\n\n.. autofunction:: colonnade.{name}\n"
    options = "   :members:\n   :inherited-members: object, BaseException\n"
    return f"{name}\n{'=' * len(name)}\n\n.. autoclass:: colonnade.{name}\n{options}"


def keep_bars(app, what, name, found, options, lines):
    """Escape the bars of |θ| in a docstring, which reStructuredText would take for a substitution."""
    is_example = False
    for place, line in enumerate(lines):
        is_example = line.lstrip().startswith(">>>") or (is_example and bool(line.strip()))
        if not is_example:
            lines[place] = re.sub(r"\|(?=\S[^|]*\|)|(?<=\S)\|(?![|`])", r"\\|", line)


def pages_of_results():
    """Make the page of all result files, each with its variables, from the tables that describe them when written."""
    parts = [RESULTS]
    for name, stage in STAGES.items():
        path = stage.file.replace("{subject}", "<id>").replace("{model}", "<model>")
        parts.append(target(f"file-{name}") + f"## `processed/{path}.nc`\n\n{stage.summary} *(stage {name})*\n\n")
        parts.append(CHANNELS if name in ("ingest", "condition") else "")
        rows = [row(each) for each, entry in VARIABLES.items() if name in entry.stages]
        parts.append(table(("variable", "unit", "what it is"), rows))
    flags = (flag.replace("_", " ").split("=") for flag in QUALITY_FLAGS.split())
    parts.append("## Quality flags\n\n" + table(("flag", "means"), flags))
    return {"files.md": "".join(parts)}


def row(name):
    """Describe a variable as the files do."""
    entry = VARIABLES[name]
    comment = f" {entry.comment}" if entry.comment else ""
    unit = {"1": "–", "": "text or flag"}.get(entry.units, code(entry.units))
    return code(name), unit, f"{entry.long_name[0].upper()}{entry.long_name[1:]}.{comment}"
