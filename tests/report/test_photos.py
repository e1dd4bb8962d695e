"""Photos on the page of a test: those that are in the report, and why others are not."""

from colonnade.report.asked import Photo, Photos
from colonnade.report.pages import renderer_of

HOSTILE = '"><script>alert(1)</script>.jpg'


def test_the_section_shows_paths_and_reasons_as_text(empty_campaign):
    campaign, _ = empty_campaign
    photos = Photos((Photo("photos/a-1.jpg", "Photo 1 of test a", HOSTILE),), ("it is <damaged>",))
    text = renderer_of(campaign).page("sections/photos", "tests/a.html", test={"photos": photos})
    assert '<img src="../photos/a-1.jpg" alt="Photo 1 of test a">' in text
    assert "<script>" not in text
    assert "it is &lt;damaged&gt;" in text
    assert renderer_of(campaign).page("sections/photos", "tests/a.html", test={"photos": Photos()}).strip() == ""
