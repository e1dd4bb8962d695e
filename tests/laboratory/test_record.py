"""The record that the virtual table plays: a file of one's own, or El Centro."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from colonnade.errors import ReadError
from colonnade.laboratory.programme import load_record


@pytest.mark.parametrize("heading", ["time (s),acceleration (g)\n", ""], ids=["unit told", "no unit told"])
def test_a_file_of_ones_own_is_played_under_its_name_whatever_its_unit(heading: str, tmp_path: Path) -> None:
    path = tmp_path / "north.csv"
    values = 0.2 * np.sin(np.arange(200))
    rows = [f"{0.01 * k:.2f},{value:.6f}" for k, value in enumerate(values)]
    path.write_text(heading + "\n".join(rows) + "\n")
    name, motion = load_record(path)
    assert name == "north"
    assert motion.dt == pytest.approx(0.01)
    np.testing.assert_allclose(motion.acceleration / motion.peak, values / np.abs(values).max(), atol=1e-4)


def test_a_file_in_which_nothing_moves_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "still.csv"
    path.write_text("time (s),acceleration (g)\n" + "".join(f"{0.01 * k:.2f},0.0\n" for k in range(50)))
    with pytest.raises(ReadError, match="every acceleration is zero"):
        load_record(path)
