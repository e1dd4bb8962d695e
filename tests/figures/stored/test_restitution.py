from colonnade.figures.stored import restitution


def test_a_free_vibration_has_every_picture(known):
    test, _, stored, block = known("free-01")
    level = restitution.level_of(stored, "restitution", "e identified")
    assert level.low < level.value < level.high
    series = restitution.peak_series(test, stored, block)
    assert restitution.peaks("peaks", [series], block).description == f"free-01: 19 of {series.used.size} peaks used."
    assert restitution.impacts("impacts", [restitution.impact_series(test, stored)], level, 0.95) is not None
    assert restitution.fitted(test, stored, block).title.startswith(
        "free-01: measured free vibration and the nonlinear"
    )
    assert restitution.region(test, stored).description.startswith("With the critical angle freed: e = 0.93")


def test_the_recommended_estimator_is_marked(known):
    rows = restitution.estimate_rows(known("free-01")[2])
    assert [row.name for row in rows if row.recommended] == ["whole history, e of each impact"]


def test_another_kind_of_test_has_none(known):
    test, _, stored, block = known("span-2.0")
    assert restitution.peak_series(test, stored, block) is None
    assert restitution.impact_series(test, stored) is None
    assert restitution.fitted(test, stored, block) is None
    assert restitution.region(test, stored) is None
    assert restitution.estimators("estimators", [], 0.95) is None
