"""The campaign.toml of a virtual campaign, with comments that explain it to a newcomer."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from colonnade import units
from colonnade.campaign.syntax.document import toml_key, toml_value
from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.errors import CampaignError
from colonnade.laboratory.experiment import MAIN, Plan, Setup, Trial, begun, raw_path
from colonnade.laboratory.files import FileFormat
from colonnade.laboratory.table import VOLTS, Transducer
from colonnade.readers.files import irregular
from colonnade.store.files import own_files

FILE_NAME = "campaign.toml"
MARK = "# Written by colonnade's virtual laboratory"
"""First words of every campaign file that may be overwritten by another one of the laboratory."""

FACILITY = "virtual shake table (simulated: no real specimen was shaken)"
OPERATOR = "virtual laboratory"

_HEAD = (
    MARK
    + """: no real specimen was shaken.
# Its truth is in truth/, which no stage of the processing reads. Facility, days and operator are made up.
# Every quantity is text with its unit; paths are relative to this file.
"""
)

_SPECIMENS = """
# What was tested. Critical angle, inertia and the rest follow from dimensions and mass; a measured value given
# here replaces them. No restitution is given, so it is identified from the free vibrations.
"""

_CHANNELS = """
# What each column is. Physical value = recorded × gain + offset; `range` is the largest magnitude.
# `at` is the point that the transducer follows: x along shaking, y across, z up, from the centre of the base.
"""

_ALIGN = "# It starts separately. Two channels that measure the same motion, one on each recorder, give its delay."

_TESTS = """
# The tests, in the order in which they were done.
"""


def campaign_text(plan: Plan) -> str:
    """Write out the campaign file of a plan."""
    gravity = next(iter(plan.specimens.values())).block.gravity
    head = {"schema": 1, "campaign": plan.campaign, "title": plan.title, "facility": FACILITY}
    own_gravity = {} if gravity == STANDARD_GRAVITY else {"gravity": f"{gravity} m/s^2"}
    lines = [_HEAD, *entries(head | own_gravity)]
    lines += [_SPECIMENS + "[specimens]", *entries({name: each.shape for name, each in plan.specimens.items()})]
    for number, (name, setup) in enumerate(plan.setups.items()):
        lines += _setup(f"setups.{toml_key(name)}", setup, explained=number == 0)
    lines.append(_TESTS.rstrip())
    for position, trial in enumerate(plan.trials):
        lines += ["", "[[tests]]", *entries(_trial(plan, trial, position))]
    return "\n".join([*lines, ""])


def entries(values: Mapping[str, object]) -> list[str]:
    """Write a line of TOML for each key."""
    return [f"{toml_key(key)} = {toml_value(value)}" for key, value in values.items()]


def refuse_foreign(folder: Path) -> None:
    """Refuse a folder with a campaign file that the laboratory did not write, or with links where it would write."""
    path = folder / FILE_NAME
    if path.exists() and (irregular(path) or not path.read_bytes().startswith(MARK.encode())):
        raise CampaignError(
            f"{path}: this campaign was not written by the virtual laboratory and was not changed. Name another folder "
            "for the demo."
        )
    for name in ("raw", "truth"):
        own_files(folder / name)


def _setup(key: str, setup: Setup, *, explained: bool) -> list[str]:
    lines = ["", *([f"# {setup.comment}"] if setup.comment else []), f"[{key}]", *_file(setup.recorders[MAIN].flavour)]
    if setup.catch is not None:
        lines.append(f'catch = "{setup.catch:g} rad"    # where the safety frame catches the specimen')
    for name, recorder in setup.recorders.items():
        if name == MAIN:
            continue
        lines += ["", f"[{key}.recorders.{toml_key(name)}]    # a second recorder", *_file(recorder.flavour)]
        if recorder.align is not None:
            lines += [_ALIGN, f"clock = {{align = [{', '.join(map(toml_value, recorder.align))}]}}"]
    lines.append((_CHANNELS if explained else "\n") + f"[{key}.channels]")
    for name, recorder in setup.recorders.items():
        lines += entries({each.channel: _channel(each, name) for each in recorder.transducers})
    return lines


def _file(flavour: FileFormat) -> list[str]:
    said = flavour.declaration()
    if not said:
        return ["# Delimiter, decimal sign, names and units are detected from the files."]
    return [f"file = {toml_value(said)}    # every key is optional: what is not given is detected"]


def _channel(transducer: Transducer, recorder: str) -> dict[str, object]:
    unit = transducer.physical_unit
    factor = units.factor_to_si(unit, transducer.dimension)
    entry: dict[str, object] = {"column": transducer.column}
    if recorder != MAIN:
        entry["recorder"] = recorder
    entry |= {"quantity": transducer.quantity, "unit": transducer.recorded_unit}
    if transducer.recorded_unit == "V":
        entry["gain"] = f"{transducer.full_scale / VOLTS / factor:.10g} {unit}/V"
        if transducer.offset:
            entry["offset"] = f"{transducer.offset / factor:.10g} {unit}"
        entry["range"] = f"{VOLTS:g} V"
    else:
        entry["range"] = f"{(transducer.full_scale + abs(transducer.offset)) / factor:.10g} {unit}"
    entry["on"] = transducer.on
    if transducer.at is not None:
        entry["at"] = [f"{value * 1000:.10g} mm" for value in transducer.at]
    entry["direction"] = [each if each % 1 else int(each) for each in transducer.direction]
    if transducer.on == "specimen":
        entry["relative_to"] = transducer.relative_to
    return entry


def _trial(plan: Plan, trial: Trial, position: int) -> dict[str, object]:
    recorders = plan.setups[trial.setup].recorders
    paths = {name: raw_path(trial, name, recorder) for name, recorder in recorders.items()}
    return {
        "id": trial.name,
        "kind": trial.kind,
        "specimen": plan.specimen_of(trial),
        "setup": trial.setup,
        "file": paths[MAIN] if len(paths) == 1 else paths,
        "date": begun(position).date(),
        "operator": OPERATOR,
        **trial.entry,
    }
