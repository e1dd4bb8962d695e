import pytest
from jinja2 import UndefinedError

from colonnade.campaign.settings import settings
from colonnade.report import pages


def test_settings_are_written_with_their_unit(filled_campaign):
    written = {
        setting.key: pages._setting(setting)
        for setting in settings(filled_campaign[0].processing, filled_campaign[0].next)
    }
    assert written["processing.lowpass"] == "25 Hz"
    assert written["processing.base_lowpass"] == "auto"
    assert written["processing.predict.models"] == "linear, nonlinear"


def test_a_template_without_what_it_shows_is_an_error(filled_campaign):
    with pytest.raises(UndefinedError):
        pages.Renderer(campaign=filled_campaign[0]).page("quality", "quality.html")


def test_templates_are_compiled_once_for_all_renderers(filled_campaign):
    renderers = [pages.renderer_of(filled_campaign[0]) for _ in range(2)]
    first, second = (each._environment.get_template("parts.html.jinja") for each in renderers)
    assert first is not second
    assert first.root_render_func.__code__ is second.root_render_func.__code__
