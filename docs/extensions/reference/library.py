"""The library: a page for each public name, from its docstring, in the order in which data pass through them."""

import inspect
import re

import colonnade
from reference.markdown import contents, table

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

LEAD = """# Library

Everything that the commands do to one record works on plain arrays, without a campaign: `import colonnade`. Values are
in SI, angles in rad, and a missing sample is NaN. A wrong argument raises a `ValueError` that names it. In a notebook
each result shows itself as a small table, and `colonnade.plot(result)` draws it.

"""


def pages():
    """Make a page a name, and the list of all."""
    listed = {name for names in GROUPS.values() for name in names}
    if listed != (public := set(colonnade.__all__) - {"__version__"}):
        raise ValueError(f"public names that are in no group, or the other way round: {sorted(listed ^ public)}")
    parts = [LEAD]
    for group, names in GROUPS.items():
        rows = [(f"[`{name}`]({name}.rst)", summary(name)) for name in names]
        parts.append(f"## {group}\n\n" + table(("name", "is"), rows))
    parts.append(contents(name for names in GROUPS.values() for name in names).replace(":maxdepth: 1", ":hidden:"))
    return {"library/index.md": "".join(parts)} | {f"library/{name}.rst": page(name) for name in sorted(listed)}


def summary(name):
    """Give the first paragraph of a docstring."""
    return " ".join(inspect.getdoc(getattr(colonnade, name)).split("\n\n")[0].split())


def page(name):
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
