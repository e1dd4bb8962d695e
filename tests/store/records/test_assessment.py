"""The answer in words, also if it is missing."""

from colonnade.campaign.forms.assessed import UNCORRECTED, AssessmentSummary, Estimate, Variant
from colonnade.store.records.assessment import sentences

KNOWN = {
    "status": "done",
    "specimen": "prism",
    "measure": "pga",
    "unit": "m/s²",
    "critical_angle": 0.1864,
    "p": 1.259,
    "restitution": Estimate(value=0.976, low=0.95, high=0.98),
    "restitution_source": "identified",
    "uplift_acceleration": 1.85,
}
PLAIN = Variant(name="nothing varied", restitution=0.976, median=Estimate(value=4.1))


def said(record):
    return " ".join(sentences(record)).replace("\xa0", " ")


def test_what_is_known_is_said_with_units_and_intervals():
    record = AssessmentSummary(
        **KNOWN,
        median=Estimate(value=4.0, low=3.5, high=4.5),
        dispersion=Estimate(value=0.4, low=0.3, high=0.5),
        dispersion_records=0.1,
        dispersion_parameters=0.2,
        resurrected=0.031,
        five_percent=Estimate(value=2.0, high=2.4),
        fifty_percent=Estimate(value=4.0, low=3.5, high=4.5),
        curve="lognormal",
        annual_rate=Estimate(value=0.0021, low=0.001, high=0.004),
        probability_50_years=Estimate(value=0.1, low=0.05, high=0.2),
        variants=(PLAIN, Variant(name="the e of a rigid body", restitution=0.95, median=Estimate(value=4.4))),
    )
    text = said(record)
    assert text.startswith("Within 50 years it overturns with a probability of 10 % (5 % to 20 %): with the hazard")
    assert "rock at 0.189 g" in text
    assert "5 % at PGA 0.204 g (below 0.245 g), and of 50 % at PGA 0.408 g (0.357 to 0.459)" in text
    assert "0.418 g with nothing varied (e 0.976), with the e of a rigid body (0.95) 0.449 g" in text
    assert "e, α and p matter more than the records" in text
    assert "identified on the model and assumed for the column, drawn between 0.95 and 0.98" in text
    assert "sliding is not judged" in text
    assert "In 3.1 % of the histories it stands although it overturned" in text


def test_what_is_beyond_the_levels_is_said_on_its_side():
    record = AssessmentSummary(
        **KNOWN,
        curve="isotonic",
        curve_reason="the reason",
        five_percent=Estimate(beyond="below"),
        fifty_percent=Estimate(beyond="above"),
    )
    text = said(record)
    assert "5 % already below the lowest level, and of 50 % nowhere within the levels." in text
    assert "not from a lognormal one: the reason." in text
    assert "In brackets" not in text


def test_a_correction_is_said_with_the_answer_without_it():
    plain = Variant(name=UNCORRECTED, restitution=0.976, median=Estimate(value=5.1), records=3)
    record = AssessmentSummary(**KNOWN, baseline="linear", variants=(PLAIN, plain))
    text = said(record)
    assert "As they are, half of the histories of 3 records overturn it at 0.52 g; corrected" in text
    assert "nothing varied either, 0.418 g" in text
    assert "The records are scaled after a correction (linear)." in text
    none = Variant(name=UNCORRECTED, restitution=0.976, reason="all drift")
    text = said(AssessmentSummary(**KNOWN, baseline="linear", variants=(PLAIN, none)))
    assert "As they are, they give no curve: all drift." in text


def test_a_failure_gives_its_reason_alone():
    failed = AssessmentSummary(status="failed", reason="no record", specimen="prism", measure="pgv")
    assert sentences(failed) == ["There is no answer: no record"]
