"""Faults of how a test was done: it is not what the campaign says it is."""

from __future__ import annotations

from pathlib import Path

from colonnade.arrays import Array
from colonnade.dynamics.motion import Motion
from faults.curves import ROTATION, filtered, motions, pair, signals
from faults.fault import Fault, Group, Picture
from faults.planting import TIME, TOP, in_campaign, in_file, processing, review
from faults.sound import RATE, earthquake, write_motion


def _slipped(samples: Array) -> Array:
    samples[samples[:, TIME] > 5.0, TOP] += 0.2
    return samples


def _stopped(samples: Array) -> Array:
    return samples[int(1.9 * RATE) : int(8.0 * RATE)]


def _turned(folder: Path) -> None:
    write_motion(folder / "valley.csv", Motion(-earthquake(1).acceleration, earthquake(1).dt))


def _turned_back(folder: Path) -> None:
    write_motion(folder / "valley.csv", earthquake(1))


COURSE = Group(
    "course",
    "The course of a test",
    "Every channel may be right, and the test still not be the one that campaign.toml describes.",
    (
        Fault(
            name="Zero that moves",
            test="free",
            happens="A transducer slipped in its clamp by 3 mm.",
            plant=in_file("free.csv", _slipped),
            message=r"the zero of the angle drifts by \+\d+\.\d+ ± \d\.\d+ mrad over the arcs",
            picture=pair((3.5, 7.0), "With the fault, top and bottom differ until 5 s."),
            mend="Use the part of the test after it, or leave the channel out.",
            mending=review('[[trim]]\ntest = "free"\nwindow = ["5.1 s", "22 s"]'),
            command="run",
        ),
        Fault(
            name="Recording that stops too early",
            test="free",
            happens="Started after the release, stopped while the block still rocked: it is at rest at neither end.",
            plant=in_file("free.csv", _stopped),
            message="the zero of the rocking angle is uncertain by .* Record until the specimen is still",
            picture=pair((1.9, 8.0), "With the fault, no zero can be read off."),
            mend="Test again, and record half a second of rest at one end at least. If the block was upright "
            "and still in some stretch, give it to the test as its `zero`.",
        ),
        Fault(
            name="Table that moves in a free vibration",
            test="shaken",
            happens="The actuator was left on, and the table's motion was not recorded with the block's.",
            plant=in_campaign(
                r'setup = "rig"\nfile = \{main = ("raw/shaken.csv"), daq2 = "raw/shaken-daq2.csv"\}',
                r'setup = "frame"\nfile = \1',
            ),
            message="e of single impacts scatters by .*: the table moves, or somebody touched the block",
            picture=Picture(
                signals("top", "table_displacement"),
                "reading, mm",
                (4.0, 10.0),
                "With the fault, the table's motion is missing; the block looks as in any free vibration.",
            ),
            mend="Record the table in every test. If its acceleration was recorded, name its file: it then drives the "
            "history from which e is found.",
            mending=in_campaign(
                r'setup = "frame"\nfile = "raw/shaken.csv"',
                'setup = "rig"\nfile = {main = "raw/shaken.csv", daq2 = "raw/shaken-daq2.csv"}',
            ),
            command="run",
        ),
        Fault(
            name="Low-pass that is too low",
            test="free",
            happens="A cut-off was chosen for a smooth picture.",
            plant=processing('lowpass = "4 Hz"'),
            message="no restitution from this test",
            picture=Picture(filtered, ROTATION, (10.0, 13.0), "With the fault, small arcs lose their height."),
            mend="Leave `lowpass` out: the default follows from the specimen "
            "([how much it takes off](../explanation/filter.md)).",
            mending=in_campaign('\n\\[processing\\]\nlowpass = "4 Hz"\n', "\n"),
            command="run",
        ),
        Fault(
            name="Another motion",
            test="quake",
            happens="The operator loaded another file than the log says.",
            plant=in_campaign('motion = "Valley"', 'motion = "Hill"'),
            message=r'the table did not move as "Hill" at time scale 0.25 .*: it moved as "Valley" \((0.9\d|1.00)\)',
            picture=motions("With the fault, the two differ throughout."),
            mend="Correct the name of the motion.",
            mending=in_campaign('motion = "Hill"', 'motion = "Valley"'),
        ),
        Fault(
            name="Other polarity",
            test="quake",
            happens="The reference record has the other sign than the motion that the table was given.",
            plant=_turned,
            message='moved as "Valley" with the other polarity',
            picture=motions("With the fault, the two are mirror images."),
            mend="If the table was driven with the other sign on purpose, give that record as the reference. If not, "
            "the sign of the table's acceleration is wrong.",
            mending=_turned_back,
        ),
        Fault(
            name="Other time scale",
            test="quake",
            happens="The motion was compressed for another model scale: √(1/20) instead of 1/4.",
            plant=in_campaign(r"time_scale = 0\.25", "time_scale = 0.2236"),
            message=r"but with time scale 0\.(25|249\d|250\d) ",
            picture=motions("With the fault, the two run apart."),
            mend="Correct the time scale.",
            mending=in_campaign(r"time_scale = 0\.2236", "time_scale = 0.25"),
        ),
    ),
)
