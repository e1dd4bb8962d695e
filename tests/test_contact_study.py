"""The study of the contact model says what the program gives today."""

import importlib
import json
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from colonnade.dynamics.contact.law import ContactLaw

REPORTS = Path(__file__).resolve().parents[1] / "reports"


@pytest.fixture(scope="module")
def study():
    """The parts of the study, and its numbers."""
    sys.path.insert(0, str(REPORTS))
    try:
        names = ("convergence", "damping", "free", "page", "space", "speed", "misfit_words")
        parts = {name: importlib.import_module(f"contact_model.{name}") for name in names}
        whole = importlib.import_module("contact_study")
        yield SimpleNamespace(**parts, whole=whole)
    finally:
        sys.path.remove(str(REPORTS))
        for name in [name for name in sys.modules if name.split(".")[0] in ("contact_model", "contact_study")]:
            del sys.modules[name]


@pytest.fixture(scope="module")
def kept():
    return json.loads((REPORTS / "contact-study.json").read_text(encoding="utf-8"))


def test_page_and_figures_are_those_of_the_numbers(study, kept, tmp_path):
    study.whole.write(kept, tmp_path)
    page = (tmp_path / "contact-study.md").read_text(encoding="utf-8")
    assert page == (REPORTS / "contact-study.md").read_text(encoding="utf-8")
    for part in study.whole.FIGURES:
        assert f"](contact-{part}.svg)" in page
        assert (REPORTS / f"contact-{part}.svg").read_text(encoding="utf-8").startswith("<svg")


def test_the_document_tells_the_numbers_of_the_study(study, kept):
    document = study.whole.DOCUMENT.read_text(encoding="utf-8")
    assert study.whole.renewed(document, kept) == document


@pytest.mark.parametrize("body", ["2 × 2", "5 × 5", "coarse"])
def test_restitution_over_nodes_is_that_of_the_report(study, kept, body):
    (now,) = study.convergence.measure_nodes((body,))
    then = next(run for run in kept["nodes"] if run["body"] == body)
    assert now["modes"] == then["modes"]
    assert now["restitution"] == pytest.approx(then["restitution"], abs=3e-4)
    assert now["effective_damping"] == pytest.approx(then["effective_damping"], rel=1e-6)


def test_the_calibrated_prism_has_the_papers_restitution_and_the_release_that_the_report_tells(study, kept):
    law = ContactLaw(**kept["law"])
    (now,) = study.space.measure_amplitudes(law, (0.3,))
    then = next(run for run in kept["amplitudes"] if run["release"] == 0.3)
    assert now["restitution"] == pytest.approx(then["restitution"], abs=1e-5)
    assert now["restitution"] == pytest.approx(study.free.TARGET, abs=2e-3)


def test_every_calibrated_cell_that_agrees_has_the_papers_restitution(study, kept):
    cells = [cell for cell in kept["table"] if cell["damping_fraction"] is not None]
    assert {(cell["body"], cell["step"]) for cell in cells} <= {
        (body, step) for body in study.damping.BODIES for step in study.damping.STEPS
    }
    for cell in cells:
        assert cell["agrees"] == (abs(cell["restitution"] - study.free.TARGET) <= 2e-4)


def test_a_cell_of_table_2_is_found_by_scanning_and_closing_in(study, monkeypatch):
    monkeypatch.setattr(study.damping, "SCANNED", 0.8)
    monkeypatch.setattr(study.damping, "LONG", 1)
    (cell,) = study.damping.measure_table(("5 × 5",), (1e-4,))
    assert cell["agrees"]
    assert 1.0 in cell["unstable"]
    assert cell["multiple"] < 1.0


def test_orders_are_those_of_known_errors(study):
    steps = (4.0, 2.0, 1.0, 0.0)
    runs = [
        {"body": "5 × 5", "modes": 0, "step": step, "restitution": 0.9 + 0.01 * step, "peaks": (0.3 + 0.001 * step**2,)}
        for step in steps
    ]
    (found,) = study.convergence.step_errors(runs)
    assert found["orders"]["e"] == pytest.approx(1.0)
    assert found["orders"]["peaks"] == pytest.approx(2.0)


def test_scatter_is_the_range_between_bodies_at_one_effective_damping(study):
    runs = [
        {"body": body, "effective_damping": effective, "restitution": offset - 0.1 * effective}
        for body, offset in (("coarse", 0.99), ("fine", 0.995))
        for effective in (0.0, 0.5)
    ]
    rows = study.convergence.scatter(runs, ("coarse", "fine"))
    assert [row["highest"] - row["lowest"] for row in rows] == pytest.approx([0.005] * len(rows))


def test_the_verdict_on_rocking_in_space_follows_the_misfits(study):
    def runs(prism, round_ones):
        return [
            {
                "specimen": specimen,
                "base": "nodes",
                "release": 0.9,
                "disturbance": disturbance,
                "fitted": 0.97,
                "out_of_plane": 0.1,
                "misfit": {"nonlinear": 0.01 + extra * (disturbance > 0), "linear": 0.02},
            }
            for specimen, extra in (("prism", prism), ("cylinder", round_ones), ("cone", round_ones))
            for disturbance in (0.0, 0.01)
        ]

    assert "Yes: released" in "\n".join(study.misfit_words.misfit_lines(runs(0.001, 0.2), "x.svg"))
    assert "No: released" in "\n".join(study.misfit_words.misfit_lines(runs(0.2, 0.2), "x.svg"))


def test_rebound_of_the_peaks_is_housners(study):
    after = 1.0 - np.sqrt(1.0 - 0.95**2 * (1.0 - 0.5**2))
    assert study.damping.from_peaks(0.5, after) == pytest.approx(0.95)
