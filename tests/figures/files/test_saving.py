"""A figure goes to the file that was named, in the format of its ending, over nothing but a figure of ours."""

import pytest
from matplotlib.figure import Figure

from colonnade.errors import CampaignError
from colonnade.figures.files.output import Picture
from colonnade.figures.files.saving import save

BEGINS = {".svg": b"<?xml", ".pdf": b"%PDF", ".png": b"\x89PNG", ".csv": b"time (s)"}


def picture(label="time (s)"):
    figure = Figure(figsize=(3, 2))
    axes = figure.subplots()
    axes.plot([0.0, 1.0], [1.0, 2.0], label="measured")
    axes.set(xlabel=label, ylabel="θ / α")
    return Picture(figure, "one", "a < b", "two points")


@pytest.mark.parametrize("ending", BEGINS)
def test_the_ending_says_what_is_written_and_the_same_figure_gives_the_same_bytes(tmp_path, ending):
    path = save(picture(), tmp_path / "new" / f"one{ending.upper()}")
    first = path.read_bytes()
    assert first.startswith(BEGINS[ending])
    save(picture(), path)
    assert path.read_bytes() == first
    assert [each.name for each in path.parent.iterdir()] == [path.name]


@pytest.mark.parametrize("ending", BEGINS)
def test_a_file_that_is_not_ours_is_not_changed(tmp_path, ending):
    path = tmp_path / f"own{ending}"
    path.write_bytes(b"of mine\n")
    with pytest.raises(CampaignError, match="was not changed"):
        save(picture(), path)
    assert path.read_bytes() == b"of mine\n"
    path = save(picture(), tmp_path / "one.csv")
    with pytest.raises(CampaignError, match="other columns"):
        save(picture("frequency (Hz)"), path)


@pytest.mark.parametrize(
    ("name", "said"), [("one.jpg", 'unknown ending ".jpg"'), ("one", "has no ending"), ("folder.svg", "a folder")]
)
def test_a_name_that_cannot_be_used_is_refused(tmp_path, name, said):
    (tmp_path / "folder.svg").mkdir()
    with pytest.raises(CampaignError, match=said):
        save(picture(), tmp_path / name)
    assert not (tmp_path / "one").exists()
