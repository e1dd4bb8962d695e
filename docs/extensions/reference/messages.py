"""Messages by what the reader has to do: every kind of finding, and the texts of all errors."""

import re

from reference.markdown import cell, contents, table
from reference.sources import SEVERITIES, errors, findings

ERRORS = {
    "CampaignError": (
        "Correct campaign.toml or review.toml",
        "The file is not used until all its problems are solved.",
    ),
    "UnitError": ("Correct a quantity or a unit", "What was written in quotes is not a number with a known unit."),
    "ReadError": ("Correct or export a raw file again", "Only the tests of this file fail; the others go on."),
    "StageError": ("Look at the test", "The stage refuses this test; the others go on."),
    "StoreError": ("Make room, or remove what is damaged", "A result or a page cannot be written or read back."),
    "UsageError": ("Correct the command line", "`--help` of the command shows what it takes; the exit code is 2."),
    "ColonnadeError": ("Solve what the message says", "What is needed is missing or cannot be used."),
}
"""What to do about each class of error, and what it means for the rest."""

CAMPAIGN, RECORDING, LABORATORY, RESULT, NOTHING = (
    "Correct campaign.toml",
    "Look at the recording, then decide in review.toml",
    "Check the laboratory: cables, sensors, recorders, files",
    "Think before you use the result",
    "Nothing: good to know",
)
ACTIONS = {
    CAMPAIGN: {
        "amplitude": "Correct the `amplitude` of the test, or the `gain` of the table's accelerometer.",
        "another motion": "Name the motion that was played, or the column of the component along x.",
        "copied file": "Give each test its own raw file, or its own `window` of a file.",
        "date": "Correct the `date` of the test, or its `file`.",
        "frequency": "Correct the `frequency` of the test, or the `sampling_rate` of the recorder.",
        "gain": "Compare the `gain` and the `unit` of the channel with its calibration sheet; mind powers of ten.",
        "geometry": "Correct `at`, `direction` or `normal` of the channel by the drawing (`check --drawing`).",
        "no file of a recorder": "Add the file of this recorder to the test, or leave its channels out.",
        "no frequency": "Give the `frequency` of the test, to have it checked.",
        "no test": "Add `[[tests]]`, a test log or a `pattern` in `[watch]`.",
        "not used": "Remove the key, or keep it as a note.",
        "outcome": "Compare `observed_outcome` with the video; if it is right, look for a wrong gain or sign.",
        "photo": "Correct the path or the file of the photo.",
        "polarity": "Turn the sign of the table's acceleration (`gain` or `direction`).",
        "raw file without a test": "Rename the file, give it an entry in `[[tests]]`, or change `[watch]`.",
        "reference motion": "Correct the entry in `[motions]`.",
        "several table channels": 'If one of them is not on the table, change its `on`, or set `quantity = "other"`.',
        "sign": "Turn `direction` or the sign of the `gain` of the channel.",
        "specimen": "Compare dimensions, mass and measured values of the specimen; one of them is wrong.",
        "swapped channels": "Exchange the `column` of the two channels, or their positions.",
        "time scale": "Correct the `time_scale` of the test.",
        "unit": "Compare `unit`, `range` and `column` of the channel with the header of the file.",
        "unused column": "Correct the head of the column if it was meant as a key.",
    },
    RECORDING: {
        "channel left out": "Give the test another `zero` or `window`, or `[[exclude]]` the channel.",
        "impossible angle": "Look for a wrong gain or unit, or a code such as -9999 for missing values.",
        "record ends in motion": "Find the whole file; else the outcome is that on a table at rest from its end on.",
        "rest": "Look at the transducers and the video: it probably overturned, or a cable tore.",
        "end of the range": "Keep it if the peaks that matter are within the range; else `[[flag]]` the stretch.",
        "fewer transducers": "See why the others could not be used; the angle has less redundancy.",
        "flat stretch": "`[[flag]]` the stretch as failed if the block moved during it.",
        "missing samples": "Short gaps are bridged; `[[trim]]` one at the end; next to strong motion, repeat the test.",
        "no rocking angle": "See the findings before it; a usable displacement transducer on the specimen is needed.",
        "no steady sine": "`[[trim]]` the test to the part with a steady motion, if it has one.",
        "single shock": "If it is a blow, `[[flag]]` that window of the channel as failed.",
        "spikes": "They are bridged; `[[flag]]` the stretch if what is left is wrong.",
        "zero": "Look at the rests before and after; `[[flag]]` or `[[exclude]]` the channel if it was moved.",
    },
    LABORATORY: {
        "AC coupling": "Use a coupling that passes slow changes (DC), and no high-pass.",
        "clock": "Record a common channel on both recorders, or a common trigger.",
        "cut motion": "Start the recorder earlier; see whether the table followed its command.",
        "cut record": "Find the whole file, or repeat the test and stop all recorders at rest.",
        "dead channel": "Check cable, sensor, core and range; `[[exclude]]` the channel for this test.",
        "gravity": "Use a coupling that passes constant values (DC), and do not zero the sensor in the recorder.",
        "hum": "Ground and shield the cable; until then set `base_lowpass` below the hum.",
        "late recorder": "Align the recorder by what both see (`clock`), or give the `delay` of the channel.",
        "lost samples": "Check the recorder's buffer, disk and rate.",
        "table motion": "Check which column and recorder each table channel is read from.",
        "time column": "Check the recorder's clock; the even clock that fits best is used.",
        "vertical motion": "Check gain, direction and zero of the vertical accelerometer.",
    },
    RESULT: {
        "assessment": "Read the doubt with the answer on the page of real columns.",
        "bouncing": "e includes the loss of further contacts; release from a smaller angle.",
        "contact law": "The contact model does not reach the identified e; see the reason.",
        "energy balance": "Make `processing.predict.contact.step` smaller.",
        "forecast": "The file was altered or damaged; it is left out.",
        "ground motion": "See which records or components are left out of the assessment, and why.",
        "motion across": "The models in the plane ignore it; compare with the contact model.",
        "sampling rate": "Record faster, or expect the response to be too small by the share that the warning gives.",
        "moving table": "Was the table at rest? e of single impacts scatters more than impacts alone do.",
        "no restitution": "See the reason; release from a larger angle, or repeat the test.",
        "sliding": "Part of the loss is friction; a rougher base, or a smaller release.",
        "speed-dependent restitution": "Use e at the velocities that matter, or a law of restitution.",
        "three-dimensional rocking": "The first cycles are out of the plane and left out of the fit.",
        "two values of e": "Two estimators disagree: see both on the page of the test.",
        "unequal restitution": "The two sides differ in e; the value given is of both together.",
        "unequal sides": "Check `table_tilt`, and whether the block is as symmetric as given.",
        "zero drift": "Check the transducers' mounts and the warm-up of the recorder.",
    },
    NOTHING: {
        "clock drift": "It was corrected.",
        "excluded": "review.toml left the test out.",
        "planned": "The test waits for its raw file.",
        "rounded times": "The even clock behind the rounded times is used.",
    },
}
"""What to do about each kind of finding."""

