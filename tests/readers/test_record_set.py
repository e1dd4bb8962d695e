"""Sets of ground motions: what belongs together, what is left out and why; one bad file stops no other."""

import hashlib
import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from colonnade.errors import ReadError
from colonnade.readers import record_set
from colonnade.readers.record_set import COLUMNS, Entry, direction_of, named, read_list, read_record_set
from every import every

G = 9.80665
EXAMPLES = Path(__file__).parents[2] / "raw_schema" / "examples"


def shaken(size=200, seed=0):
    return np.round(np.random.default_rng(seed).standard_normal(size), 4)


def columns(path, unit="m/s^2", interval=0.01, size=200, seed=0, names=("acc",)):
    values = np.column_stack([np.arange(size) * interval, *(shaken(size, seed + k) for k in range(len(names)))])
    heads = ",".join(["time [s]", *(f"{name} [{unit}]" for name in names)])
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(heads + "\n" + "\n".join(",".join(f"{cell:.6g}" for cell in row) for row in values) + "\n")
    return path


def test_files_of_a_folder_are_put_together_by_their_names(tmp_path):
    for seed, name in enumerate(("lefkada_x.csv", "lefkada_y.csv", "lefkada_z.csv", "pulse.csv")):
        columns(tmp_path / name, unit="g", seed=seed)
    found = read_record_set(tmp_path)
    assert (found.left_out, found.notes) == ({}, ())
    lefkada, pulse = found.records
    assert (lefkada.name, lefkada.components) == ("lefkada", ("x", "y", "z"))
    assert (pulse.name, pulse.components) == ("pulse", ("",))
    along = lefkada.motion.acceleration, lefkada.motion.transverse, lefkada.motion.vertical
    for seed, values in enumerate(along):
        np.testing.assert_allclose(values, G * shaken(seed=seed), rtol=1e-12)
    assert lefkada.motion.dt == pytest.approx(0.01)
    assert dict(lefkada.files)["lefkada_y.csv"] == hashlib.sha256((tmp_path / "lefkada_y.csv").read_bytes()).hexdigest()


def test_columns_of_a_file_are_the_components_that_their_heads_say(tmp_path):
    columns(tmp_path / "site.csv", names=("NS", "UD", "EW"))
    (record,) = read_record_set(tmp_path).records
    assert record.components == ("x", "y", "z")
    np.testing.assert_allclose(record.motion.acceleration, shaken(seed=2))
    np.testing.assert_allclose(record.motion.transverse, shaken(seed=0))
    np.testing.assert_allclose(record.motion.vertical, shaken(seed=1))


def test_formats_of_strong_motion_are_read(tmp_path):
    peer = (EXAMPLES / "peer/raw/pulse-01.AT2").read_bytes()
    for name in ("RSN1_A-ELC180.AT2", "RSN1_A-ELC270.AT2", "RSN1_A-ELC-UP.AT2"):
        (tmp_path / name).write_bytes(peer)
    (tmp_path / "cosmos.V2").write_bytes((EXAMPLES / "cosmos/raw/pulse-01.V2").read_bytes())
    found = read_record_set(tmp_path)
    assert found.left_out == {}
    assert [(record.name, record.components) for record in found.records] == [
        ("RSN1_A-ELC", ("180", "270", "z")),
        ("cosmos", ("",)),
    ]


def test_records_of_networks_have_the_components_that_they_name(shared_data):
    found = read_record_set(shared_data / "strongmotion")
    components = {record.name: record.components for record in found.records}
    assert components["AOM0011801241951"] == ("x", "y", "z")
    assert "5526-1" not in components  # BHRC, refused by name


def test_what_is_broken_is_named_and_left_out_and_the_rest_is_read(tmp_path):
    columns(tmp_path / "elsewhere" / "secret.csv")
    text = columns(tmp_path / "good.csv").read_text()
    two = columns(tmp_path / "two.csv", names=("first", "second")).read_text()
    still = "time [s],acc [g]\n" + "".join(f"{0.01 * k:.2f},0\n" for k in range(50))
    broken = {
        "empty.csv": ("", "empty"),
        "head.csv": ("time [s],acc [g]\n", ""),
        "unit.csv": (text.replace(" [m/s^2]", ""), "unit"),
        "uneven.csv": (text.replace("\n0.05,", "\n0.055,"), "not equally spaced"),
        "short.csv": ("".join(text.splitlines(keepends=True)[:7]), "it has 6 samples"),
        "still.csv": (still, "a peak above 0"),
        "volts.csv": (text.replace("m/s^2", "V"), "acceleration"),
        "huge.csv": (text.replace("m/s^2", "km/s^2"), "Check its unit"),
        "slow.csv": (text.replace("time [s]", "time [min]"), "0.6 s apart"),
        "gap.csv": (text.replace("\n0.05,", "\n0.05,x#"), "missing"),
        "README.md": ("# Records\n\nFrom a stranger.\n", ""),
        "two.csv": (two, '"first [m/s^2]", "second [m/s^2]"'),
    }
    for name, (content, _) in broken.items():
        (tmp_path / name).write_text(content)
    (tmp_path / "noise.bin").write_bytes(np.random.default_rng(0).bytes(5000))
    os.mkfifo(tmp_path / "pipe.csv")
    (tmp_path / "link.csv").symlink_to("/etc/hostname")
    (tmp_path / "gone.csv").symlink_to("nowhere.csv")
    expected = {name: told for name, (_, told) in broken.items()}
    expected |= {"pipe.csv": "a named pipe", "link.csv": "outside this folder", "gone.csv": "no such file"}
    found = read_record_set(tmp_path)
    assert [record.name for record in found.records] == ["good"]
    told = found.left_out
    assert told.keys() == {*expected, "noise.bin"}
    for name, reason in expected.items():
        assert reason in told[name], name


