from colonnade.report import specimens_page
from colonnade.report.pictures.subjects import OfTest
from colonnade.store.records.stored import read_specimen


def page_of(name, reported, filled_campaign):
    campaign, layout = filled_campaign
    free = [
        specimens_page.free_vibration(OfTest(campaign, row, stored))
        for row, stored in reported.values()
        if row.test.specimen == name and stored.has("restitution")
    ]
    return specimens_page.of_specimen(campaign, name, read_specimen(campaign, layout, name), free)


def test_an_identified_e_is_given_with_its_free_vibrations(reported, filled_campaign):
    page = page_of("prism", reported, filled_campaign)
    assert page.e.startswith("0.930")
    assert page.source == "identified from free vibrations"
    assert [each.test for each in page.free_vibrations] == ["free-01", "free-refused"]
    assert all(page.pictures.values())


def test_a_given_e_is_taken_and_nothing_is_drawn(reported, filled_campaign):
    page = page_of("statue", reported, filled_campaign)
    assert (page.e, page.source, page.rigid) == ("0.9", "given in the campaign file", "0.9372")
    assert not any(page.pictures.values())


def test_properties_are_given_derived_used_and_scaled_up(reported, filled_campaign):
    prism = {row.name: row[1:] for row in page_of("prism", reported, filled_campaign).properties}
    assert prism["pole distance R"] == ("–", "232 mm", "232 mm", "4.64 m")
    assert prism["frequency parameter p"] == ("–", "5.631 rad/s", "5.631 rad/s", "1.259 rad/s")
    statue = {row.name: row[1:] for row in page_of("statue", reported, filled_campaign).properties}
    assert statue["critical angle α"] == ("0.21 rad and 0.23 rad", "–", "0.21 rad", "–")
