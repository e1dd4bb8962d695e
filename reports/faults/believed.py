"""Faults of what is believed of a recording: its scales, signs and places, and how the test was done."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from colonnade.arrays import Array
from colonnade.dynamics.motion import Motion
from faults.fault import (
    BOTTOM,
    TABLE,
    TIME,
    TOP,
    Fault,
    Group,
    Picture,
    channel_line,
    in_campaign,
    in_file,
    processing,
    review,
    swapped,
    times,
)
from faults.pictures import ROTATION, filtered, motions, pair, signals, tables
from faults.sound import RATE, earthquake, write_motion

QUAKE, SINE, FREE = (5.0, 7.0), (2.5, 4.0), (1.3, 5.0)
"""s: windows of the pictures."""

SCALES = Group(
    "scales",
    "Gain, unit, sign, place",
    "The recording is good; what campaign.toml says of it is not. Two transducers at different heights show the same "
    "rotation if both are right, and the equation of motion says how large it must be: from that colonnade names the "
    "wrong one ([how](../explanation/angle.md#which-one-is-wrong)).",
    (
        Fault(
            name="Gain ten times too large",
            test="quake",
            happens="A zero too many in the gain, or a range switch of the amplifier that nobody wrote down.",
            plant=channel_line("rig", "top", "15 mm/V", "150 mm/V"),
            message=r"channel top shows (9\.\d+|10(\.\d)?) times the rotation .* that bottom shows: a gain wrong by a "
            "factor of 10",
            picture=pair(QUAKE, "With the fault, top turns ten times as far as bottom."),
            mend="Correct the gain in campaign.toml. If only some tests were recorded with the other range, correct "
            "those in review.toml.",
            mending=review('[[correct]]\ntest = "quake"\nchannel = "top"\nfactor = 0.1'),
        ),
        Fault(
            name="Inches read as millimetres",
            test="free",
            happens="The recorder's software was set to inches for one transducer.",
            plant=in_file("free.csv", times(BOTTOM, 1 / 25.4)),
            message=r"channel bottom shows 0.0[34]\d* times the rotation .* that top shows: inches read as mm",
            picture=pair(FREE, "With the fault, bottom hardly turns."),
            mend="Correct the channel, here for one test; if all tests have it, correct its `unit` and `gain`.",
            mending=review('[[correct]]\ntest = "free"\nchannel = "bottom"\nfactor = 25.4'),
        ),
        Fault(
            name="Acceleration in another unit",
            test="sine",
            happens="The gain of the accelerometer was copied without its unit.",
            plant=channel_line("rig", "table_acceleration", "0.2 g/V", "0.2 m/s^2/V"),
            message=r"table_acceleration is 0.10\d* ± \S+ times the second derivative of table_displacement: one of "
            r"the two is wrong, table_acceleration or table_displacement \(the specimen's rocking asks for 9\.\d+ × "
            r"table_acceleration\); g read as m/s²",
            picture=tables(SINE, "With the fault, the accelerometer shows a tenth."),
            mend="Correct the unit of the gain.",
            mending=channel_line("rig", "table_acceleration", r"0\.2 m/s\^2/V", "0.2 g/V"),
        ),
        Fault(
            name="Sign of a transducer",
            test="sine",
            happens="A transducer was mounted from the other side, so that its rod goes in when the top moves to +x.",
            plant=in_file("sine.csv", times(BOTTOM, -1.0)),
            message="channel bottom turns opposite to top: with its sign reversed",
            picture=pair(SINE, "With the fault, top and bottom turn against each other."),
            mend="Turn `direction` of the channel in campaign.toml, or correct the tests that have it.",
            mending=channel_line("rig", "bottom", r"direction = \[1, 0, 0\]", "direction = [-1, 0, 0]"),
        ),
        Fault(
            name="Sign of the table",
            test="sine",
            happens="The accelerometer of the table was mounted the other way round.",
            plant=in_file("sine-daq2.csv", times(TABLE, -1.0)),
            message=r"opposite signs: one of the two is wrong, table_acceleration or table_displacement \(the "
            r"specimen's rocking asks for -(1|0\.9\d+|1\.0\d*) × table_acceleration",
            picture=tables(SINE, "With the fault, the two are mirror images."),
            mend="Turn its `direction`, or correct the tests that have it.",
            mending=review('[[correct]]\ntest = "sine"\nchannel = "table_acceleration"\nfactor = -1'),
        ),
        Fault(
            name="Swapped channels",
            test="free",
            happens="Two plugs were exchanged at the recorder.",
            plant=in_file("free.csv", swapped),
            message=r"channels top and bottom look swapped: .* falls from [\d.]+ to 0\.0\d+ mm",
            picture=pair(FREE, "With the fault, neither shows the rotation of the block."),
            mend="Exchange the two columns in campaign.toml.",
            mending=in_campaign(r'(?s)(frame\.channels\].*?)"LVDT 1"(.*?)"LVDT 2"', r'\g<1>"LVDT 2"\g<2>"LVDT 1"'),
        ),
        Fault(
            name="Wrong position",
            test="free",
            happens="The height of a transducer was measured from the middle of the block, not from its base.",
            plant=channel_line("frame", "top", "440 mm", "212 mm"),
            message=r"channel top shows 2\.0\d* times the rotation .* that bottom shows",
            picture=pair(FREE, "With the fault, top seems to turn twice as far."),
            mend="Correct `at` in campaign.toml. `colonnade check --drawing FILE.svg` draws where the transducers are.",
            mending=channel_line("frame", "top", "212 mm", "440 mm"),
        ),
        Fault(
            name="Another specimen",
            test="free",
            happens="The sizes are those of the block that was tested the day before.",
            plant=in_campaign('height = "456 mm"', 'height = "912 mm"'),
            message=r"channels top and bottom all show 3\.\d+ times the rotation .* a height × 0\.\d+",
            picture=pair(FREE, "The recordings are the same: only the equation of motion disagrees."),
            mend="Give the sizes of the specimen that was tested. If they are right, look at the sampling rate.",
            mending=in_campaign('height = "912 mm"', 'height = "456 mm"'),
        ),
    ),
)


def _slipped(samples: Array) -> Array:
    samples[samples[:, TIME] > 5.0, TOP] += 0.2
    return samples


def _stopped(samples: Array) -> Array:
    return samples[int(1.9 * RATE) : int(8.0 * RATE)]


def _valley(folder: Path, sign: int) -> None:
    write_motion(folder / "valley.csv", Motion(sign * earthquake(1).acceleration, earthquake(1).dt))


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
            message="e of single impacts scatters by .*: the table moves, and not as recorded, or somebody touched",
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
            message="a critical angle, or a gain of the angle, that differs by",
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
            plant=partial(_valley, sign=-1),
            message='moved as "Valley" with the other polarity',
            picture=motions("With the fault, the two are mirror images."),
            mend="If the table was driven with the other sign on purpose, give that record as the reference. If not, "
            "the sign of the table's acceleration is wrong.",
            mending=partial(_valley, sign=1),
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
