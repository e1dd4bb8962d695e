"""A recording that another laboratory published, as a campaign with a measured specimen."""

import pytest

pytestmark = pytest.mark.whole

WOODEN_BLOCK = """
schema = 1
campaign = "wooden-block"
title = "Shake table with a block on it"
[specimens.statue]
shape = "measured"
mass = "80 kg"
pole_distance = "610 mm"
critical_angle = "0.21 rad"
inertia = "41.2 kg m^2"
restitution = 0.9
[setups.table.channels]
drive = {column = "Output To Table", quantity = "other", unit = "V"}
light = {column = "LED Light", quantity = "other"}
table = {column = "Table accel XXXX", quantity = "acceleration", unit = "g's", on = "table", direction = [1, 0, 0]}
block = {column = 5, quantity = "acceleration", unit = "g's", on = "specimen", direction = [1, 0, 0]}

[[tests]]
id = "sine-2Hz"
kind = "sine"
frequency = "2 Hz"
specimen = "statue"
setup = "table"
file = "raw/thadhaines_01.csv"
zero = ["3.75 s", "6.15 s"]
observed_outcome = "no-rocking"
"""
