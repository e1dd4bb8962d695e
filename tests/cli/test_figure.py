"""`colonnade figure` draws one figure of stored results, with its data, or says why it cannot."""

import csv
import json

import pytest

from colonnade.report.pictures import FIGURES


@pytest.fixture(scope="module")
def small(filled_campaign):
    return str(filled_campaign[0].folder)


def heads(path):
    with path.open(encoding="utf-8", newline="") as stream:
        return next(csv.reader(stream))


def test_a_figure_and_its_data_are_written_where_asked_and_nowhere_else(colonnade, small, tmp_path):
    told = colonnade("figure", "angle", small, "span-2.0", "--width", "single", "--out", "a.pdf", "--data", "a.csv")
    assert (told.returncode, told.stdout, told.stderr) == (0, "figure: a.pdf\ndata: a.csv\n", "")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.csv", "a.pdf"]
    assert heads(tmp_path / "a.csv")[:2] == ["time (s)", "θ / α, measured"]


def test_a_campaigns_figure_needs_no_id(colonnade, small, tmp_path):
    told = colonnade("figure", "agreement", small, "--json")
    assert (told.returncode, json.loads(told.stdout)["figure"]) == (0, "agreement.svg")
    assert "test:" not in (tmp_path / "agreement.svg").read_text(encoding="utf-8")


def test_the_list_has_every_figure(colonnade):
    listed = json.loads(colonnade("figure", "--list", "--json").stdout)
    assert [(each["name"], each["of"]) for each in listed] == [(each.name, each.of) for each in FIGURES]
    assert "angle" in colonnade("figure", "--list").stdout


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("angel", "span-2.0"), 'Unknown figure "angel". Did you mean "angle"?'),
        (("angle", "spam-2.0"), 'a test, not of "spam-2.0". Did you mean "span-2.0"?'),
        (("angle",), "is a figure of a test. Choose one of: "),
        (("impacts",), '"impacts" is a figure of a'),
        (("fitted", "span-2.0"), 'span-2.0: there is nothing to draw for "fitted". It needs a free vibration'),
        (("agreement", "prism"), 'is a figure of a campaign, not of "prism".'),
        (("angle", "sine-dead"), 'sine-dead: there is nothing to draw for "angle". ingest: '),
        (("estimators", "prism", "--width", "single"), "not legible in a single column"),
        (("angle", "span-2.0", "--out", "a.jpg"), 'unknown ending ".jpg"'),
        (("angle", "span-2.0", "--data", "a.txt"), 'unknown ending ".txt"'),
        (("animation", "span-2.0", "--data", "a.csv"), "no table"),
    ],
)
def test_what_cannot_be_drawn_is_said_and_nothing_is_written(colonnade, small, tmp_path, arguments, said):
    name, *others = arguments
    told = colonnade("figure", name, small, *others)
    assert told.returncode == 2
    assert said in " ".join(told.stderr.replace("│", " ").split())
    assert list(tmp_path.iterdir()) == []


@pytest.mark.whole
def test_the_animation_is_a_gif_that_moves(colonnade, small, tmp_path):
    from PIL import Image

    told = colonnade("figure", "animation", small, "span-2.0")
    assert (told.returncode, told.stdout) == (0, "figure: animation-span-2.0.gif\n")
    with Image.open(tmp_path / "animation-span-2.0.gif") as movie:
        assert movie.is_animated
        assert movie.n_frames <= 250
    assert (tmp_path / "animation-span-2.0.gif").stat().st_size < 4_000_000
