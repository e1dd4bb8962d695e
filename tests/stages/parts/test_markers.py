"""Faults of an optical system that a run has to name: each is planted in the campaign file of a sound recording."""

import re

import pytest

import drums
from colonnade.workflow import run

pytestmark = pytest.mark.whole


@pytest.fixture
def told(tmp_path, shaken_drums):
    """What a run says of places, after some of the campaign file was replaced."""
    drums.write_campaign(tmp_path, shaken_drums[0])

    def run_with(*pairs):
        path = tmp_path / "campaign.toml"
        text = path.read_text()
        for old, new in pairs:
            assert re.search(old, text), old
            text = re.sub(old, new, text)
        path.write_text(text)
        done = run(tmp_path, until="rocking", workers=1)
        return [each.text for every in done.findings.values() for each, _ in every if each.kind == "geometry"]

    return run_with


def test_a_sound_recording_has_nothing_to_tell(told):
    assert told() == []


def test_a_marker_on_the_wrong_body_is_named(told):
    (text,) = told((r"(m3a = .*?)on = \"3\"", r'\1on = "2"'))
    assert text.startswith(
        "At rest 1 of 9 markers are off the places that `on` and `at` give: m3a on body 2 by 0, 0 and 200 mm"
    )


def test_two_markers_that_are_exchanged_are_off_by_opposite_ways(told):
    (text,) = told(
        (r'm2a = \{columns = \["2a X", "2a Y", "2a Z"\]', 'm2a = {columns = ["2b X", "2b Y", "2b Z"]'),
        (r'm2b = \{columns = \["2b X", "2b Y", "2b Z"\]', 'm2b = {columns = ["2a X", "2a Y", "2a Z"]'),
    )
    assert "m2a on body 2 by 0, −100 and 160 mm along x, y and z; m2b on body 2 by 0, 100 and −160 mm" in text


def test_a_body_that_is_named_wrongly_is_told(told):
    (text,) = told((r"(m3. = .*?)on = \"3\"", r'\1on = "2"'))
    assert "m3a, m3b, m3c on body 2 by 0, 0 and 200 mm" in text


def test_a_drum_that_is_declared_too_high_lifts_what_stands_on_it(told):
    drum = r'drum = \{(.*?)height = "200 mm"(.*)\}'
    (text,) = told(
        (drum, r'drum = {\1height = "200 mm"\2}\nhigh = {\1height = "220 mm"\2}'),
        (r'\["drum", "drum", "drum"\]', '["drum", "high", "drum"]'),
    )
    assert "3 of 9 markers are off" in text
    assert "m3a, m3b, m3c on body 3 by 0, 0 and −20 mm" in text


def test_a_wrong_height_of_all_drums_is_told_of_each(told):
    (text,) = told((r'height = "200 mm"', 'height = "230 mm"'))
    assert "on body 1 by 0, 0 and 30 mm along x, y and z; m3a, m3b, m3c on body 3 by 0, 0 and −30 mm" in text


def test_axes_that_are_turned_are_told_once(told):
    (text,) = told((r"axes = .*", "axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]"))
    assert re.match(r"At rest \d of 9 markers .* the axes and the unit of the tracking", text)
