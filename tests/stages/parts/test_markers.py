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


DRUM = r'drum = \{(.*?)height = "200 mm"(.*)\}'
HIGH = r'drum = {\1height = "200 mm"\2}\nhigh = {\1height = "220 mm"\2}'


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ([(r"(m3a = .*?)on = \"3\"", r'\1on = "2"')], r"1 of 9 markers .* give: m3a on body 2 by 0, 0 and 200 mm"),
        (
            [
                (r'm2a = \{columns = \["2a X", "2a Y", "2a Z"\]', 'm2a = {columns = ["2b X", "2b Y", "2b Z"]'),
                (r'm2b = \{columns = \["2b X", "2b Y", "2b Z"\]', 'm2b = {columns = ["2a X", "2a Y", "2a Z"]'),
            ],
            "m2a on body 2 by 0, −100 and 160 mm along x, y and z; m2b on body 2 by 0, 100 and −160 mm",
        ),
        ([(r"(m3. = .*?)on = \"3\"", r'\1on = "2"')], "m3a on body 2 by .* 200 mm .* m3c on body 2 by 0, 0 and 200 mm"),
        (
            [(DRUM, HIGH), (r'\["drum", "drum", "drum"\]', '["drum", "high", "drum"]')],
            "3 of 9 markers .* m3c on body 3 by 0, 0 and −20 mm",
        ),
        ([(r"axes = .*", "axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]")], "the axes and the unit of the tracking"),
    ],
    ids=[
        "on the wrong body",
        "exchanged",
        "a body named wrongly",
        "a drum too high",
        "axes turned",
    ],
)
def test_markers_that_are_not_where_the_campaign_has_them_are_named(told, changes, words):
    (text,) = told(*changes)
    assert re.search(words, text), text
