import re

import pytest

from colonnade.figures.files.output import to_svg
from colonnade.figures.panels.layout import COLUMNS, legend_above, side_by_side, stacked_panels


def test_stacked_panels_share_their_time_and_only_the_lowest_has_its_numbers():
    figure, axes = stacked_panels([2.0, 0.8, 0.8])
    axes[0].set_xlim(0, 7)
    assert [one.get_xlim() for one in axes] == [(0, 7)] * 3
    assert [one.xaxis.get_visible() for one in axes] == [False, False, True]
    heights = [one.get_position().height * figure.get_size_inches()[1] for one in axes]
    assert heights == pytest.approx([2.0, 0.8, 0.8])


def test_panels_do_not_overlap():
    _, axes = stacked_panels([1.0, 1.0])
    assert axes[0].get_position().y0 > axes[1].get_position().y1


def test_more_columns_than_fit_are_continued_below():
    _, grid = side_by_side(COLUMNS + 1, [1.0, 0.5])
    assert len(grid) == COLUMNS + 1
    assert grid[COLUMNS][0].get_position().x0 == pytest.approx(grid[0][0].get_position().x0)
    assert grid[COLUMNS][0].get_position().y1 < grid[0][1].get_position().y0
    grid[0][0].set_ylim(-3, 3)
    assert grid[COLUMNS][0].get_ylim() == (-3, 3)


def test_a_legend_names_each_line_once():
    figure, axes = stacked_panels([1.0, 1.0])
    for one in axes:
        one.plot([0, 1], [0, 1], label="measured")
    legend_above(figure, axes)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["measured"]


def test_without_a_name_there_is_no_legend():
    figure, axes = stacked_panels([1.0])
    legend_above(figure, axes)
    assert figure.legends == []


@pytest.mark.parametrize("draw", [lambda: stacked_panels([]), lambda: side_by_side(0, [1.0])], ids=["one", "several"])
def test_no_panel_is_refused(draw):
    with pytest.raises(ValueError, match="at least one"):
        draw()


def test_an_upper_panel_borrows_the_upright_grid_of_the_lowest_one():
    figure, (upper, lower) = stacked_panels([1.0, 1.0])
    lower.set_xlim(0, 7)
    [grid] = upper.artists
    assert grid.lines().tolist() == [0, 1, 2, 3, 4, 5, 6, 7]
    drawn = to_svg(figure, identity="panels", title="", description="")
    assert any(path.count("M") == 8 for path in re.findall(r'd="([^"]*)"', drawn))
    assert not upper.xaxis.get_visible()
