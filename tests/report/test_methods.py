from colonnade.report.methods import Used, software


def used_of(reported, *tests):
    used = Used()
    for test in tests:
        used.gather(test, reported[test][1])
    return used


def test_settings_are_those_stored_with_the_results(reported):
    used = used_of(reported, "free-01", "span-2.0")
    assert used.text("filter order") == "4"
    assert used.text("low-pass rule") == "25 Hz"
    assert used.text("cut-off on the specimen") == "25 Hz"
    assert used.text("runs") == "20"
    assert used.text("mesh") == "–"


def test_where_tests_differ_each_value_has_its_tests(reported):
    used = used_of(reported, "span-2.0", "sine-3hz-too-strong-for-the-block-1")
    assert used.text("zero") == "auto (span-2.0) or start (sine-3hz-too-strong-for-the-block-1)"
    assert list(used.differing()) == ["zero"]


def test_a_refused_free_vibration_has_no_method(reported):
    assert used_of(reported, "free-01").text("method of e").startswith("whole history")
    assert used_of(reported, "free-refused").text("method of e") == "–"


def test_nothing_is_known_of_a_test_that_was_not_run(reported):
    assert used_of(reported, "later").values == {}


def test_software_has_a_version_each():
    assert all(name and version for name, version in software())
    assert [name for name, _ in software()][:2] == ["colonnade", "Python"]
