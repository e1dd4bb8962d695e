"""Photos on the page of a test: those that are in the report, and why others are not."""

from dataclasses import replace

from colonnade.findings import warning
from colonnade.report.asked import asked_of
from colonnade.report.pages import renderer_of
from colonnade.report.photos import Photo, Photos, address_of, photos_of
from colonnade.store.layout import Layout

HOSTILE = '"><script>alert(1)</script>.jpg'


def with_photos(empty_campaign, *written):
    campaign, _ = empty_campaign
    name, test = next(iter(campaign.tests.items()))
    test = test.model_copy(update={"photos": written})
    told = replace(warning("photo", f"{written[-1]} is <damaged>"), about=f"tests.{name}")
    other = replace(warning("geometry", "off the specimen"), about=f"setups.{test.setup}")
    return campaign.but(tests={**campaign.tests, name: test}, warnings=(told, other)), test


def test_only_copies_that_are_there_are_shown_and_the_others_are_told(empty_campaign, tmp_path):
    campaign, test = with_photos(empty_campaign, "photos/a.jpg", "photos/b.jpg")
    (tmp_path / "photos").mkdir()
    (tmp_path / "photos" / f"{test.id}-1.jpg").write_bytes(b"")
    shown = Photo(f"photos/{test.id}-1.jpg", f"Photo 1 of test {test.id}", "photos/a.jpg")
    assert photos_of(campaign, test, tmp_path) == Photos((shown,), ("photos/b.jpg is <damaged>",))


def test_a_test_without_photos_has_none(empty_campaign, tmp_path):
    campaign, _ = empty_campaign
    assert photos_of(campaign, next(iter(campaign.tests.values())), tmp_path) == Photos()


def test_the_section_shows_paths_and_reasons_as_text(empty_campaign):
    campaign, _ = empty_campaign
    photos = Photos((Photo("photos/a-1.jpg", "Photo 1 of test a", HOSTILE),), ("it is <damaged>",))
    text = renderer_of(campaign).page("sections/photos", "tests/a.html", test={"photos": photos})
    assert '<img src="../photos/a-1.jpg" alt="Photo 1 of test a">' in text
    assert "<script>" not in text
    assert "it is &lt;damaged&gt;" in text
    assert renderer_of(campaign).page("sections/photos", "tests/a.html", test={"photos": Photos()}).strip() == ""


def test_photos_are_those_in_the_folder_of_the_report(filled_campaign, tmp_path):
    campaign = filled_campaign[0]
    test = campaign.tests["span-2.0"].model_copy(update={"photos": ("a.jpg", "b.jpg")})
    campaign = campaign.but(tests=campaign.tests | {"span-2.0": test})
    second = Layout(tmp_path).report.parent / address_of("span-2.0", 2)
    second.parent.mkdir(parents=True)
    second.write_bytes(b"")
    found = {each.test: each.photos.shown for each in asked_of(campaign, Layout(tmp_path))}
    assert [photo.written for photo in found["span-2.0"]] == ["b.jpg"]
    assert found["free-01"] == ()
