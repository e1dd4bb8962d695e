"""Tables of a campaign file: every problem at its own key, in a finished sentence."""

import pytest
from pydantic import ValidationError

from colonnade.campaign.syntax.fields import Length
from colonnade.campaign.syntax.table import Table


class Box(Table):
    """A box."""

    width: Length
    """Along x, such as "86 mm"."""
    labels: tuple[str, ...] = ()
    """Words on it."""


class Shelf(Table):
    """A shelf."""

    boxes: dict[str, Box]
    """By name."""


def problems(table, value):
    with pytest.raises(ValidationError) as raised:
        table.model_validate(value)
    return {error["loc"]: error["msg"] for error in raised.value.errors()}


def test_all_problems_are_told_at_once_each_at_its_key():
    assert problems(Shelf, {"boxes": {"a": {"wdith": "1 m"}, "b": {"width": "86"}}}) == {
        ("boxes", "a", "width"): 'It is missing. Expected: along x, such as "86 mm".',
        ("boxes", "a", "wdith"): 'Unknown key. Did you mean "width"?',
        ("boxes", "b", "width"): '"86" has no unit. A length was expected, such as "86 mm".',
    }


@pytest.mark.parametrize(
    ("table", "value", "told"),
    [
        (Shelf, {"boxes": 3}, "3 was found. A table was expected: by name."),
        (Shelf, {"boxes": {"a": "x"}}, '"x" was found. A table was expected.'),
        (Box, {"width": "1 m", "labels": 5}, "5 was found. A list was expected: words on it."),
    ],
)
def test_a_value_in_place_of_a_table_or_list_is_refused(table, value, told):
    assert told in problems(table, value).values()


def test_keys_have_their_purposes():
    assert Box.purposes() == {"width": 'Along x, such as "86 mm".', "labels": "Words on it."}
