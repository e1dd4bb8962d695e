import pytest
from jinja2 import UndefinedError

from colonnade.campaign.settings import settings
from colonnade.report import pages


def test_every_page_has_its_address_and_the_overview_comes_last(filled_campaign):
    found = pages.addresses(filled_campaign[0])
    assert "tests/span-2.0.html" in found
    assert "specimens/statue.html" in found
    assert found[-1] == "index.html"
    assert len(found) == len(set(found)) == 9 + 2 + 4


def test_settings_are_written_with_their_unit(filled_campaign):
    written = {setting.key: pages._setting(setting) for setting in settings(filled_campaign[0].processing)}
    assert written["processing.lowpass"] == "25 Hz"
    assert written["processing.base_lowpass"] == "auto"
    assert written["processing.predict.models"] == "linear, nonlinear"


def test_a_template_without_what_it_shows_is_an_error(filled_campaign):
    with pytest.raises(UndefinedError):
        pages.Renderer(campaign=filled_campaign[0]).page("quality", "quality.html")
