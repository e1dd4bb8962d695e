"""What names say of components."""

from colonnade.readers.ground_motions.files import direction_of, named
from every import every


@every(
    ("name", "record", "direction"),
    [
        ("lefkada_x.csv", "lefkada", "x"),
        ("Lefkada-NS.txt", "Lefkada", "y"),
        ("station 3 up.mseed", "station 3", "z"),
        ("RSN6_IMPVALL.I_I-ELC180.AT2", "RSN6_IMPVALL.I_I-ELC", "180"),
        ("RSN6_IMPVALL.I_I-ELC-UP.AT2", "RSN6_IMPVALL.I_I-ELC", "z"),
        ("AOM0011903.UD", "AOM0011903", "z"),
        ("AOMH0119.NS2", "AOMH01192", "y"),
        ("GR.KRP.HNE.sac", "GR.KRP.HN", "x"),
        ("GR.KRP.HNZ.D.2014.sac", "GR.KRP.HN.D.2014", "z"),
        ("pulse-180.csv", "pulse-180", ""),
        ("athens.csv", "athens", ""),
        ("ACHE.csv", "ACHE", ""),
        ("record", "record", ""),
        ("north.csv", "north", "y"),
    ],
)
def test_files(name, record, direction):
    assert named(name) == (record, direction)


@every(
    ("head", "direction"),
    [
        ("NS [cm/s^2]", "y"),
        ("acc x (g)", "x"),
        ("HNZ", "z"),
        ("Acceleration", ""),
        ("U-D", "z"),
        ("exx", ""),
    ],
)
def test_columns(head, direction):
    assert direction_of(head)[0] == direction
