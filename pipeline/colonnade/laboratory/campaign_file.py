"""The campaign.toml of a virtual campaign, with comments that explain it to a newcomer."""

from __future__ import annotations

from pathlib import Path

from colonnade import units
from colonnade.campaign.syntax.document import toml_key, toml_value
from colonnade.dynamics.block import STANDARD_GRAVITY
from colonnade.errors import CampaignError
from colonnade.laboratory.experiment import MAIN, Plan, Recorder, Setup, Trial, begun, raw_path
from colonnade.laboratory.files import FileFormat
from colonnade.laboratory.instruments import VOLTS, Transducer
from colonnade.readers.files import irregular

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

_TESTS = """
# The tests, in the order in which they were done.
"""


def campaign_text(plan: Plan) -> str:
    """Write out the campaign file of a plan."""
    lines = [_HEAD, "schema = 1", f"campaign = {toml_value(plan.campaign)}", f"title = {toml_value(plan.title)}"]
    lines.append(f"facility = {toml_value(FACILITY)}")
    gravity = next(iter(plan.specimens.values())).block.gravity
    if gravity != STANDARD_GRAVITY:
        lines.append(f'gravity = "{gravity} m/s^2"')
    lines.append(_SPECIMENS + "[specimens]")
    lines += [f"{toml_key(name)} = {toml_value(specimen.shape)}" for name, specimen in plan.specimens.items()]
    for number, (name, setup) in enumerate(plan.setups.items()):
        lines += _setup(name, setup, explained=number == 0)
    lines.append(_TESTS.rstrip())
    for position, trial in enumerate(plan.trials):
        lines += _trial(plan, trial, position)
    return "\n".join([*lines, ""])


def refuse_foreign(folder: Path) -> None:
    """
    Keep the laboratory from writing over a real campaign.

    Raises
    ------
    CampaignError
        If the folder holds a campaign file that the laboratory did not write.
    """
    path = folder / FILE_NAME
    if path.exists() and (irregular(path) or not path.read_bytes().startswith(MARK.encode())):
        raise CampaignError(
            f"{path}: this campaign was not written by the virtual laboratory and was not changed. Name another folder "
            "for the demo."
        )


def _setup(name: str, setup: Setup, *, explained: bool) -> list[str]:
    main = setup.recorders[MAIN]
    lines = ["", *([f"# {setup.comment}"] if setup.comment else []), f"[setups.{toml_key(name)}]", *_file(main.flavour)]
    if setup.catch is not None:
        lines.append(f'catch = "{setup.catch:g} rad"    # where the safety frame catches the specimen')
    for recorder_name, recorder in setup.recorders.items():
        if recorder_name != MAIN:
            lines += _recorder(name, recorder_name, recorder)
    lines.append((_CHANNELS if explained else "\n") + f"[setups.{toml_key(name)}.channels]")
    for recorder_name, recorder in setup.recorders.items():
        lines += [
            f"{toml_key(each.channel)} = {toml_value(_channel(each, recorder_name))}" for each in recorder.transducers
        ]
    return lines


def _file(flavour: FileFormat) -> list[str]:
    said = flavour.declaration()
    if not said:
        return ["# Delimiter, decimal sign, names and units are detected from the files."]
    return [f"file = {toml_value(said)}    # every key is optional: what is not given is detected"]


def _recorder(setup: str, name: str, recorder: Recorder) -> list[str]:
    lines = [
        "",
        f"[setups.{toml_key(setup)}.recorders.{toml_key(name)}]    # a second recorder",
        *_file(recorder.flavour),
    ]
    if recorder.align is not None:
        first, second = map(toml_value, recorder.align)
        lines.append(
            "# It starts separately. Two channels that measure the same motion, one on each recorder, give its delay."
        )
        lines.append(f"clock = {{align = [{first}, {second}]}}")
    return lines


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


def _trial(plan: Plan, trial: Trial, position: int) -> list[str]:
    recorders = plan.setups[trial.setup].recorders
    paths = {name: raw_path(trial, name, recorder) for name, recorder in recorders.items()}
    entry: dict[str, object] = {"id": trial.name, "kind": trial.kind, "specimen": plan.specimen_of(trial)}
    entry["setup"] = trial.setup
    entry["file"] = paths[MAIN] if len(paths) == 1 else paths
    entry |= {"date": begun(position).date(), "operator": OPERATOR}
    return ["", "[[tests]]", *(f"{key} = {toml_value(value)}" for key, value in (entry | dict(trial.entry)).items())]
