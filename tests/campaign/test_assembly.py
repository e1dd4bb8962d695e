"""Assemblies, tracking and markers of a campaign file."""

import numpy as np
import pytest

import drums
from colonnade.campaign import load
from colonnade.errors import CampaignError

PORTAL = """
[assemblies.portal.bodies]
left = {specimen = "drum", position = ["-500 mm", "0 mm"]}
right = {specimen = "drum", position = ["500 mm", "0 mm"]}
beam = {specimen = "beam", on = ["left", "right"]}

[setups.drums.channels]
"""
BEAM = '[specimens]\nbeam = {shape = "prism", width = "1.2 m", depth = "0.2 m", height = "0.1 m", mass = "60 kg"}\n'


@pytest.fixture
def edited(tmp_path):
    """Load the campaign of the drums with some of its text replaced."""
    (tmp_path / "raw").mkdir()
    marker = 'm1 = {columns = ["m1 X", "m1 Y", "m1 Z"], unit = "mm", on = "2", at = ["100 mm", "0 mm", "180 mm"]}\n'

    def load_with(*pairs):
        text = drums.CAMPAIGN + marker + drums.TEST
        for old, new in pairs:
            assert old in text
            text = text.replace(old, new)
        (tmp_path / "campaign.toml").write_text(text)
        return load(tmp_path)

    return load_with


def test_a_stack_is_a_specimen_of_its_own_with_bodies_from_the_bottom_to_the_top(edited):
    campaign = edited()
    column = campaign.specimens["column"]
    assert list(column.assembly(9.81).bodies) == ["1", "2", "3"]
    assert campaign.block("column").critical_angle == pytest.approx(np.arctan2(0.1, 0.3))
    assert not column.is_in_plane


def test_a_marker_becomes_three_displacements_along_the_axes_of_the_system(edited):
    channels = edited().setups["drums"].channels
    assert [channels[f"m1_{axis}"].direction for axis in "xyz"] == [(0, 1, 0), (-1, 0, 0), (0, 0, 1)]
    assert {channels[f"m1_{axis}"].column for axis in "xyz"} == {"m1 X", "m1 Y", "m1 Z"}
    one = channels["m1_x"]
    assert (one.on, one.at, one.relative_to, one.factor) == ("2", (0.1, 0.0, 0.18), "table", 1e-3)


def test_a_transducer_is_seen_from_the_base_of_the_whole_and_one_between_bodies_has_no_place_there(edited):
    campaign = edited()
    assert campaign.channels_in("column", "drums")["m1_x"].at == pytest.approx((0.1, 0.0, 0.38))
    assert campaign.channels_in("column", "drums")["m1_x"].on == "specimen"
    gap = 'gap = {column = "g", quantity = "displacement", unit = "mm", on = "2", at = ["0 mm", "0 mm", "10 mm"], '
    between = edited(
        ("[setups.drums.tracking]", gap + 'direction = [1, 0, 0], relative_to = "1"}\n[setups.drums.tracking]')
    )
    assert between.channels_in("column", "drums")["gap"].at is None


def test_a_frame_rocks_in_the_plane_by_its_columns(edited):
    campaign = edited(
        ("[specimens]\n", BEAM),
        ("[setups.drums.channels]\n", PORTAL),
        ('specimen = "column"', 'specimen = "portal"'),
        ('on = "2"', 'on = "right"'),
    )
    portal = campaign.specimens["portal"]
    assert portal.is_in_plane
    assert campaign.block("portal").p == pytest.approx(5.125, rel=0.3)
    assert campaign.channels_in("portal", "drums")["m1_x"].at == pytest.approx((0.1, 0.0, 0.18))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('["drum", "drum", "drum"]', '["drum", "drm"]', 'Unknown specimen "drm". Did you mean "drum"?'),
        (
            "[assemblies.column]",
            "[assemblies.drum]",
            '"drum" cannot be the id of an assembly or a body: a specimen has it.',
        ),
        ("[assemblies.column]", "[assemblies.table]", '"table" cannot be the id of an assembly'),
        (
            "[setups.drums.channels]",
            '[assessments.site]\nspecimen = "column"\nrecords = "records"\n[setups.drums.channels]',
            "A history of the bodies of column takes minutes",
        ),
        ('stack = ["drum", "drum", "drum"]', "", "Either `stack`"),
        ('on = "2"', 'on = "9"', 'Unknown body "9"'),
        ('unit = "mm", on', 'unit = "V", on', "V"),
        (', at = ["100 mm", "0 mm", "180 mm"]', "", "at"),
    ],
)
def test_what_is_wrong_is_said_with_its_place(edited, old, new, said):
    with pytest.raises(CampaignError) as refused:
        edited((old, new))
    assert said in str(refused.value)


def test_bodies_in_a_circle_are_refused_with_their_names(edited):
    bodies = '[assemblies.column.bodies]\na = {specimen = "drum", on = "b"}\nb = {specimen = "drum", on = "a"}'
    with pytest.raises(CampaignError, match="a, b stand on each other in a circle"):
        edited(('[assemblies.column]\nstack = ["drum", "drum", "drum"]', bodies), ('on = "2"', 'on = "a"'))


def test_a_night_of_runs_is_the_default_of_several_bodies(edited):
    for members, expected in (("", 40), ("members = 0\n", 0)):
        campaign = edited(("members = 0\n", members))
        assert campaign.members(campaign.tests["quake"], "contact") == expected


def test_one_body_is_not_repeated_on_contact_unless_asked(edited):
    campaign = edited(
        ("members = 0\n", ""), ('specimen = "column"', 'specimen = "drum"'), ('on = "2"', 'on = "specimen"')
    )
    quake = campaign.tests["quake"]
    assert campaign.members(quake, "contact") == 0
    assert campaign.members(quake, "nonlinear") == 100
