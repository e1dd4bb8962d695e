"""Messages repeat a user's text at a readable length and hint at what was probably meant."""

import inspect
import pickle

import pytest
from hypothesis import given
from hypothesis import strategies as st

from colonnade import errors
from colonnade.errors import ColonnadeError, nearest, quoted

KINDS = [kind for _, kind in inspect.getmembers(errors, inspect.isclass) if issubclass(kind, ColonnadeError)]


@pytest.mark.parametrize("kind", KINDS)
def test_an_error_crosses_process_borders_unchanged(kind):
    again = pickle.loads(pickle.dumps(kind("top: no such column.")))
    assert type(again) is kind
    assert str(again) == "top: no such column."


@given(st.text())
def test_a_quoted_text_is_the_text_or_its_beginning(text):
    shown = quoted(text)
    assert shown[0] == shown[-1] == '"'
    assert len(shown) <= 62
    assert shown[1:-1] == text or (len(text) > 60 and text.startswith(shown[1:-2]) and shown.endswith('…"'))


@pytest.mark.parametrize(
    ("name", "valid", "hint"),
    [
        ("tpo", ["top", "bottom"], ' Did you mean "top"?'),
        ("TOP", ["bottom", "Top"], ' Did you mean "Top"?'),
        ("x", ["top", "bottom"], ' Choose one of: "top", "bottom".'),
        ("x", [f"channel {number}" for number in range(13)], '"channel 11"….'),
        ("x", [], ""),
    ],
)
def test_the_hint_is_the_nearest_name_or_what_there_is(name, valid, hint):
    assert nearest(name, iter(valid)).endswith(hint)
    assert bool(nearest(name, valid)) == bool(valid)
