"""How the specimens are wired: recorders, their links, and ranges that hold what happens."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.laboratory.experiment import MAIN
from colonnade.laboratory.files import COMMAS, GERMAN, TABS
from colonnade.laboratory.rig import (
    BOTTOM,
    LATE,
    PRISM_CATCH,
    TOP,
    bench,
    frame,
    prism_setups,
    shake_table,
    table_acceleration,
    table_displacement,
)
from colonnade.laboratory.table import still
from prism import PRISM


def test_a_frame_has_its_transducers_at_both_heights_of_the_specimens_side() -> None:
    top, bottom = frame((0.04, 0.05), (0.2, 0.02), ("A", "B"))
    assert (top.channel, top.column, top.full_scale, top.at) == ("top", "A", 0.2, (0.04, 0.0, TOP))
    assert (bottom.channel, bottom.column, bottom.full_scale, bottom.at) == ("bottom", "B", 0.02, (0.05, 0.0, BOTTOM))
    assert {each.relative_to for each in (top, bottom)} == {"table"}


def test_a_frame_wants_a_radius_and_a_range_for_each_transducer() -> None:
    with pytest.raises(ValueError, match="zip"):
        frame((0.04, 0.05), (0.2,))  # type: ignore[arg-type]


def test_a_bench_has_one_recorder_and_no_safety_frame() -> None:
    wired = frame((0.04, 0.04), (0.1, 0.1))
    setup = bench(wired, TABS)
    assert list(setup.recorders) == [MAIN]
    assert setup.recorders[MAIN].transducers == wired
    assert setup.recorders[MAIN].flavour is TABS
    assert setup.catch is None


def test_a_table_links_its_recorders_by_channels_that_each_of_them_has() -> None:
    wired, moved, pushed = frame((0.04, 0.04), (0.1, 0.1)), table_displacement(0.05, "Weg"), table_acceleration("A")
    setup = shake_table(wired, moved, pushed, main=GERMAN, second=COMMAS, catch=0.2)
    main, second = setup.recorders[MAIN], setup.recorders["daq2"]
    assert next(iter(setup.recorders)) == MAIN
    assert main.transducers == (*wired, moved)
    assert second.transducers == (pushed,)
    assert (main.flavour, second.flavour) == (GERMAN, COMMAS)
    assert second.align == (moved.channel, pushed.channel)
    assert main.sampling_rate_hz != second.sampling_rate_hz
    assert (main.late, second.late) == (0.0, LATE)
    assert setup.catch == 0.2


def test_the_accelerometer_reaches_two_standard_gravities() -> None:
    # 1 g = 9.80665 m/s² by the 3rd CGPM, 1901, whatever a laboratory's own gravity is.
    assert table_acceleration().full_scale == pytest.approx(2 * 9.80665, rel=1e-15)


def test_the_prisms_tests_have_one_frame_and_the_range_of_the_table_that_was_asked_for() -> None:
    setups = prism_setups(0.08)
    assert list(setups) == ["bench", "table"]
    on_bench, on_table = setups["bench"].recorders[MAIN], setups["table"].recorders[MAIN]
    assert on_table.transducers[:2] == on_bench.transducers
    assert on_table.transducers[2].full_scale == 0.08
    columns = [each.column for each in on_table.transducers]
    assert len(set(columns)) == len(columns)


def test_no_transducer_on_the_prism_reaches_its_range_before_the_catch() -> None:
    assert PRISM_CATCH / PRISM.critical_angle == pytest.approx(1.5, rel=0.02)
    angle = np.linspace(-PRISM_CATCH, PRISM_CATCH, 101)
    for transducer in prism_setups()["bench"].recorders[MAIN].transducers:
        read = transducer.sense(PRISM, still(), np.zeros(angle.size), angle)
        # Its zero may be off by 2 % of the range; much more room than that would waste resolution.
        assert 0.5 < np.abs(read).max() / transducer.full_scale < 0.97
