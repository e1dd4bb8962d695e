"""Questions of one's own: options over the keys of a campaign, columns without one, refusals."""

import pytest

from colonnade.campaign import load
from colonnade.campaign.assessment import Prototype
from colonnade.errors import CampaignError
from colonnade.store.layout import Layout
from colonnade.workflow.assessing import Where, assess_campaign, assess_own
from colonnade.workflow.real_column import AskedColumn
from every import every

HERE = Where(workers=1)


def own(folder, base="site", **options):
    return assess_own(load(folder), Layout(folder), base, AskedColumn.of(options), options, HERE)


def without_campaign(**options):
    return assess_own(None, None, None, AskedColumn.of(options), options, HERE)


def test_options_replace_keys_and_store_nothing(assessed):
    before = sorted(path.stat().st_mtime_ns for path in assessed.rglob("*") if path.is_file())
    found = own(assessed, restitution=0.9, draws=1, levels=["1 m/s", "2 m/s", "4 m/s"])
    assert found.record.restitution_source == "given"
    assert found.record.restitution.value == 0.9
    assert found.record.restitution.low == pytest.approx(0.88)
    assert found.result is not None
    assert found.result.sizes["level"] == 3
    assert sorted(path.stat().st_mtime_ns for path in assessed.rglob("*") if path.is_file()) == before


def test_a_column_without_a_campaign_is_the_same_column(assessed):
    campaign = load(assessed)
    block = campaign.block("prism")
    options = {
        "records": assessed / "records",
        "restitution": 0.9,
        "restitution_range": [0.85, 0.95],
        "draws": 2,
        "resamples": 200,
        "measures": ["pga", "pgv"],
        "levels": ["0.5 m/s", "1 m/s", "1.5 m/s", "2.5 m/s", "4 m/s"],
    }
    alone = without_campaign(critical_angle=f"{block.critical_angle} rad", p=f"{block.p / 20**0.5} rad/s", **options)
    same = own(assessed, restitution=0.9, restitution_range=[0.85, 0.95])
    assert alone.record.median.value == pytest.approx(same.record.median.value, rel=1e-6)


def test_another_measure_leaves_the_hazard_of_the_old_one(assessed):
    found = own(assessed, measure="pga", levels=["0.5 g", "1 g", "2 g"], draws=1)
    assert found.record.status == "done"
    assert found.record.annual_rate.value is None


@every(
    ("options", "words"),
    [
        ({"base": "sight"}, 'no assessment "sight"'),
        ({"specimen": "prsm"}, 'no specimen "prsm"'),
        ({"base": None, "restitution": 0.9}, "--records"),
        ({"base": None, "specimen": "prism", "restitution": 0.9}, "--records"),
        ({"draws": 0}, "--draws: "),
        ({"restitution": 1.5}, "--restitution: "),
    ],
)
def test_what_cannot_be_asked_is_refused(assessed, options, words):
    with pytest.raises(CampaignError) as refused:
        own(assessed, **options)
    assert words in str(refused.value)


def test_assessments_of_the_campaign_are_brought_up_to_date(assessed_copy):
    campaign, layout = load(assessed_copy), Layout(assessed_copy)
    (layout.processed / "assessments" / "site.nc").unlink()
    [found] = assess_campaign(campaign, layout, (), HERE)
    assert found.path is not None
    assert found.path.is_file()
    with pytest.raises(CampaignError, match='no assessment "sight"'):
        assess_campaign(campaign, layout, ("sight",), HERE)


def test_limits_of_another_value_do_not_hold_for_the_one_that_is_asked(assessed):
    ranges = {"critical_angle_range": ["0.17 rad", "0.19 rad"], "friction": 0.6, "friction_range": [0.5, 0.7]}
    written = Prototype.model_validate({"restitution": 0.9, **ranges})
    campaign = load(assessed).but(prototype={"prism": written})
    levels = {"levels": ["1 m/s", "2 m/s"], "draws": 2}
    column = AskedColumn.of({"critical_angle": "0.25 rad"})
    found = assess_own(campaign, Layout(assessed), "site", column, levels, HERE)
    assert set(found.result["drawn_critical_angle"].to_numpy().ravel()) == {0.25}
    assert found.record.friction_range == (0.5, 0.7)


def test_a_hazard_replaces_that_of_the_campaign(assessed, tmp_path):
    hazard = tmp_path / "other.csv"
    hazard.write_text("pgv [m/s], rate [1/year]\n0.05,0.04\n0.3,0.004\n3,6e-6\n", encoding="utf-8")
    same, twice = own(assessed), own(assessed, hazard=hazard)
    assert twice.record.annual_rate.value == pytest.approx(2 * same.record.annual_rate.value)
