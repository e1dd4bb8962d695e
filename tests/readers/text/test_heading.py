"""Names and units are taken apart as people write them."""

from colonnade.readers.text.heading import looks_like_unit, take_apart
from every import every


@every(
    ("heading", "name", "unit"),
    [
        ("LVDT 1 [mm]", "LVDT 1", "mm"),
        ("Time (s)", "Time", "s"),
        ("Kraft/kN", "Kraft", "kN"),
        ("Weg in mm", "Weg", "mm"),
        ("ACC [m/s^2]", "ACC", "m/s^2"),
        ("Dehnung [µε]", "Dehnung", "µε"),
        ("Angle []", "Angle", None),
        ("Time [s] - Plot 0", "Time - Plot 0", "s"),
        ("Amplitude (mm) - Plot 0", "Amplitude - Plot 0", "mm"),
    ],
)
def test_a_unit_is_split_off_also_in_front_of_a_graphs_name(heading, name, unit):
    assert take_apart(heading) == (name, unit)


WITHOUT = ["Accel (top)", "LVDT [3]", "Table accel XXXX", "input/output", "[mm]", "distance in front"]
WITHOUT += ["Table [North] - Plot 0"]


@every("heading", WITHOUT)
def test_what_is_no_unit_stays_with_the_name(heading):
    assert take_apart(heading) == (heading, None)


@every(
    "text",
    ["mm", "m/s²", "m/s^2", "g's", "Volts", "seconds", "kN", "°", "deg", "%", "mV/V", "[mm]", "N*m", "Hz", "mm."],
)
def test_units_are_known_by_their_spelling(text):
    assert looks_like_unit(text)


@every("text", ["", "top", "LVDT 1", "ACC", "Kraft", "12", "Table", "mmm/"])
def test_names_are_no_units(text):
    assert not looks_like_unit(text)


@every("sign", ["a", "a ", "(", "/"])
def test_a_heading_as_long_as_a_damaged_file_costs_no_time(sign):
    assert take_apart(sign * 100_000) == (sign * 100_000, None)
