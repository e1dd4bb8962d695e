"""Photos in the report: bare copies, made once, and a warning instead of a failure where one cannot be shown."""

from unittest.mock import Mock

import pytest
from PIL import Image

from colonnade.campaign import load
from colonnade.errors import ReadError
from colonnade.store.layout import Layout
from colonnade.workflow import pages
from colonnade.workflow.graph import Graph
from colonnade.workflow.pages import photos_shown
from colonnade.workflow.product import Catalogue

PLACE = b"48.8584 N 2.2945 E"


@pytest.fixture
def folder(untouched):
    folder = untouched.folder.resolve()
    (folder / "photos").mkdir()
    exif = Image.Exif()
    exif[0x010E] = PLACE.decode()
    Image.new("RGB", (40, 30), "navy").save(folder / "photos" / "a.jpg", exif=exif)
    Image.new("RGB", (30, 40), "green").save(folder / "photos" / "b.png")
    return folder


def graph_of(folder, *written):
    campaign = load(folder)
    test = campaign.tests["free-01"].model_copy(update={"photos": written})
    layout = Layout(folder)
    return Graph(campaign.but(tests=campaign.tests | {"free-01": test}), layout, Catalogue(layout))


def brought(folder, *written):
    """Bring the photos of a campaign up to date as one run does; give the names of the copies, and the warnings."""
    graph = graph_of(folder, *written)
    _, unshown = photos_shown(graph)
    graph.catalogue.save()
    copies = sorted((folder / "report" / "photos").glob("*"))
    return {path.name: path for path in copies}, unshown


def test_copies_are_numbered_as_written_and_hold_nothing_but_pixels(folder):
    copies, found = brought(folder, "photos/a.jpg", "photos/b.png")
    assert (list(copies), found) == (["free-01-1.jpg", "free-01-2.jpg"], [])
    assert PLACE in (folder / "photos" / "a.jpg").read_bytes()
    for path, size in zip(copies.values(), [(40, 30), (30, 40)], strict=True):
        with Image.open(path) as copy:
            assert (copy.format, copy.size, dict(copy.getexif())) == ("JPEG", size, {})
        assert PLACE not in path.read_bytes()


def test_a_copy_is_made_again_only_if_the_photo_changed_or_it_was_lost(folder, monkeypatch):
    copy = brought(folder, "photos/a.jpg")[0]["free-01-1.jpg"]
    before, read, decoded = copy.read_bytes(), pages.read_photo, []

    def spy(path, within):
        decoded.append(path.name)
        return read(path, within=within)

    monkeypatch.setattr(pages, "read_photo", spy)
    brought(folder, "photos/a.jpg")
    assert decoded == []
    copy.write_bytes(before[:-10])
    brought(folder, "photos/a.jpg")
    assert (decoded, copy.read_bytes()) == (["a.jpg"], before)
    Image.new("RGB", (40, 30), "red").save(folder / "photos" / "a.jpg")
    brought(folder, "photos/a.jpg")
    assert decoded == ["a.jpg"] * 2
    assert copy.read_bytes() != before


def test_a_photo_that_is_no_longer_named_is_taken_away_and_without_any_nothing_is_made(folder):
    assert photos_shown(graph_of(folder)) == ({}, [])
    assert not (folder / "report").exists()
    brought(folder, "photos/a.jpg", "photos/b.png")
    copies, _ = brought(folder, "photos/b.png")
    assert list(copies) == ["free-01-1.jpg"]
    with Image.open(copies["free-01-1.jpg"]) as copy:
        assert copy.size == (30, 40)


@pytest.mark.parametrize(
    ("written", "told"),
    [
        ("photos/none.jpg", "not found"),
        ("../a.jpg", "outside the campaign"),
        ("/etc/passwd", "absolute path"),
        ("photos", "a folder"),
        ("campaign.toml", "neither JPEG nor PNG"),
        ("link.jpg", "is a link"),
        ("leaves.jpg", "outside the campaign"),
    ],
)
def test_a_photo_that_cannot_be_shown_is_a_warning_about_its_test(folder, tmp_path_factory, written, told):
    (folder / "link.jpg").symlink_to(folder / "photos" / "a.jpg")
    elsewhere = tmp_path_factory.mktemp("elsewhere") / "a.jpg"
    Image.new("RGB", (40, 30), "navy").save(elsewhere)
    (folder / "leaves.jpg").symlink_to(elsewhere)
    for _ in range(2):  # the second time from the catalogue
        copies, (found,) = brought(folder, written, "photos/b.png")
        assert list(copies) == ["free-01-2.jpg"]
        assert (found.kind, found.severity, found.about) == ("photo", "warning", "tests.free-01")
        assert told in found.text


def test_a_photo_that_the_machine_could_not_read_is_tried_again(folder, monkeypatch):
    error = ReadError("stopped.")
    error.__cause__ = OSError(12, "out of memory")
    with monkeypatch.context() as failing:
        failing.setattr(pages, "read_photo", Mock(side_effect=error))
        assert "stopped." in brought(folder, "photos/a.jpg")[1][0].text
    assert brought(folder, "photos/a.jpg")[1] == []
