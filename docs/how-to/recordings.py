"""
Write small raw files of known truth into `raw/`: the recordings that the how-to pages work with.

A limestone prism of 100 x 100 x 500 mm with e = 0.94 is tilted and released, or shaken by a sine of 3 Hz.
"""

from pathlib import Path

import numpy as np

from colonnade import Block, Motion, rock
from colonnade.dynamics.kinematics import point_displacement
from colonnade.laboratory.table import ramped_sine

PRISM = Block.prism(width=0.100, depth=0.100, height=0.500, mass=11.50)
STATUE = Block.measured(mass=11.2, pole_distance=0.255, critical_angle=(0.190, 0.205), inertia=0.98)
RESTITUTION, RATE, QUIET = 0.94, 200.0, 1.0
GRAVITY = 9.80665
RAW = Path("raw")

noise = np.random.default_rng(1)


def put(name, head, *columns, delimiter=",", decimal=".", encoding="utf-8"):
    """Write columns as text."""
    rows = [delimiter.join(f"{value:.5f}" for value in row) for row in zip(*columns, strict=True)]
    text = "\n".join([head, *(row.replace(".", decimal) for row in rows), ""])
    (RAW / name).write_text(text, encoding=encoding)


def released(block, ratio, duration=10.0):
    """Time and angle of a specimen that is held, then released."""
    held = int(QUIET * RATE)
    theta0 = ratio * (block.positive if ratio > 0 else block.negative).critical_angle
    history = rock(block, restitution=RESTITUTION, theta0=theta0, duration=duration)
    time = np.arange(int((QUIET + duration) * RATE)) / RATE
    angle = np.interp(time - QUIET, history.time, history.angle)
    angle[:held] = theta0
    return time, angle


def points(block, angle, *heights):
    """Displacements of points on the side face, at these heights, m."""
    return [point_displacement(angle, [block.positive.half_width, 0.0, z], block)[0, :, 0] for z in heights]


def blurred(values, spread):
    """Values with noise."""
    return values + spread * noise.standard_normal(values.size)


def surface(block, angle, height):
    """Displacement at which a horizontal laser at this height sees the side face, m."""
    width = 2 * block.positive.half_width
    raised = np.where(angle < 0, width * np.sin(-angle), 0.0)
    pushed = np.where(angle < 0, -width * (1 - np.cos(angle)), 0.0)
    return pushed + (height - raised) * np.tan(angle)


RAW.mkdir(exist_ok=True)

for number, ratio in enumerate((0.6, -0.5, 0.7), start=1):
    time, angle = released(PRISM, ratio)
    top, bottom = (blurred(1000 * each, 0.02) for each in points(PRISM, angle, 0.44, 0.04))
    put(f"free-{number}.csv", "Time [s],top [mm],bottom [mm]", time, top, bottom)

head = "Messung 7: Säule aus Kalkstein\nBereich ±150 mm; Fehlwert -999\n\nZeit;Weg oben;Weg unten"
holes = np.where(np.arange(top.size) % 997 == 600, -999.0, bottom)
put("odd.txt", head, 1000 * time, top, holes, delimiter=";", decimal=",", encoding="latin-1")

rate = np.degrees(np.gradient(angle, time))
put("gyro.csv", "Time [s],gyro [deg/s],top [mm]", time, blurred(rate + 0.4, 0.05), top)

time, angle = released(STATUE, 0.6)
top, bottom = (blurred(1000 * each, 0.02) for each in points(STATUE, angle, 0.44, 0.04))
put("statue.csv", "Time [s],top [mm],bottom [mm]", time, top, bottom)

shaking = ramped_sine(3.0, 1.6 * PRISM.uplift_acceleration, start=QUIET, cycles=12, ramp=2)
time = np.arange(int((shaking.stop + 3.0) * RATE)) / RATE
base = shaking.acceleration(time)
angle = rock(PRISM, Motion(base, 1 / RATE), restitution=RESTITUTION).angle
top, bottom = (blurred(1000 * each, 0.02) for each in points(PRISM, angle, 0.44, 0.04))
table, acceleration = blurred(1000 * shaking.displacement(time), 0.005), blurred(base / GRAVITY, 0.001)
put("sine-3Hz.csv", "Time [s],top [mm],bottom [mm],table [mm]", time, top, bottom, table)

late = time[time > 0.25][::2]
base = np.interp(late, time, acceleration)
put("sine-3Hz-second.csv", "Time [s],table acc [g]", late - late[0], base)

lasers = (blurred(1000 * (surface(PRISM, angle, z) + shaking.displacement(time)), 0.02) for z in (0.44, 0.04))
put("lasers.csv", "Time [s],top [mm],bottom [mm],table [mm],table acc [g]", time, *lasers, table, acceleration)
