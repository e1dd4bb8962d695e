"""What is drawn follows from the campaign file, and from the draft of one."""

import pytest

import drums
from colonnade.campaign import load
from colonnade.errors import CampaignError
from colonnade.figures.drawing import described

HEAD = """
schema = 1
campaign = "drawn"
title = "Drawn"
[specimens]
prism = {shape = "prism", width = "86 mm", depth = "60 mm", height = "456 mm", mass = "26.10 kg"}
cylinder = {shape = "cylinder", diameter = "97 mm", height = "455 mm", mass = "26.30 kg"}
cone = {shape = "cone", base_diameter = "97 mm", top_diameter = "75.5 mm", height = "480 mm", mass = "21.94 kg"}
statue = {shape = "measured", mass = "80 kg", pole_distance = ["610 mm", "600 mm"], critical_angle = ["0.21 rad", "0.24 rad"], inertia = "41.2 kg m^2", restitution = 0.9}
[setups.frame.channels]
top = {column = "1", quantity = "displacement", unit = "mm", on = "specimen", at = ["43 mm", "0 mm", "440 mm"], direction = [1, 0, 0], relative_to = "table"}
laser = {column = "2", quantity = "displacement", unit = "mm", on = "specimen", at = ["43 mm", "0 mm", "300 mm"], direction = [-1, 0, 0], relative_to = "ground", sensing = "surface", normal = [1, 0, 0]}
string = {column = "3", quantity = "displacement", unit = "mm", on = "specimen", at = ["-43 mm", "0 mm", "400 mm"], direction = [-1, 0, 0], relative_to = "ground", sensing = "wire", anchor = ["-300 mm", "0 mm", "420 mm"]}
gyro = {column = "4", quantity = "angular_velocity", unit = "rad/s", on = "specimen", direction = [0, 1, 0]}
across = {column = "5", quantity = "displacement", unit = "mm", on = "specimen", at = ["0 mm", "30 mm", "200 mm"], direction = [0, -1, 0], relative_to = "table"}
table_acceleration = {column = "6", quantity = "acceleration", unit = "g", on = "table", direction = [1, 0, 0]}
table_displacement = {column = "7", quantity = "displacement", unit = "mm", on = "table", direction = [1, 0, 0]}
floor = {column = "8", quantity = "acceleration", unit = "g", on = "ground", direction = [1, 0, 0]}
oil = {column = "9", quantity = "other"}
"""  # noqa: E501


@pytest.fixture
def drawn_campaign(tmp_path):
    """Write and read a campaign with these channels and a test of each specimen."""
    tests = "".join(
        f'[[tests]]\nid = "{name}-1"\nkind = "other"\nspecimen = "{name}"\nsetup = "frame"\nfile = "a.csv"\n'
        for name in ("prism", "cylinder", "cone", "statue")
    )
    (tmp_path / "campaign.toml").write_text(HEAD + tests, encoding="utf-8")
    return load(tmp_path)


def test_a_body_has_the_dimensions_of_its_shape(drawn_campaign):
    for specimen, base, width, depth, height in (
        ("prism", "rectangle", (0.086, 0.086), (0.06, 0.06), 0.456),
        ("cylinder", "circle", (0.097, 0.097), (0.097, 0.097), 0.455),
        ("cone", "circle", (0.097, 0.0755), (0.097, 0.0755), 0.48),
    ):
        body = described.drawn_of(drawn_campaign, specimen, "frame").body
        assert (body.base, body.is_known) == (base, True)
        assert (*body.width, *body.depth, body.height) == pytest.approx((*width, *depth, height))


def test_a_measured_body_is_drawn_from_its_poles_and_says_so(drawn_campaign):
    body = described.drawn_of(drawn_campaign, "statue", "frame").body
    assert not body.is_known
    assert body.height == pytest.approx(2 * body.rocking.centre[1])
    assert body.width[0] == pytest.approx(body.rocking.poles[1] - body.rocking.poles[0])
    assert any("outline not known" in word for word in body.words)
    assert sum(word.startswith("α = ") for word in body.words) == 2


def test_channels_become_transducers_and_those_fixed_to_nothing_are_named(drawn_campaign):
    drawn = described.drawn_of(drawn_campaign, "prism", "frame")
    by_name = drawn.transducers
    assert "oil" not in by_name
    assert "not drawn: oil" in drawn.body.words
    assert by_name["string"].anchor == pytest.approx((-0.3, 0.0, 0.42))
    assert by_name["laser"].sensing == "surface"
    assert by_name["laser"].relative_to == "ground"
    assert "hollow: place not given" in drawn.body.words  # the gyro has no place


def test_all_that_tests_combine_is_drawn_and_told_to_those_who_do_not_see_it(drawn_campaign):
    picture = described.of_campaign(drawn_campaign)
    assert len(picture.figure.axes) == 3 * 4
    told = "top: displacement of the specimen at (43, 0, 440) mm, positive along (1, 0, 0), relative to the table."
    assert told in described.picture(drawn_campaign, "prism", "frame").description
    assert "statue in frame: 8 transducers." in picture.description

    drawn_campaign.tests.clear()
    with pytest.raises(CampaignError, match="no test"):
        described.of_campaign(drawn_campaign)


DRAFT = """
[setups.setup-1.channels.top]
quantity = "displacement"
on = "specimen"
at = ["? mm", "0 mm", "? mm"]
relative_to = "?"
direction = [-1, 0, 0]
[setups.setup-1.channels.placed]
quantity = "displacement"
on = "specimen"
at = ["43 mm", "0 mm", "440 mm"]
relative_to = "table"
direction = [1, 0, 0]
[setups.setup-1.channels.unknown]
quantity = "?"
on = "?"
"""


def test_a_draft_is_drawn_on_a_body_that_stands_in():
    elevation = described.of_draft(DRAFT).figure.axes[0]
    written = [text.get_text() for text in elevation.texts]
    assert written.count("?") == 2
    assert {"1 top", "2 placed"} <= set(written)
    assert not any("unknown" in text for text in written)
    places = {
        (float(line.get_xdata()[0]), float(line.get_ydata()[0])): line.get_markerfacecolor()
        for line in elevation.lines
        if line.get_marker() == "o" and len(line.get_xdata()) == 1
    }
    assert places[0.043, 0.44] != "white"
    assert "white" in places.values()
    of_markers = described.of_draft('[setups.setup.markers.m1]\non = "?"\n').figure.axes[0]
    assert not any("m1" in text.get_text() for text in of_markers.texts)


def test_bodies_of_an_assembly_are_drawn_where_they_stand(tmp_path):
    (tmp_path / "raw").mkdir()
    marker = 'm1 = {columns = ["m1 X", "m1 Y", "m1 Z"], unit = "mm", on = "2", at = ["100 mm", "0 mm", "180 mm"]}\n'
    (tmp_path / "campaign.toml").write_text(drums.CAMPAIGN + marker + drums.TEST)
    campaign = load(tmp_path)
    drawn = described.drawn_of(campaign, "column", "drums")
    levels = drums.COLUMN.levels
    assert [place[2] for _, place in drawn.body.parts.values()] == pytest.approx(list(levels.values()))
    assert drawn.body.height == pytest.approx(drums.COLUMN.height)
    assert drawn.transducers["m1"].at == pytest.approx((0.1, 0.0, 0.18 + levels["2"]))
    assert len(described.of_campaign(campaign).figure.axes) == 3
