"""Only what is out of date is executed, and the reason is told."""

import os
import shutil
from contextlib import contextmanager
from pathlib import Path

import pytest
import xarray as xr

from colonnade.report.test_page import page
from colonnade.workflow.product import Catalogue

pytestmark = pytest.mark.whole

OF_A_PULSE = {"ingest", "condition", "rocking", "predict", "ensemble", "compare"}
OF_A_FREE_VIBRATION = OF_A_PULSE | {"restitution"}


@contextmanager
def keeping_times(path):
    """Change a file within its time."""
    status = path.stat()
    yield
    os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))


def stages_of(redone, subject):
    return {stage for name, stage in redone if name == subject}


@pytest.mark.smoke
def test_a_first_run_executes_everything_and_says_why(untouched):
    redone = untouched.redone()
    assert set(redone.values()) == {"never run"}
    assert stages_of(redone, "free-01") == OF_A_FREE_VIBRATION
    assert stages_of(redone, "pulse-01") == OF_A_PULSE
    assert stages_of(redone, "prism") == {"specimen"}


@pytest.mark.smoke
def test_a_second_run_executes_no_stage_and_changes_no_file(small):
    small.run(until="report")
    before = small.files()
    result = small.run(until="report")
    assert {stage.action for stage in result.stages} == {"up-to-date"}
    assert small.files() == before


def test_touching_a_raw_file_redoes_nothing(small):
    os.utime(small.raw("free-01"), (1, 1))
    before = small.contents()
    assert small.redone() == {}
    assert small.contents() == before


def test_one_changed_sample_redoes_that_test_alone_where_nothing_depends_on_it(small):
    small.change_a_sample("pulse-01")
    redone = small.redone()
    assert set(redone) == {("pulse-01", stage) for stage in OF_A_PULSE}
    assert redone["pulse-01", "ingest"] == "raw file changed"
    assert redone["pulse-01", "condition"] == "upstream changed"


def test_one_changed_sample_of_a_free_vibration_redoes_its_specimens_predictions(small):
    small.change_a_sample("free-01")
    redone = small.redone()
    assert stages_of(redone, "free-01") == OF_A_FREE_VIBRATION
    assert stages_of(redone, "prism") == {"specimen"}
    assert stages_of(redone, "pulse-01") == stages_of(redone, "free-02") == {"predict", "ensemble", "compare"}
    assert redone["pulse-01", "predict"] == "upstream changed"


def test_a_setting_redoes_the_stage_that_reads_it_and_what_follows(small):
    setting = "[processing.restitution]\nlowest_amplitude = 0.05"
    small.edit("[setups.frame.channels]", f"{setting}\n\n[setups.frame.channels]")
    redone = small.redone()
    assert {stage for _, stage in redone} == {"restitution", "specimen", "predict", "ensemble", "compare"}
    assert redone["free-01", "restitution"] == "settings changed"


def test_what_no_stage_reads_redoes_nothing(small):
    small.edit("A small campaign", "A small campaign, retitled")
    assert small.redone() == {}


def test_changed_sources_redo_everything_and_give_the_same_values(small, monkeypatch):
    before = small.contents()
    monkeypatch.setattr(Catalogue, "code", lambda self, made_by, model=None: "other sources")
    stages = small.run().stages
    assert {stage.because for stage in stages} == {"code changed"}
    assert len(stages) == len(before)
    assert small.contents() == before


def test_a_file_of_unchanged_size_and_time_is_hashed_again_only_on_request(small):
    with keeping_times(path := small.raw("pulse-01")):
        text = path.read_text()
        path.write_text(text[:-2] + ("1" if text[-2] != "1" else "2") + "\n")
    assert small.redone() == {}
    assert small.redone(verify=True)["pulse-01", "ingest"] == "raw file changed"


def alter(path):
    """Change one number of a result, as another program would: its time and its attributes stay."""
    with keeping_times(path):
        stored = xr.load_dataset(path, decode_times=False, decode_timedelta=False, mask_and_scale=False)
        name = next(name for name, each in stored.data_vars.items() if each.dtype.kind == "f" and each.size)
        stored[name] = stored[name] + 0.125
        stored.to_netcdf(path)


def test_verifying_heals_results_that_were_altered(small):
    before = small.contents()
    places = ("pulse-01", "ingest"), ("free-01", "compare"), ("prism", "specimen")
    altered = [small.layout.stage(*place) for place in places]
    for path in altered:
        alter(path)
    result = small.run(verify=True)
    assert not result.failed
    assert small.contents() == before
    told = " ".join(result.notices)
    assert all(path.relative_to(small.folder).as_posix() in told for path in altered)
    assert small.run(verify=True).notices == ()


def test_a_result_that_was_altered_is_recomputed_by_an_ordinary_run(small):
    before, path = small.contents(), small.layout.stage("pulse-01", "rocking")
    alter(path)
    os.utime(path)
    small.edit('mass = "26.10 kg"', 'mass = "26.20 kg"')  # what reads it is redone
    result = small.run()
    assert not result.failed
    assert result.notices == ("processed/tests/pulse-01/rocking.nc: it was altered or damaged, so it is recomputed.",)
    small.edit('mass = "26.20 kg"', 'mass = "26.10 kg"')
    assert small.run().notices == ()
    assert small.contents() == before


def pages(small):
    return {name: state for name, state in small.files().items() if name.startswith("report/")}


@pytest.fixture
def drawn(monkeypatch):
    """Tests whose pages were drawn."""
    names = []
    of_test = page.of_test
    monkeypatch.setattr(page, "of_test", lambda *given: names.append(given[0].test.id) or of_test(*given))
    return names


@pytest.mark.parametrize("place", ["tests/pulse-01.html", "specimens/prism.html", "quality.html", "index.html"])
def test_a_page_that_is_gone_or_altered_comes_back_and_no_other_is_drawn(small, drawn, place):
    before, page = pages(small), small.layout.report.parent / place
    text = page.read_bytes()
    for spoil in (page.unlink, lambda: page.write_bytes(text.replace(b"</html>", b"<p>altered</html>"))):
        spoil()
        small.run(until="report")
        assert page.read_bytes() == text
        assert {name for name, state in pages(small).items() if state != before[name]} == {f"report/{place}"}
    assert set(drawn) <= {"pulse-01"}


def test_a_page_altered_within_its_size_and_time_is_healed_by_verifying(small):
    page = small.layout.report.parent / "tests" / "pulse-01.html"
    text = page.read_bytes()
    with keeping_times(page):
        page.write_bytes(text.replace(b"pulse-01", b"pulse-99"))
    small.run(until="report", verify=True)
    assert page.read_bytes() == text


def test_the_report_of_a_copy_is_not_drawn_again(small, drawn, tmp_path):
    copy = type(small)(Path(shutil.copytree(small.folder, tmp_path / "copy", copy_function=shutil.copyfile)))
    before = pages(copy)
    assert {stage.action for stage in copy.run(until="report").stages} == {"up-to-date"}
    assert pages(copy) == before
    (copy.layout.report.parent / "quality.html").unlink()
    copy.run(until="report")
    assert drawn == []