def written(tmp_path, *rows, head="file,component,record,interval [ms],unit,scale,magnitude,distance [km]"):
    path = tmp_path / "records.csv"
    path.write_text("\n".join([head, *rows]) + "\n")
    return path


def test_a_list_says_what_files_do_not(tmp_path):
    (tmp_path / "deep").mkdir()
    np.savetxt(tmp_path / "deep" / "a.txt", shaken())
    np.savetxt(tmp_path / "b.txt", shaken(seed=1))
    listed = written(tmp_path, "deep/a.txt,x,Aigio,5,cm/s^2,-2,6.2,14", "b.txt,z,Aigio,5,g,,,")
    found = read_record_set(listed)
    assert found.left_out == {}
    (record,) = found.records
    assert (record.name, record.components, record.magnitude) == ("Aigio", ("x", "z"), 6.2)
    assert record.distance == pytest.approx(14_000.0)
    assert record.motion.dt == pytest.approx(0.005)
    np.testing.assert_allclose(record.motion.acceleration, -0.02 * shaken(), rtol=1e-12)
    np.testing.assert_allclose(record.motion.vertical, G * shaken(seed=1), rtol=1e-12)


def test_rows_that_cannot_be_used_are_left_out_of_a_list(tmp_path):
    columns(tmp_path / "set" / "a.csv")
    columns(tmp_path / "secret.csv")
    rows = [
        "a.csv,x,good,,,,,",
        "a.csv,x,good,,,,,",
        "a.csv,z,lone,,,,,",
        "../secret.csv,,,,,,,",
        f"{tmp_path}/secret.csv,,,,,,,",
        "missing.csv,,,,,,,",
        "a.csv,w,,,,,,",
        "a.csv,,,,,0,,",
        "a.csv,,,,,much,,",
        "a.csv,,,-5,,,,",
        "a.csv,,,,furlong,,,",
        ",x,nameless,,,,,",
    ]
    found = read_record_set(written(tmp_path / "set", *rows))
    assert [record.name for record in found.records] == ["good"]
    told = [*found.left_out.values()]
    for expected in (
        "has this component already",
        "no horizontal component",
        "outside the folder of the list",
        "an absolute path",
        "no such file",
        'component is "w"',
        'scale is "0"',
        '"much"',
        'interval is "-5 ms"; a number above 0',
        "furlong",
        "the cell of the file is empty",
    ):
        assert sum(expected in each for each in told) == 1, expected
    assert len(told) == len(rows) - 1


@pytest.mark.parametrize(
    ("row", "told"), [("a.csv,x,long,,,,,,,,more", "row 2: 11 cells"), ('"a.csv,x', "row 2: this is no")]
)
def test_a_list_with_rows_that_are_none_is_refused(tmp_path, row, told):
    with pytest.raises(ReadError, match=told):
        read_record_set(written(tmp_path, row))


def test_a_column_of_a_file_is_chosen_by_head_or_number(tmp_path):
    columns(tmp_path / "two.csv", names=("first", "second"))
    rows = ["two.csv,second,named", "two.csv,2,numbered"]
    found = read_record_set(written(tmp_path, *rows, head="file,column,record"))
    assert found.left_out == {}
    named, numbered = found.records
    np.testing.assert_allclose(named.motion.acceleration, shaken(seed=1))
    np.testing.assert_allclose(numbered.motion.acceleration, shaken(seed=0))


