"""`colonnade run`, the commands on its way, and `check`: what they do, what they say, what they leave alone."""

import json
import re
import zipfile

import pytest


@pytest.mark.whole
def test_run_gives_a_line_a_redone_test_then_agreement_and_says_where_the_report_is(colonnade, campaign, changed):
    told = colonnade("run", "--workers", "1")
    assert (told.returncode, told.stderr) == (0, "")
    head, first, second, legend, specimen, agreement, *_ = told.stdout.splitlines()
    assert head.split() == ["test", "measured", "nonlinear", "linear", "findings"]
    identified = r"e 0\.9[45]\d+ ± 0\.0+\d{1,2}"
    assert re.fullmatch(rf"free-01  {identified} +\S+ α [✓≠] +\S+ α [✓≠].*", first)
    assert re.fullmatch(rf"free-02  {identified} +\S+ α [✓≠] +\S+ α [✓≠].*", second)
    assert legend.startswith("✓ history inside the 95 % band")
    assert re.fullmatch(rf"specimen prism  {identified}, identified from 2 free vibrations", specimen)
    assert agreement.startswith("The linear model predicts the outcome of 2 of 2 tests.")
    assert "never run" not in told.stdout
    assert told.stdout.endswith(f"report: {campaign / 'report' / 'index.html'}\n")

    before = snapshot(campaign)
    again = colonnade("run", "--workers", "1")
    assert again.returncode == 0
    assert again.stdout.startswith("The linear model predicts")
    assert "\n0 redone" in again.stdout
    assert snapshot(campaign) == before

    changed("raw/free-02.csv", "\n0.000000;", "\n0.000100;")
    third = json.loads(colonnade("run", "--workers", "1", "--json").stdout)
    redone = [stage for stage in third["stages"] if stage["action"] == "done"]
    assert {stage["subject"] for stage in redone} == {"free-02", "prism", "free-01"}
    assert {stage["stage"] for stage in redone if stage["subject"] == "free-01"} <= {"predict", "ensemble", "compare"}


def test_ingest_stops_after_the_first_stage_and_verbose_lists_stages_and_why(colonnade, campaign):
    told = colonnade("ingest", "--workers", "1", "--only", "free-01", "--verbose").stdout
    assert re.search(r"^free-01 +ingest +never run +\d+\.\d$", told, re.MULTILINE)
    assert re.search(r"^free-01 +done up to ingest$", told, re.MULTILINE)
    assert "free-02" not in told
    folder = campaign / "processed" / "tests"
    assert [path.relative_to(folder).as_posix() for path in folder.rglob("*.nc")] == ["free-01/recorded.nc"]


def test_identify_stops_with_the_restitution(colonnade, campaign):
    assert colonnade("identify", "--workers", "1").returncode == 0
    prism = json.loads(colonnade("show", "specimens", "prism", "--json").stdout)["restitution"]
    assert prism["source"] == "identified"
    assert abs(prism["value"] - 0.95) < 0.002
    assert not list(campaign.rglob("predicted-*.nc"))


@pytest.mark.whole
def test_run_prints_the_cause_before_what_follows_from_it(colonnade, with_gain):
    with_gain("10 mm/mm")
    told = colonnade("run", "--workers", "1").stdout
    cause = told.index("serious (gain): free-01: Channel top shows")
    assert "a gain wrong by a factor of 10" in told[cause:].splitlines()[0]
    assert cause < told.index("follows from the above: no restitution: free-01, free-02")
    assert "2 serious findings" in told
    assert told.index("2 serious findings") < told.index("problems.html") < told.index("report: ")
    again = json.loads(colonnade("run", "--workers", "1", "--json").stdout)["warnings"]
    gains = [(each["subject"], each["severity"]) for each in again if each["kind"] == "gain"]
    assert gains == [("free-01", "serious"), ("free-02", "serious")]


@pytest.mark.parametrize("command", ["ingest", "identify"])
def test_strict_makes_warnings_an_exit_code_and_notes_do_not_count(command, colonnade, campaign):
    assert colonnade(command, "--workers", "1", "--strict").returncode == 0
    raw = campaign / "raw" / "free-01.csv"
    lines = raw.read_text(encoding="utf-8").splitlines()
    del lines[60:65]
    raw.write_text("\n".join([*lines, ""]), encoding="utf-8")
    assert colonnade(command, "--workers", "1").returncode == 0
    told = colonnade(command, "--workers", "1", "--strict")
    assert told.returncode == 1
    assert "warning (lost samples): free-01: channel top: 1 gap in time, about 5 samples lost" in told.stdout


