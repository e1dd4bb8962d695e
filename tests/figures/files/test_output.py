import re
from xml.etree import ElementTree

import matplotlib
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade.figures.files.output import shorter, to_svg
from colonnade.figures.panels.curve import Curve
from colonnade.figures.stored.record import SpanPanel, spans_side_by_side, whole_record

TEXT = 'Test <a> & "b"'


def svg(identity="one"):
    curves = dict.fromkeys(("measured", "linear", "nonlinear", "contact"), Curve(np.arange(2.0), np.arange(2.0)))
    return to_svg(whole_record(curves, []), identity=identity, title=TEXT, description="measured & predicted")


def identifiers(text):
    return [element.attrib["id"] for element in ElementTree.fromstring(text).iter() if "id" in element.attrib]


def test_a_users_own_matplotlib_settings_change_nothing():
    expected = svg()
    with matplotlib.rc_context({"svg.fonttype": "path", "font.size": 20, "lines.color": "red", "svg.hashsalt": None}):
        assert svg() == expected


def test_ids_of_two_figures_in_one_page_do_not_collide():
    first, second = identifiers(svg("one")), identifiers(svg("two"))
    assert len(set(first)) == len(first) > 3
    assert not set(first) & set(second)


def test_every_reference_leads_to_an_id_of_the_same_figure():
    text = svg()
    referred = set(re.findall(r'(?:url\(#|href="#)([^)"]+)', text))
    assert referred
    assert referred <= set(identifiers(text))


def test_it_has_a_text_alternative_that_is_escaped():
    root = ElementTree.fromstring(svg())
    labels = [root.find(f".//*[@id='{name}']") for name in root.attrib["aria-labelledby"].split()]
    assert [label.text for label in labels] == [TEXT, "measured & predicted"]
    assert root.attrib["role"] == "img"
    assert "<a>" not in svg()


def test_it_holds_no_date_no_script_no_style_sheet_and_no_outside_link():
    text = svg()
    for unwanted in ("<?xml", "<!DOCTYPE", "metadata", "<script", "<style", "date"):
        assert unwanted not in text
    assert set(re.findall(r"https?://[^\"' <]+", text)) == {"http://www.w3.org/2000/svg"}


def test_text_stays_text_and_dollar_signs_are_no_formula():
    panels = [SpanPanel("costs $2 and $3", {"measured": Curve(np.arange(3.0), np.arange(3.0))})]
    assert "costs $2 and $3" in to_svg(spans_side_by_side(panels), identity="one", title="", description="")


@pytest.mark.parametrize("identity", ["", "2.0", "a b", 'a"b', "é"])
def test_what_is_no_id_is_refused(identity):
    with pytest.raises(ValueError, match="cannot be an id"):
        svg(identity)


POINTS = st.lists(st.tuples(*[st.floats(-5000, 5000)] * 2), min_size=1, max_size=40)


def absolute(lines, is_closed):
    parts = (" L ".join(f"{x:.6f} {y:.6f}" for x, y in points) for points in lines)
    return " ".join(f"M {part} \n{'z' if is_closed else ''}" for part in parts)


def followed(path):
    """Points of each line of a path of M, l and z, walked as the SVG standard says."""
    lines = []
    for part in path.split("M")[1:]:
        first, _, rest = part.rstrip("z").partition("l")
        start, steps = (
            np.array(re.findall(r"-?(?:\d+\.?\d*|\.\d+)", text), dtype=float).reshape(-1, 2) for text in (first, rest)
        )
        lines.append(np.concatenate((start, start + np.cumsum(steps, axis=0))))
    return lines


@given(lines=st.lists(POINTS, min_size=1, max_size=3), is_closed=st.booleans())
def test_the_points_are_the_same_to_half_a_hundredth_however_long_the_line(lines, is_closed):
    path = shorter(absolute(lines, is_closed))
    assert path.count("z") == (len(lines) if is_closed else 0)
    for found, given_points in zip(followed(path), lines, strict=True):
        assert found == pytest.approx(np.array(given_points), abs=0.00501)


def test_a_path_with_a_curve_stays():
    curve = "M 0 -3 C 0.8 -3 1.6 -2.7 2.1 -2.1 z"
    assert shorter(curve) == curve
