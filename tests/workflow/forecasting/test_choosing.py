from types import SimpleNamespace

import pytest

from colonnade.store.forecasts import Forecasts, Known
from colonnade.workflow.forecasting.choosing import choose, is_blind
from colonnade.workflow.raw_files import RawFile

RAW = {"raw/a.csv": RawFile("a" * 64), "raw/b.csv": RawFile(None)}
CAMPAIGN = SimpleNamespace(tests={"span": SimpleNamespace(id="span", specimen="prism")})


def forecast(name, raw_files=None, test="span", specimen="prism"):
    return Known(name, "0" * 64, SimpleNamespace(test=test, specimen=specimen, raw_files=raw_files or {}))


@pytest.mark.parametrize(
    ("there", "blind"),
    [
        ({}, True),
        ({"raw/c.csv": "c" * 64}, True),
        ({"raw/a.csv": "c" * 64}, False),
        ({"elsewhere.csv": "a" * 64}, False),
        ({"raw/b.csv": "c" * 64}, False),
    ],
)
def test_a_forecast_is_blind_if_no_raw_file_was_there_by_name_or_content(there, blind):
    assert is_blind(forecast("f", there), RAW) is blind


def test_the_last_blind_forecast_counts():
    seen = {"raw/a.csv": "a" * 64}
    known = (forecast("1"), forecast("2"), forecast("3", seen))
    chosen = choose(CAMPAIGN, Forecasts(known), {"span": RAW})
    assert chosen.counts["span"].name == "2"
    assert chosen.blind == {"1": True, "2": True, "3": False}
    assert list(chosen.scored) == ["span"]


def test_without_a_blind_one_the_last_is_shown_and_not_scored():
    seen = {"raw/a.csv": "a" * 64}
    chosen = choose(CAMPAIGN, Forecasts((forecast("1", seen), forecast("2", seen))), {"span": RAW})
    assert chosen.counts["span"].name == "2"
    assert chosen.scored == {}


def test_forecasts_for_no_test_or_another_specimen_count_for_none():
    others = (forecast("1", test=None), forecast("2", test="gone"), forecast("3", specimen="cone"))
    chosen = choose(CAMPAIGN, Forecasts(others), {"span": RAW})
    assert (chosen.blind, chosen.counts) == ({}, {})
