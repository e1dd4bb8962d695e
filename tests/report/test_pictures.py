"""Every figure is drawn from stored results, in both widths of a journal, and has a table; what they are drawn of."""

import re
from dataclasses import replace

import pytest

from colonnade.figures.files.output import Movie
from colonnade.figures.files.table import columns_of
from colonnade.figures.style import COLUMNS, journal
from colonnade.report import pictures
from colonnade.report.pictures import FIGURES, picture

STRONG = "sine-3hz-too-strong-for-the-block-1"


@pytest.fixture(scope="module")
def prism(filled_campaign):
    return pictures.read_of_specimen(*filled_campaign, "prism")


def test_a_specimen_has_its_free_vibrations_its_spans_and_its_sine_tests(prism, filled_campaign):
    assert prism.block == filled_campaign[0].block("prism")
    assert [decay.test for decay in prism.decays] == ["free-01", "free-refused"]
    assert [span.row.id for span in prism.spans] == ["span-2.0", "span-2.5", "span-3.0"]
    assert [point.test for point in prism.points] == [STRONG]
    assert list(prism.failures) == []


SUBJECTS = {"test": ("free-01", "span-2.0"), "specimen": ("prism",), "campaign": ("",)}


NARROW = [entry for entry in FIGURES if entry.is_narrow and entry.name != "animation"]


@pytest.fixture(scope="module")
def read(filled_campaign, reported, prism):
    return reported | {"prism": prism, "": pictures.read_of_campaign(*filled_campaign)}


def test_no_two_figures_of_a_subject_have_one_name():
    names = [(entry.of, entry.name) for entry in FIGURES]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("entry", FIGURES, ids=lambda entry: f"{entry.name} of a {entry.of}")
def test_every_figure_is_drawn_of_what_is_stored(read, entry):
    found = [entry.draw(read[name]) for name in SUBJECTS[entry.of]]
    drawn = next((each for each in found if each is not None), None)
    if drawn is None:
        pytest.skip(f"the small campaign has no data for {entry.name}")
    if not isinstance(drawn, Movie) and entry.name != "setup":
        assert any(len(column) for column in columns_of(drawn.figure).values())


@pytest.mark.parametrize("column", COLUMNS)
@pytest.mark.parametrize("entry", NARROW, ids=lambda entry: entry.name)
def test_the_journals_column_gives_the_width_and_nothing_leaves_it(read, entry, column):
    if column == "double" and entry.name not in ("angle", "map"):
        pytest.skip("the width of a page is close to that of the report")
    with journal(column):
        drawn = next(filter(None, (entry.draw(read[name]) for name in SUBJECTS[entry.of])), None)
        if drawn is None:
            pytest.skip("no data")
        wide = float(drawn.figure.get_size_inches()[0])
        assert wide == pytest.approx(COLUMNS[column])
        drawn.figure.draw_without_rendering()
        for legend in drawn.figure.legends:
            assert legend.get_window_extent().x1 <= wide * drawn.figure.dpi * 1.01


def test_spans_of_one_motion_alone_need_no_note_and_of_several_say_which_is_shown(read):
    (spans,) = [entry for entry in FIGURES if entry.name == "spans"]
    of_one = read["prism"]
    assert spans.draw(of_one).note == ""
    more = [
        each._replace(row=replace(each.row, test=each.row.test.model_copy(update={"motion": "Kobe"})))
        for each in of_one.spans[:2]
    ]
    of_two = replace(of_one, spans=[*more, *of_one.spans])
    assert re.fullmatch(r"Shown: .*, prism.*\. Not shown: Kobe, prism.*\.", spans.draw(of_two).note)


def test_of_many_free_vibrations_twelve_are_drawn_and_the_caption_says_so(read):
    many = replace(read["prism"], decays=40 * read["prism"].decays[:1])
    drawn = [picture(name, many) for name in ("peaks", "impacts", "estimators")]
    assert {each.note[:34] for each in drawn} == {"12 of 40 free vibrations are drawn"}
    assert len(drawn[0].figure.axes) == 12
