import json
import os

import pytest

from colonnade.campaign.forms.forecast import ForecastFile
from colonnade.errors import StoreError
from colonnade.store.forecasts import LARGEST, read_forecasts, write_forecast
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of


@pytest.fixture
def content(foreseen):
    """What a forecast file says, but for its hash."""
    known = json.loads(min(Layout(foreseen[0]).forecasts.glob("*.json")).read_text(encoding="utf-8"))
    del known["sha256"]
    return known | {"made": "2026-01-02T03:04:05Z", "level": "0.3 g"}


@pytest.fixture
def forecast(content):
    content["motion"]["name"] = "../El Centro"
    return ForecastFile.model_validate(content)


def signed(content):
    return json.dumps(content | {"sha256": hash_of(content)})


def test_what_is_written_is_read(tmp_path, forecast):
    layout = Layout(tmp_path)
    paths = [write_forecast(layout, forecast) for _ in range(2)]
    stem = "20260102T030405Z-prism-.._El_Centro-0.3_g"
    assert [path.name for path in paths] == [f"{stem}.json", f"{stem}-2.json"]
    found = read_forecasts(layout)
    assert [each.forecast for each in found.known] == [forecast, forecast]
    assert not found.refused


def refusal(folder, forecast, text):
    """Why a file with this text is refused, alone."""
    layout = Layout(folder)
    write_forecast(layout, forecast)
    (layout.forecasts / "odd.json").write_text(text, encoding="utf-8")
    found = read_forecasts(layout)
    assert len(found.known) == 1
    assert [each.name for each in found.refused] == ["odd.json"]
    return found.refused[0].reason


@pytest.mark.parametrize(
    "text", ["", "[1]", "[" * 100_000, '{"test": "\\ud800"}', "cut"], ids=["empty", "list", "deep", "lone", "cut"]
)
def test_what_is_no_file_of_ours_is_damaged(tmp_path, content, forecast, text):
    assert "damaged" in refusal(tmp_path, forecast, signed(content)[:-40] if text == "cut" else text)


@pytest.mark.parametrize(("before", "after"), [("0.3 g", "0.4 g"), ("null", "NaN"), ('"sha256": "', '"sha256": "0')])
def test_what_was_changed_after_it_was_signed_is_altered(tmp_path, content, forecast, before, after):
    text = signed(content)
    assert before in text
    assert "altered" in refusal(tmp_path, forecast, text.replace(before, after))


@pytest.mark.parametrize(
    ("place", "value", "said"),
    [
        ("schema", 2, "schema"),
        ("more", 1, "more"),
        ("made", "2026-01-02T03:04:05", "timezone"),
        ("models", {}, "models"),
        ("models linear peak_ratio", [0.1, 0.2, 0.3], "2 members"),
        ("models linear peak_ratio", [0.1, -0.2], "greater than"),
        ("inputs block mass", 1e300, "mass"),
    ],
)
def test_what_is_signed_and_no_forecast_is_refused_with_its_place(tmp_path, content, forecast, place, value, said):
    content["inputs"]["members"] = 2
    *above, key = place.split()
    holder = content
    for each in above:
        holder = holder[each]
    holder[key] = value
    assert said in refusal(tmp_path, forecast, signed(content))


def test_a_forecast_of_a_model_in_space_is_refused(tmp_path, content, forecast):
    content["models"]["contact"] = content["models"].pop("linear")
    assert "no model in the plane" in refusal(tmp_path, forecast, signed(content))


def test_links_pipes_and_huge_files_are_not_opened(tmp_path, forecast):
    layout = Layout(tmp_path)
    path = write_forecast(layout, forecast)
    (layout.forecasts / "a.json").symlink_to(path)
    os.mkfifo(layout.forecasts / "b.json")
    with (layout.forecasts / "c.json").open("wb") as stream:
        stream.truncate(LARGEST + 1)
    (layout.forecasts / "d.json").mkdir()
    found = read_forecasts(layout)
    assert [each.name for each in found.known] == [path.name]
    assert [each.name for each in found.refused] == ["a.json", "b.json", "c.json", "d.json"]


def test_a_folder_that_is_a_link_is_neither_read_nor_written(tmp_path, forecast):
    (tmp_path / "elsewhere").mkdir()
    layout = Layout(tmp_path / "home")
    layout.home.mkdir()
    layout.forecasts.symlink_to(tmp_path / "elsewhere")
    with pytest.raises(StoreError, match="link"):
        write_forecast(layout, forecast)
    assert len(read_forecasts(layout).refused) == 1
    assert not list((tmp_path / "elsewhere").iterdir())
