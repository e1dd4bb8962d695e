"""The study of the contact model says what the program gives today."""

import json
from pathlib import Path

import numpy as np
import pytest

import contact_study
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.nodes import rigid_body
from contact_model import convergence, damping, disturbed, free, misfit_words, space

REPORTS = Path(__file__).resolve().parents[2] / "reports"


@pytest.fixture(scope="module")
def kept():
    return json.loads((REPORTS / "contact-study.json").read_text(encoding="utf-8"))


def test_page_and_figures_are_those_of_the_numbers(kept, tmp_path):
    contact_study.write(kept, tmp_path)
    page = (tmp_path / "contact-study.md").read_text(encoding="utf-8")
    assert page == (REPORTS / "contact-study.md").read_text(encoding="utf-8")
    for part in contact_study.FIGURES:
        assert f"](contact-{part}.svg)" in page
        assert (REPORTS / f"contact-{part}.svg").read_text(encoding="utf-8").startswith("<svg")


def test_the_document_tells_the_numbers_of_the_study(kept):
    document = contact_study.DOCUMENT.read_text(encoding="utf-8")
    assert contact_study.renewed(document, contact_study.MARKS, contact_study.summary(kept)) == document


@pytest.mark.parametrize("body", ["2 × 2", "5 × 5", "coarse"])
def test_restitution_over_nodes_is_that_of_the_report(kept, body):
    (now,) = convergence.measure_nodes((body,))
    then = next(run for run in kept["nodes"] if run["body"] == body)
    assert now["modes"] == then["modes"]
    assert now["restitution"] == pytest.approx(then["restitution"], abs=3e-4)
    assert now["effective_damping"] == pytest.approx(then["effective_damping"], rel=1e-6)


def test_the_calibrated_prism_has_the_papers_restitution_and_the_release_that_the_report_tells(kept):
    law = ContactLaw(**kept["law"])
    (now,) = space.measure_amplitudes(law, (0.3,))
    then = next(run for run in kept["amplitudes"] if run["release"] == 0.3)
    assert now["restitution"] == pytest.approx(then["restitution"], abs=1e-5)
    assert now["restitution"] == pytest.approx(free.TARGET, abs=2e-3)


def test_every_calibrated_cell_that_agrees_has_the_papers_restitution(kept):
    cells = [cell for cell in kept["table"] if cell["damping_fraction"] is not None]
    assert {(cell["body"], cell["step"]) for cell in cells} <= {
        (body, step) for body in damping.BODIES for step in damping.STEPS
    }
    for cell in cells:
        assert cell["agrees"] == (abs(cell["restitution"] - free.TARGET) <= 2e-4)


def test_a_cell_of_table_2_is_the_calibration_of_the_program():
    (cell,) = damping.measure_table(("5 × 5",), (1e-4,))
    law = space.calibrated(free.PRISM, 1e-4)
    assert cell["agrees"]
    assert (cell["stiffness"], cell["damping_fraction"]) == (law.stiffness, law.damping_fraction)
    assert cell["multiple"] == 1.0
    low, high = cell["reached"]
    assert low <= cell["restitution"] <= high


def test_orders_are_those_of_known_errors():
    steps = (4.0, 2.0, 1.0, 0.0)
    runs = [
        {"body": "5 × 5", "modes": 0, "step": step, "restitution": 0.9 + 0.01 * step, "peaks": (0.3 + 0.001 * step**2,)}
        for step in steps
    ]
    (found,) = convergence.step_errors(runs)
    assert found["orders"]["e"] == pytest.approx(1.0)
    assert found["orders"]["peaks"] == pytest.approx(2.0)


def test_scatter_is_the_range_between_bodies_at_one_effective_damping():
    runs = [
        {"body": body, "effective_damping": effective, "restitution": offset - 0.1 * effective}
        for body, offset in (("coarse", 0.99), ("fine", 0.995))
        for effective in (0.0, 0.5)
    ]
    rows = convergence.scatter(runs, ("coarse", "fine"))
    assert [row["highest"] - row["lowest"] for row in rows] == pytest.approx([0.005] * len(rows))