LEAD = """# Messages by what to do

Findings come with a result: the test goes on. Their severity says how much they matter: **serious**, the results of
this test are wrong until it is corrected; **warning**, a result may be affected; **note**, the results are valid.
Errors end what they are about. Each text is as the code writes it, with … for what is filled in; the list is made from
the sources.

"""


def pages():
    """Make the page of findings and a page for each class of error."""
    found = findings()
    advised = {kind: advice for kinds in ACTIONS.values() for kind, advice in kinds.items()}
    if (known := {each.kind for each in found}) != advised.keys():
        raise ValueError(
            f"kinds of findings without advice: {sorted(known - advised.keys())}; "
            f"advice for kinds that nothing makes: {sorted(advised.keys() - known)}"
        )
    parts = [LEAD]
    for action, kinds in ACTIONS.items():
        parts.append(f"## {action}\n\n")
        parts += [
            section(kind, advice, [each for each in found if each.kind == kind]) for kind, advice in kinds.items()
        ]
    raised = errors()
    parts.append("## Errors\n\n" + table(("what to do", "what it means"), [linked(*each) for each in ERRORS.items()]))
    parts.append(contents([f"errors/{name}" for name in ERRORS]).replace(":maxdepth: 1", ":hidden:"))
    made = {f"errors/{name}.md": page(name, [each for each in raised if each.kind == name]) for name in ERRORS}
    return made | {"messages.md": "".join(parts)}


def linked(name, words):
    """Link a class of error to its page."""
    return f"[{words[0]}](errors/{name}.md)", words[1]


def section(kind, advice, found):
    """Write a kind of finding: severities, what to do, texts."""
    severities = ", ".join(each for each in SEVERITIES if each in {one.severity for one in found})
    texts = dict.fromkeys(shown(each.text) for each in found if each.text)
    listed = "".join(f"- {text}\n" for text in texts)
    return f"### {kind}\n\n*{severities}.* {advice}\n\n{listed}\n"


def page(name, raised):
    """List the texts of a class of error, by the module that raises them."""
    action, meaning = ERRORS[name]
    parts = [f"# {action}\n\n{meaning} (`colonnade.errors.{name}`)\n\n".replace("errors.UsageError", "UsageError")]
    for module in dict.fromkeys(each.module for each in raised):
        texts = dict.fromkeys(shown(each.text) for each in raised if each.module == module)
        parts.append(f"## `{module.removeprefix('colonnade.')}`\n\n" + "".join(f"- {text}\n" for text in texts) + "\n")
    return "".join(parts).replace("(`colonnade.UsageError`)", "")


def shown(text):
    """Write a text as it is, so that none of it is taken for Markdown."""
    flat = re.sub("…+", "…", cell(text)).replace("\\|", "|")
    fence = "``" if "`" in flat else "`"
    return f"{fence} {flat} {fence}" if fence == "``" else f"`{flat}`"
