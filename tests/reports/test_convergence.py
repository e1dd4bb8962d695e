"""The convergence study says what the program gives today."""

import pytest

import convergence
from study import HERE

COUNTS = (1, 10, 100)


def test_errors_and_orders_are_those_of_the_report(found):
    now = convergence.measure(COUNTS)
    assert len(now) == len(found)
    places = [convergence.STEPS_PER_SAMPLE.index(count) for count in COUNTS]
    for series, kept in zip(now, found, strict=True):
        name = (series.case, series.scheme, series.refinement)
        assert name == (kept["case"], kept["scheme"], kept["refinement"])
        if series.case == "sensitive":
            continue
        for error, place in zip(series.errors, places, strict=True):
            # Rounding decides in which step a contact falls now and then: as far as a step matters.
            assert error == pytest.approx(kept["errors"][place], rel=0.5, abs=convergence.ROUNDING), name


def test_the_page_tells_the_numbers_of_the_study(found):
    text = (HERE / "convergence.md").read_text(encoding="utf-8")
    for kept in found:
        order = "–" if kept["order"] is None else f"{kept['order']:.2f}"
        row = next(
            line
            for line in text.splitlines()
            if f"| {convergence.CASES[kept['case']]} | {convergence.SCHEMES[kept['scheme']]} |" in line
            and (kept["case"] == "arc" or f"| {'DT/10' if kept['refinement'] > 1 else 'DT'} |" in line)
        )
        assert row.split("|")[-2].strip() == order
    assert (HERE / convergence.FIGURE).read_text(encoding="utf-8").startswith("<svg")


def test_each_scheme_has_its_order_between_contacts_and_the_first_over_them(found):
    orders = {(kept["case"], kept["scheme"]): kept["order"] for kept in found}
    assert orders["arc", "runge-kutta"] == pytest.approx(4, abs=0.2)
    assert orders["arc", "hamming"] > 4
    assert all(0.8 < order < 1.3 for (case, _), order in orders.items() if case in ("free", "sine", "record"))