def test_components_are_cut_to_the_shortest_and_may_not_differ_in_step(tmp_path):
    columns(tmp_path / "a_x.csv", size=200)
    columns(tmp_path / "a_y.csv", size=150)
    columns(tmp_path / "b_x.csv")
    columns(tmp_path / "b_y.csv", interval=0.02)
    found = read_record_set(tmp_path)
    (record,) = found.records
    assert record.motion.acceleration.size == record.motion.transverse.size == 150
    assert "all are cut to 1.5 s" in found.notes[0]
    assert "0.01 s and 0.02 s" in found.left_out["b"]


@pytest.mark.parametrize(
    ("name", "most", "message"),
    [("LARGEST_FILE", 1000, "bytes are too many for a record"), ("MOST_SAMPLES", 300, "Divide the set")],
)
def test_what_is_too_large_is_left_out(tmp_path, monkeypatch, name, most, message):
    columns(tmp_path / "a.csv", size=20)
    columns(tmp_path / "b.csv", size=290)
    monkeypatch.setattr(record_set, name, most)
    found = read_record_set(tmp_path)
    assert [record.name for record in found.records] == ["a"]
    assert message in found.left_out["b.csv"]


def test_a_set_of_too_many_files_is_refused(tmp_path, monkeypatch):
    columns(tmp_path / "a.csv")
    columns(tmp_path / "b.csv")
    monkeypatch.setattr(record_set, "MOST_FILES", 1)
    with pytest.raises(ReadError, match="2 files are too many"):
        read_record_set(tmp_path)


def test_what_is_not_there_is_said(tmp_path):
    columns(tmp_path / "records.csv")
    with pytest.raises(ReadError, match=r'Did you mean "records\.csv"'):
        read_record_set(tmp_path / "record.csv")


MANY = settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
PARTS = [*COLUMNS, "[s]", "[", "]", "x", "../x", "/x", "1", "nan", "\0", '"', "é"]


@MANY
@given(
    st.one_of(
        st.text(max_size=200),
        st.lists(st.sampled_from(PARTS), max_size=40).map(
            lambda parts: ",".join(parts[:6]) + "\n" + ",".join(parts[6:])
        ),
    )
)
def test_whatever_is_written_is_read_or_refused(tmp_path, text):
    path = tmp_path / "list.csv"
    path.write_text(text, encoding="utf-8", errors="replace")
    left_out: dict[str, str] = {}
    try:
        entries = read_list(path, left_out, [])
    except ReadError as refusal:
        assert "list.csv" in str(refusal)  # noqa: PT017 - either outcome is right
        return
    assert all(isinstance(each, Entry) and each.path.is_relative_to(tmp_path) for each in entries)
    assert all(left_out.values())


@every("text", ["../a", "a/../../b", "/etc/passwd", "C:\\a", "\\\\host\\a", ".", "link/a"])
def test_a_path_stays_in_the_folder_of_the_list(tmp_path, text):
    if not (tmp_path / "link").is_symlink():
        (tmp_path / "link").symlink_to("/")
    (tmp_path / "list.csv").write_text(f"file\n{text}\na/../b\\c.csv\n")
    left_out: dict[str, str] = {}
    (entry,) = read_list(tmp_path / "list.csv", left_out, [])
    (reason,) = left_out.values()
    assert entry.path == tmp_path.resolve() / "b/c.csv"
    assert any(said in reason for said in ("outside the folder", "an absolute path", "an invalid path"))


@every(
    ("text", "message"),
    [
        ("", "the file is empty"),
        ("name,unit\na,g\n", 'no column "file"'),
        ("file,intervall\na,1\n", 'unknown column "intervall". Did you mean "interval"'),
        ("file,file\na,b\n", 'duplicate column head "file"'),
        ("file,component\na,x\n", '"component" without "record"'),
        ("\0\1\2\3file", "it is no text"),
    ],
)
def test_what_is_no_list_is_refused(path, text, message):
    path.write_text(text)
    with pytest.raises(ReadError, match=message):
        read_list(path, {}, [])


def test_units_are_in_heads_or_cells_and_other_columns_are_ignored(path):
    path.write_text("file;interval;unit;distance [km];who\na;0,01 s;g;12;me\nb;0.01;;;\n")
    left_out: dict[str, str] = {}
    notes: list[str] = []
    (entry,) = read_list(path, left_out, notes)
    assert (entry.interval, entry.unit, entry.distance) == (0.01, "g", 12_000.0)
    assert "has no unit" in left_out["record.raw, line 3"]
    assert '"who"' in notes[0]


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
def test_a_file_says_its_record_and_direction(name, record, direction):
    assert named(name) == (record, direction)


@every(
    ("head", "direction"),
    [("NS [cm/s^2]", "y"), ("acc x (g)", "x"), ("HNZ", "z"), ("Acceleration", ""), ("U-D", "z"), ("exx", "")],
)
def test_a_column_says_its_direction(head, direction):
    assert direction_of(head)[1] == direction