@pytest.mark.whole
def test_the_report_is_typeset_and_bundled_if_asked(colonnade, campaign, tmp_path):
    asked = ("report", "--workers", "1", "--pdf", "--bundle", "all.zip")
    told = colonnade(*asked)
    assert told.returncode == 0
    assert told.stdout.endswith(f"pdf: {campaign / 'report' / 'report.pdf'}\nbundle: all.zip\n")
    with zipfile.ZipFile("all.zip") as archive:
        assert "report/report.pdf" in archive.namelist()
    before = snapshot(campaign)
    said = json.loads(colonnade(*asked, "--json").stdout)
    assert (said["pdf"], said["bundle"]) == (str(campaign / "report" / "report.pdf"), "all.zip")
    assert {path for path, time in snapshot(campaign).items() if time != before[path]} <= {campaign / "all.zip"}


def snapshot(folder):
    """What is in a folder, and the time of each file."""
    return {path: path.is_file() and path.stat().st_mtime_ns for path in folder.rglob("*")}


def test_a_good_campaign_passes_and_nothing_is_written(colonnade, campaign):
    before = snapshot(campaign)
    told = colonnade("check")
    assert (told.returncode, told.stderr) == (0, "")
    assert told.stdout == "All good: 2 tests. Nothing was written.\n"
    assert snapshot(campaign) == before


def test_check_finds_what_run_finds_in_the_channels(colonnade, with_gain):
    with_gain("10 mm/mm")
    told = colonnade("check")
    assert told.returncode == 0
    assert told.stdout.startswith("2 tests: 2 would give wrong results. Nothing was written.\n")
    assert re.search(r"serious \(gain\): free-01: Channel top shows (9\.\d|10)\S* times the rotation", told.stdout)
    assert colonnade("check", "--strict").returncode == 1
    found = json.loads(colonnade("check", "--json").stdout)["tests"]["free-02"]["warnings"]
    assert [each["kind"] for each in found if each["severity"] == "serious"] == ["gain", "impossible angle"]


def test_every_missing_file_and_column_is_told_with_the_nearest_name(colonnade, campaign, changed):
    (campaign / "raw" / "free-01.csv").rename(campaign / "raw" / "free_01.csv")
    changed("raw/free-02.csv", "top [mm]", "tops [mm]")
    told = colonnade("check")
    assert told.returncode == 1
    assert "free-01.csv: there is no such file" in told.stdout
    assert 'Did you mean "free_01.csv"?' in told.stdout
    assert 'free-02.csv: no column is called "top"' in told.stdout
    assert 'Did you mean "tops"?' in told.stdout
    assert told.stdout.startswith("2 tests: 2 would fail. Nothing")


def test_a_problem_names_the_serious_finding_that_it_follows_from(colonnade, with_gain):
    with_gain("0.001 mm/mm")
    lines = colonnade("check").stdout.splitlines()
    (problem, *_) = (line for line in lines if line.startswith("would fail: free-01"))
    said = r"would fail: free-01: probably because of the serious findings below \(([^)]+)\): This free vibration"
    kind = re.match(said, problem)
    assert kind, lines
    assert any(line.startswith(f"serious ({kind[1]}): ") for line in lines[lines.index(problem) :])


@pytest.mark.parametrize("ending", [".svg", ".pdf", ".png"])
def test_the_drawing_is_the_one_file_that_is_written(colonnade, campaign, ending):
    before = snapshot(campaign)
    told = colonnade("check", "--drawing", f"plan{ending}")
    assert (told.returncode, told.stderr) == (0, "")
    assert told.stdout == f"All good: 2 tests. Nothing was written but plan{ending}.\n"
    assert set(snapshot(campaign)) - set(before) == {campaign / f"plan{ending}"}


@pytest.mark.parametrize("name", ["campaign.toml", "raw", "own.svg"])
def test_a_drawing_replaces_nothing_of_yours(colonnade, campaign, name):
    (campaign / "own.svg").write_text("<svg/>", encoding="utf-8")
    before = snapshot(campaign)
    told = colonnade("check", "--drawing", name)
    assert told.returncode == 2
    assert name in told.stderr
    assert snapshot(campaign) == before


def test_serious_findings_are_in_colour_on_a_terminal(colonnade, with_gain, monkeypatch):
    with_gain("10 mm/mm")
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm-256color")
    assert "\x1b[1;31mserious (gain)\x1b[0m: free-01: " in colonnade("check").stdout
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b[1;31m" not in colonnade("check").stdout
