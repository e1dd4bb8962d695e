"""What figures are drawn of, read from the last run: a test, a specimen with its tests, the campaign."""

import pytest

from colonnade.report.pictures import subjects

STRONG = "sine-3hz-too-strong-for-the-block-1"


@pytest.fixture(scope="module")
def prism(filled_campaign):
    return subjects.read_of_specimen(*filled_campaign, "prism")


def test_a_test_has_its_record_its_samples_and_the_block_of_its_specimen(filled_campaign):
    found = subjects.read_of_test(*filled_campaign, "span-2.0")
    assert (found.test.id, found.record.outcome) == ("span-2.0", "rocking")
    assert found.block == filled_campaign[0].block("prism")
    assert found.stored.has("ingest", "top")
    assert found.failures == []


def test_a_failed_test_says_why(filled_campaign):
    (failure,) = subjects.read_of_test(*filled_campaign, "sine-dead").failures
    assert failure.stage == "ingest"
    assert "the file is empty" in failure.text


def test_a_specimen_has_its_free_vibrations_its_spans_and_its_sine_tests(prism, filled_campaign):
    assert prism.block == filled_campaign[0].block("prism")
    assert [decay.test for decay in prism.decays] == ["free-01", "free-refused"]
    assert [span.row.id for span in prism.spans] == ["span-2.0", "span-2.5", "span-3.0"]
    assert [point.test for point in prism.points] == [STRONG]
    assert list(prism.failures) == []


def test_another_specimen_has_nothing_of_it(filled_campaign):
    statue = subjects.read_of_specimen(*filled_campaign, "statue")
    assert (list(statue.decays), list(statue.points), list(statue.spans)) == ([], [], [])


def test_a_refused_free_vibration_is_listed_with_the_peaks_that_it_has(prism):
    sound, refused = prism.decays
    assert any(row.recommended for row in sound.estimates)
    assert not any(row.recommended for row in refused.estimates)
    assert sound.peaks is not None
    assert sound.impacts is not None


def test_the_campaign_has_a_row_a_test_without_reading_samples(filled_campaign):
    found = subjects.read_of_campaign(*filled_campaign)
    assert [row.id for row in found.rows] == list(filled_campaign[0].tests)
    assert found.failures == ()
