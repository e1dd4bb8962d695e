"""The page of a test of an assembly: its bodies in a sentence, a table, two figures and the moving picture."""

import json
import re

import numpy as np
import pytest

from colonnade.campaign import load
from colonnade.campaign.forms.summary import Summary
from colonnade.figures.stored import bodies
from colonnade.report.pictures import OfSpecimen, read_of_test
from colonnade.report.specimens_page import of_specimen
from colonnade.store.layout import Layout
from colonnade.store.records.stored import read_specimen
from colonnade.units.text import acceleration
from read_pages import words_of

pytestmark = pytest.mark.whole


@pytest.fixture(scope="module")
def shaken(shaken_drums):
    return shaken_drums[1]


@pytest.fixture(scope="module")
def page(shaken):
    return (shaken / "report/tests/quake.html").read_text()


def test_the_answer_says_what_moved_and_the_table_has_a_row_a_body_from_the_top(shaken, page):
    record = Summary.model_validate_json(Layout(shaken).summary_json.read_bytes()).tests["quake"]
    moved = {name: 1e3 * np.hypot(body.residual_x, body.residual_y) for name, body in record.bodies.items()}
    name = max(moved, key=moved.get)
    said = f"{name} moved {moved[name]:.3g} mm"
    words = words_of(page)
    assert said in words
    assert f"Body {name} moved farthest for good: {moved[name]:.3g} mm." in words
    assert re.search(r"The joint below 1 opened first, at 0\.5\d+ s", words)
    section = page[page.index('<section id="bodies">') :]
    table = words_of(section[section.index("<table>") : section.index("</table>") + 8])
    found = re.findall(r"(\d) measured rocking (\S+) (\S+) mm (\S+) s (\S+) mm (\S+), (\S+) ", table)
    assert [row[0] for row in found] == ["3", "2", "1"]
    assert [float(row[4]) for row in found] == pytest.approx([moved[each] for each in "321"], abs=0.06)
    assert table.count("contact model rocking") == 3


def test_models_that_none_of_the_tests_can_have_are_no_columns(shaken):
    assert load(shaken).processing.predict.models == ("linear", "nonlinear")
    overview = (shaken / "report/index.html").read_text()
    table = overview[overview.index('class="tests"') :]
    heads = table[: table.index("</thead>")]
    assert "contact<br>max |θ|/α" in heads
    assert "linear" not in heads


def test_figures_are_drawn_from_what_is_stored(shaken):
    campaign, layout = load(shaken), Layout(shaken)
    one = read_of_test(campaign, layout, "quake")
    stored = one.stored
    joints = bodies.joints(one)
    assert [axes.get_ylabel().split("\n")[0] for axes in joints.figure.axes] == ["3", "2", "1"]
    drawn = joints.figure.axes[2].lines[0].get_ydata()
    largest = 1e3 * np.nanmax(np.abs(stored.array("rocking", "body_joint_angle")[0]))
    assert np.nanmax(np.abs(drawn)) == pytest.approx(largest)
    plan = bodies.plan(one)
    rest, end, _ = plan.figure.axes[2].patches
    moved = (end.get_xy()[:-1] - rest.get_xy()[:-1]).mean(axis=0)
    residual = [stored.array("rocking", f"body_residual_{axis}")[2] for axis in "xy"]
    assert moved == pytest.approx(1e3 * np.array(residual), abs=1e-6)
    assert plan.description.endswith("mm from where it stood.")


def test_the_moving_picture_has_each_body_at_its_place(shaken):
    data = next(iter((shaken / "report").rglob("quake*.js")), None)
    assert data is not None
    text = data.read_text()
    given = json.loads(text[text.index("{") : text.rindex("}") + 1])
    measured, predicted = given["moving"]["bodies"]
    assert (measured["name"], predicted["name"]) == ("measured", "contact model")
    assert [part["place"] for part in measured["parts"]] == [[0.0, 0.0], [0.0, 0.2], [0.0, 0.4]]
    assert {"slide", "rise", "outline", "poles"} <= measured["parts"][0].keys()


def test_bodies_that_do_not_rock_as_one_block_have_joints_and_no_e(shaken):
    page = (shaken / "report/specimens/column.html").read_text()
    words = words_of(page)
    whole = load(shaken).specimens["column"].assembly(9.81)
    opens = [9.81 * np.tan(whole.critical_angles[name]) for name in whole.bodies]
    assert f"First to open: the joint below 1, from {acceleration(opens[0])}" in words
    assert 'id="restitution"' not in page
    found = re.findall(r"(\d) drum, \w+ [\d.]+ × [\d. ×]+mm \S+ kg (\w+) \S+ m?m (\S+ m/s² \(\S+ g\))", words)
    assert found == [(f"{k + 1}", f"{k}" if k else "table", acceleration(opens[k])) for k in range(3)]


def test_a_specimen_that_is_only_part_of_an_assembly_has_no_page(shaken):
    assert load(shaken).of_interest == ("column",)
    assert "specimens/drum.html" not in (shaken / "report/tests/quake.html").read_text()
    assert [path.name for path in (shaken / "report/specimens").iterdir()] == ["column.html"]


def test_what_is_odd_about_a_part_is_told_on_the_page_of_the_assembly(shaken, tmp_path):
    written = (shaken / "campaign.toml").read_text()
    (tmp_path / "campaign.toml").write_text(
        written.replace('mass = "20 kg"', 'mass = "20 kg", pole_distance = "0.1 m"')
    )
    campaign = load(tmp_path)
    pooled = read_specimen(campaign, Layout(shaken), "column")
    (said,) = of_specimen(OfSpecimen(campaign, "column", pooled), [])["deviations"]
    assert said.startswith("drum: ")
