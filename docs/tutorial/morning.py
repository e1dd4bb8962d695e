"""
Write the raw files of one morning at a shake table that is virtual, so that what is true is known.

`python morning.py` makes three things: the folder `morning` with the raw files of two recorders and the wiring sheet of
the laboratory, in which one gain is wrong; `valley.csv`, the record that the table was to follow; and the folder
`virtual`, which has the truth.
"""

import math
import shutil
from pathlib import Path

from colonnade import Block, Motion
from colonnade.laboratory.files import GERMAN
from colonnade.laboratory.plan import Plan, Recorder, Trial
from colonnade.laboratory.runs import write
from colonnade.laboratory.site import synthetic_records
from colonnade.laboratory.table import ramped_sine, recorded

RESTITUTION = 0.94
SCALE = 10
QUIET = 1.5  # s before the table moves
SHEET = """\
Prüfkörper  limestone prism 1:10, 100 x 100 x 500 mm, 11.50 kg
Fangrahmen  catches it at 0.35 rad

Kanal      what it is                                              gain       range
LVDT 1     on the table's frame, to the side face at z = 440 mm    15 mm/V    10 V
LVDT 2     on the table's frame, to the side face at z = 40 mm     15 mm/V    10 V
Tischweg   displacement of the table                               5 mm/V     10 V
ACC        accelerometer on the table, second recorder             0.2 g/V    10 V
"""

VOLTS = 'unit = "V", range = "10 V", direction = [1, 0, 0]'
SEEN = f'quantity = "displacement", on = "specimen", relative_to = "table", {VOLTS}'
SHAKEN = f'quantity = "acceleration", on = "table", {VOLTS}'
FRAME = f"""
top = {{column = "LVDT 1", gain = "15 mm/V", at = ["50 mm", "0 mm", "440 mm"], {SEEN}}}
bottom = {{column = "LVDT 2", gain = "1.5 mm/V", at = ["50 mm", "0 mm", "40 mm"], {SEEN}}}
"""
TRUE = f"""
schema = 1
campaign = "morning"
title = "A morning at the shake table"

[specimens]
prism = {{shape = "prism", width = "100 mm", depth = "100 mm", height = "500 mm", mass = "11.50 kg"}}

[setups.bench.channels]{FRAME}
[setups.table]
catch = "0.35 rad"
recorders.daq2.clock.align = ["table_displacement", "table_acceleration"]

[setups.table.channels]{FRAME}
table_displacement = {{column = "Tischweg", gain = "5 mm/V", quantity = "displacement", on = "table", {VOLTS}}}
table_acceleration = {{column = "ACC", recorder = "daq2", gain = "0.2 g/V", {SHAKEN}}}
"""

block = Block.prism(width=0.100, depth=0.100, height=0.500, mass=11.50)
main, daq2 = Recorder(500.0, GERMAN), Recorder(400.0, late=0.3)


def free(number, ratio):
    """Plan a free vibration: the specimen is released from this part of its critical angle."""
    held = {"theta0": ratio * block.critical_angle, "release": 1.3 + 0.1 * number}
    return Trial(f"free-{number}", "free-vibration", "bench", duration=12.0, **held)


def sine(frequency, amplitude):
    """Plan a sine test (Hz, a over g tan α): 4 s of full amplitude between two ramps."""
    size = amplitude * block.uplift_acceleration
    shaking = ramped_sine(frequency, size, start=QUIET, cycles=round(4 * frequency), ramp=3)
    return Trial(f"sine-{frequency}Hz", "sine", "table", duration=shaking.stop + 4.0, table=shaking)


def quake(number, motion, peak):
    """Plan an earthquake with a peak in m/s²; at the scale of the model its time is shorter."""
    scaled = Motion(motion.acceleration * peak / motion.peak, motion.dt / math.sqrt(SCALE))
    shaking = recorded(scaled, start=QUIET)
    return Trial(f"quake-{number}", "earthquake", "table", duration=shaking.stop + 5.0, table=shaking, spikes=3)


valley = synthetic_records(count=2)[1].motion
plan = Plan(
    TRUE,
    {"prism": RESTITUTION},
    {"bench": {"main": main}, "table": {"main": main, "daq2": daq2}},
    (free(1, 0.6), free(2, -0.5), free(3, 0.7), sine(3, 1.6), sine(5, 1.6), quake(1, valley, 3.5)),
)
write(plan, "virtual", seed=1)
shutil.copytree("virtual/raw", "morning/raw", dirs_exist_ok=True)
Path("morning/sheet.txt").write_text(SHEET, encoding="utf-8")
rows = "".join(f"{k * valley.dt:.2f},{value:.6f}\n" for k, value in enumerate(valley.acceleration))
Path("valley.csv").write_text("time (s),acceleration (m/s^2)\n" + rows, encoding="utf-8")
