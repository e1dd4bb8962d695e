"""Work in threads gives what work one by one gives, in its order, with its errors."""

import time

import pytest

from colonnade.signals.parallel import side_by_side


def test_results_come_in_the_order_of_the_items_whoever_is_ready_first():
    def slower_first(number):
        time.sleep(0.002 * (8 - number))
        return number

    assert side_by_side(slower_first, range(8)) == list(range(8))


def test_an_error_of_one_item_is_raised():
    with pytest.raises(ZeroDivisionError):
        side_by_side(lambda number: 1 / number, [1, 0, 2])


def test_nothing_to_do_gives_nothing():
    assert side_by_side(str, []) == []
