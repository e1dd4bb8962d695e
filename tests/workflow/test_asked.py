"""The column that a command asks about: which it is, its size, and what must be said of its e."""

from math import atan, hypot

import pytest

from colonnade.campaign import load
from colonnade.campaign.assessment import Prototype
from colonnade.errors import CampaignError
from colonnade.store.layout import Layout
from colonnade.workflow.asked import find_column
from every import every


@pytest.fixture
def campaign(assessed):
    """Campaign of one specimen, of which nothing is assumed about the real column."""
    return load(assessed).but(prototype={})


def found(campaign, is_real=False, **options):
    """Column and source of its e."""
    layout = None if campaign is None else Layout(campaign.folder)
    asked = find_column(options, campaign, layout, is_real=is_real)
    return asked.real, asked.source


def test_a_specimen_stands_for_itself_with_the_e_of_its_predictions(campaign):
    column, source = found(campaign)
    assert column.block == campaign.block("prism")
    assert source != "given"


@pytest.mark.parametrize(
    "options", [{"scale": 20.0}, {"critical_angle": "0.2 rad"}, {"p": "2 rad/s"}, {"is_real": True}], ids=str
)
def test_of_another_column_e_is_not_that_of_the_model_unless_it_is_said(campaign, options):
    with pytest.raises(CampaignError, match="The e of the real column is not given"):
        found(campaign, **options)
    assert found(campaign, **options, restitution=0.9)[1] == "given"
    assert found(campaign, **options, restitution="identified")[0].restitution == found(campaign)[0].restitution
    assert found(campaign, **options, restitution="rigid-body")[1] == "rigid-body"


def test_what_the_campaign_says_of_the_real_column_holds_for_it_alone(campaign):
    said = campaign.but(prototype={"prism": Prototype.model_validate({"restitution": 0.8, "p": "1 rad/s"})})
    real = found(said, scale=20.0)[0]
    assert real.restitution == 0.8
    assert real.block.p == pytest.approx(1.0)
    assert found(said)[0].restitution != 0.8


def test_an_assessment_takes_the_scale_of_the_campaign_file(campaign):
    assert campaign.specimens["prism"].scale == 20.0
    real = found(campaign, is_real=True, restitution=0.9)[0].block
    assert real.p == pytest.approx(campaign.block("prism").p / 20**0.5)


def test_alpha_and_p_need_no_campaign_and_leave_its_specimens_aside(campaign):
    said = {"critical_angle": "0.2 rad", "p": "2 rad/s"}
    alone, source = found(None, **said)
    assert (alone.block.critical_angle, alone.block.p) == pytest.approx((0.2, 2.0))
    assert source == "rigid-body"
    assert found(campaign, **said)[0] == alone


RADIUS = hypot(0.5, 2.5)
OF_A_CYLINDER = RADIUS / (0.25 * 0.5**2 + 25 / 12 + RADIUS**2)


@every(
    ("sizes", "squared_p"),
    [
        # Solid bodies: α = arctan(b/h_G), I₀ = (4/3) m R² of a prism; of a cylinder m (r²/4 + H²/12) about its centre.
        ({"shape": "prism", "width": "1 m", "height": "5 m"}, 0.75 / RADIUS),
        ({"shape": "cylinder", "diameter": "1 m", "height": "5 m"}, OF_A_CYLINDER),
        ({"shape": "cone", "base_diameter": "1 m", "top_diameter": "1000 mm", "height": "5 m"}, OF_A_CYLINDER),
    ],
)
def test_a_column_is_given_by_its_sizes(campaign, sizes, squared_p):
    alone, source = found(None, **sizes)
    assert (alone.block.critical_angle, alone.block.p) == pytest.approx((atan(0.2), (9.81 * squared_p) ** 0.5))
    assert source == "rigid-body"
    assert found(campaign, **sizes, restitution=0.9)[0].restitution == 0.9


@every(
    ("is_of_a_campaign", "options", "words"),
    [
        (False, {"width": "1 m", "height": "5 m"}, "The column is not known. Give --shape"),
        (False, {"shape": "prism", "width": "1", "height": "5 m"}, '--width: "1" has no unit'),
        (False, {"shape": "prism", "width": "1 m"}, "--height: It is missing"),
        (False, {"specimen": "prism"}, "are for the last alone"),
        (False, {"critical_angle": "0.2 rad", "p": "2 rad/s", "scale": 2.0}, "are for the last alone"),
        (False, {"critical_angle": "2 rad", "p": "2 rad/s"}, "The column cannot be"),
        (False, {"critical_angle": "0.2", "p": "2 rad/s"}, "--critical-angle: "),
        (False, {"critical_angle": "0.2 rad", "p": "2 m"}, "--p: "),
        (True, {"specimen": "prsm"}, 'no specimen "prsm"'),
        (True, {"scale": -2.0}, "--scale: -2"),
        (True, {"restitution": 1.5, "scale": 2.0}, "--restitution: 1.5"),
        (True, {"restitution": "soft", "scale": 2.0}, "--restitution: "),
    ],
)
def test_a_column_that_cannot_be_and_an_option_that_cannot_be_are_refused(campaign, is_of_a_campaign, options, words):
    with pytest.raises(CampaignError) as refused:
        found(campaign if is_of_a_campaign else None, **options)
    assert words in str(refused.value)


def test_one_of_several_specimens_is_named(campaign):
    two = campaign.but(
        specimens={**campaign.specimens, "second": campaign.specimens["prism"]}, of_interest=("prism", "second")
    )
    with pytest.raises(CampaignError, match="several specimens"):
        found(two)