def _disturbed(prism, round_ones):
    """Runs of a release at 0.9 α whose added misfit is proportional to the size of one disturbance."""
    return [
        {
            "specimen": specimen,
            "variant": "",
            "kind": kind,
            "size": size,
            "release": 0.9,
            "fitted": 0.97,
            "out_of_plane": 0.1,
            "overturned": False,
            "misfit": {"nonlinear": 0.01 + share * size, "linear": 0.02},
        }
        for specimen, share in (("prism", prism), ("cylinder", round_ones), ("cone", 1.25 * round_ones))
        for kind, size in (("none", 0.0), ("push", 0.001), ("push", 0.01))
    ]


def test_the_verdict_on_rocking_in_space_follows_the_misfits():
    yes = misfit_words.judged(_disturbed(0.1, 20.0), 0.9)["push"]
    assert yes[0] == pytest.approx(0.0025)  # what gives the cylinder, the less moved of the two, 5 % of α
    assert yes[1] == pytest.approx(0.1 * 0.01)
    assert misfit_words.judged(_disturbed(20.0, 20.0), 0.9)["push"][0] is None  # the prism moves as much
    assert misfit_words.judged(_disturbed(0.0, 1.0), 0.9)["push"][0] is None  # too little to be seen
    lines = misfit_words.misfit_lines(_disturbed(0.1, 20.0), _disturbed(0.1, 20.0), "x.svg")
    told = "\n".join(lines)
    assert "- sideways push, from 0.25 % of pα (1.3 mm/s at the top)" in told
    assert "These do not" not in told
    assert "none." in "\n".join(misfit_words.verdict(_disturbed(20.0, 20.0), 0.9))


def test_a_tilted_table_and_a_push_are_released_as_they_are_called():
    body = disturbed.bodies()["cylinder"]
    block = free.CYLINDER
    law = free.law_for(body, 0.4)
    given = (body, block, law, 0.9)
    start, table = disturbed._release(*given, "tilt", 0.01, 1.0)
    assert table.transverse.max() == pytest.approx(9.81 * np.sin(0.01 * block.critical_angle))
    assert not start.angular_velocity.any()
    start, table = disturbed._release(*given, "push", 0.01, 1.0)
    assert start.angular_velocity[0] == pytest.approx(0.01 * block.p * block.critical_angle)
    assert start.velocity[1] < 0.0  # a right-handed turn about x takes the top to −y
    assert not table.transverse.any()


def test_a_rotation_about_x_adds_nothing_to_the_misfit_of_round_bodies(monkeypatch):
    monkeypatch.setattr(disturbed, "calibrated", lambda block, step: free.law_for(rigid_body(block), 0.4))
    runs = disturbed.measure_misfit({"none": (0.0,), "lean": (0.0025,)}, releases=(0.5,), duration=1.2)
    assert len(runs) == 6
    for specimen in ("cylinder", "cone"):
        ((_, more),) = misfit_words.added(runs, 0.5, specimen, "lean")
        assert abs(more) < 1e-4


def test_what_the_report_says_of_disturbances_is_what_the_program_gives(kept):
    """One that is plain, one that is pushed: the cylinder with the damping of the report's own run."""
    for kind, size in (("none", 0.0), ("push", 0.001)):
        then = next(
            run
            for run in kept["misfit"]
            if (run["specimen"], run["release"], run["kind"], run["size"]) == ("cylinder", 0.9, kind, size)
        )
        body = disturbed.bodies()["cylinder"]
        law = free.law_for(body, then["damping_fraction"])
        now = disturbed._run("cylinder", body, law, 0.9, kind, size, 4.0)
        assert now["misfit"]["nonlinear"] == pytest.approx(then["misfit"]["nonlinear"], abs=2e-3)
        assert now["fitted"] == pytest.approx(then["fitted"], abs=3e-4)


def test_an_uneven_base_keeps_its_low_spots():
    body = disturbed.bodies(24)["cylinder"]
    for kind, spots in (("warp", 2), ("feet", 3)):
        shaped = disturbed._shaped(body, kind, 1e-4)
        rim = shaped.nodes[-24:, 2]
        assert rim.max() - rim.min() == pytest.approx(1e-4, rel=1e-9)
        assert np.isclose(rim, body.nodes[0, 2]).sum() == (spots if spots == 2 else 3 * (24 % 3 == 0))


def test_rebound_of_the_peaks_is_housners():
    after = 1.0 - np.sqrt(1.0 - 0.95**2 * (1.0 - 0.5**2))
    assert damping.from_peaks(0.5, after) == pytest.approx(0.95)
