"""`colonnade show`: what is known before and after a run."""

import json
import re

import pytest

from colonnade.store.records.wording import LEGEND


def test_tests_that_were_never_run_are_pending(colonnade, campaign):
    told = colonnade("show", "tests", "--json")
    assert told.returncode == 0
    assert {test["status"] for test in json.loads(told.stdout).values()} == {"pending"}


@pytest.mark.parametrize("arguments", [("free-01",), (".", "free-01"), ("campaign.toml", "free-01")])
def test_one_test_is_shown_by_its_id_with_or_without_the_campaign(colonnade, campaign, arguments):
    told = colonnade("show", "tests", *arguments)
    assert told.returncode == 0
    assert "free-vibration" in told.stdout
    assert "free-02" not in told.stdout


def test_settings_without_a_campaign_are_the_defaults(colonnade):
    assert "processing.restitution.level" in colonnade("show", "settings").stdout


def test_settings_show_the_campaigns_value_beside_the_default_one_a_line_without_trailing_spaces(colonnade, changed):
    changed("campaign.toml", '"26.10 kg"}', '"26.10 kg"}\n[processing]\nlowpass = "25 Hz"')
    settings = json.loads(colonnade("show", "settings", "--json").stdout)
    lowpass = settings["processing.lowpass"]
    assert (lowpass["value"], lowpass["default"], lowpass["unit"]) == (25.0, "auto", "Hz")
    lines = colonnade("show", "settings").stdout.splitlines()
    assert len(lines) == 1 + len(settings)
    assert all(line == line.rstrip() for line in lines)


def test_every_format_says_what_it_is_and_how_its_files_end(colonnade):
    known = json.loads(colonnade("show", "formats", "--json").stdout)
    assert {"delimited", "tdms", "waveform"} <= known.keys()
    assert all(each["summary"] and each["suffixes"] for each in known.values())
    assert {"delimiter", "decimal", "encoding"} <= known["delimited"]["options"].keys()
    told = colonnade("show", "formats").stdout
    assert all(name in told for name in known)


@pytest.mark.parametrize("text", ["", "[]", "[" * 100_000, '{"tests": 3}'], ids=["empty", "a list", "nested", "others"])
def test_a_summary_that_was_damaged_is_told(colonnade, campaign, text):
    (campaign / "processed").mkdir()
    (campaign / "processed" / "summary.json").write_text(text, encoding="utf-8")
    told = colonnade("show", "tests")
    assert told.returncode == 1
    assert "summary.json: it was altered or damaged. Run `colonnade run` to make it again." in told.stderr


@pytest.mark.whole
@pytest.mark.usefixtures("undrawn")
def test_a_test_is_a_row_that_fits_on_80_columns_and_its_details_have_units(colonnade, changed, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setenv("FORCE_COLOR", "1")
    long = "free-02-frame-repaired"
    changed("campaign.toml", 'id = "free-02"', f'id = "{long}"')
    assert colonnade("run", "--workers", "1").returncode == 0
    head, *rows, legend = re.sub(r"\x1b\[[\d;]*m", "", colonnade("show", "tests").stdout).splitlines()
    assert legend == LEGEND
    assert head.split() == ["test", "measured", "nonlinear", "linear", "findings"]
    assert [row.split()[:2] for row in rows] == [["free-01", "e"], [long, "e"]]
    assert all(len(row) <= 80 for row in (*rows, legend))
    told = dict(line.split(maxsplit=1) for line in colonnade("show", "tests", "free-01").stdout.splitlines())
    assert told["test"] == "free-01"
    assert re.fullmatch(r"0\.\d+ α", told["peak_ratio"])
    assert re.fullmatch(r"1[12](\.\d+)? s", told["duration"])
    assert re.fullmatch(r"0\.9[45]\d* ± 0\.0\d+", told["restitution"])
    assert told["restitution.whole_history.nonlinear.residual"].endswith(" mrad")
