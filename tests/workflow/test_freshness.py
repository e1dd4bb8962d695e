"""Only what is out of date is executed, and the reason is told."""

import os
import shutil
from contextlib import contextmanager
from pathlib import Path

import pytest
import xarray as xr

from colonnade.report.test_page import page

pytestmark = pytest.mark.whole

OF_A_PULSE = {"ingest", "condition", "rocking", "predict", "ensemble", "compare"}
OF_A_FREE_VIBRATION = OF_A_PULSE | {"restitution"}


@contextmanager
def keeping_times(path):
    """Change a file within its time."""
    status = path.stat()
    yield
    os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))


def by_subject(redone):
    """Stages that were executed, by what they are of."""
    found = {}
    for subject, stage in redone:
        found.setdefault(subject, set()).add(stage)
    return found


@pytest.mark.smoke
def test_a_first_run_executes_everything_and_says_why(untouched):
    redone = untouched.redone()
    assert set(redone.values()) == {"never run"}
    free, pulse = dict.fromkeys(("free-01", "free-02"), OF_A_FREE_VIBRATION), ("pulse-01", "pulse-02")
    assert by_subject(redone) == {**free, **dict.fromkeys(pulse, OF_A_PULSE), "prism": {"specimen"}}


@pytest.mark.smoke
def test_a_second_run_executes_no_stage_and_changes_no_file(small):
    small.run(until="report")
    before = small.files()
    result = small.run(until="report")
    assert {stage.action for stage in result.stages} == {"up-to-date"}
    assert small.files() == before


PREDICTED = {"predict", "ensemble", "compare"}
EVERY = ("free-01", "free-02", "pulse-01", "pulse-02")
SETTING = "[processing.restitution]\nlowest_amplitude = 0.05\n\n[setups.frame.channels]"
FROM_E = dict.fromkeys(EVERY, PREDICTED) | {"prism": {"specimen"}}


@pytest.mark.parametrize(
    ("change", "stages", "because"),
    [
        (lambda small: small.change_a_sample("pulse-01"), {"pulse-01": OF_A_PULSE}, ("ingest", "raw file changed")),
        (
            lambda small: small.change_a_sample("free-01"),
            FROM_E | {"free-01": OF_A_FREE_VIBRATION},
            ("condition", "upstream changed"),
        ),
        (
            lambda small: small.edit("[setups.frame.channels]", SETTING),
            FROM_E | dict.fromkeys(("free-01", "free-02"), PREDICTED | {"restitution"}),
            ("restitution", "settings changed"),
        ),
        (lambda small: small.edit("A small campaign", "A small campaign, retitled"), {}, None),
        (lambda small: os.utime(small.raw("free-01"), (1, 1)), {}, None),
    ],
    ids=["a sample", "a sample of a free vibration", "a setting", "a title, which no stage reads", "a time"],
)
def test_a_change_redoes_what_follows_from_it_and_nothing_else(small, change, stages, because):
    before = small.contents()
    change(small)
    redone = small.redone()
    assert by_subject(redone) == stages
    if because is None:
        assert small.contents() == before
    else:
        assert because in {(stage, why) for (_, stage), why in redone.items()}


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


def test_verifying_heals_results_and_pages_that_were_altered(small):
    before = small.contents()
    places = ("pulse-01", "ingest"), ("free-01", "compare"), ("prism", "specimen")
    altered = [small.layout.stage(*place) for place in places]
    for path in altered:
        alter(path)
    with keeping_times(page := small.layout.report.parent / "tests" / "pulse-01.html"):
        page.write_bytes((text := page.read_bytes()).replace(b"pulse-01", b"pulse-99"))
    result = small.run(verify=True, until="report")
    assert not result.failed
    assert small.contents() == before
    assert page.read_bytes() == text
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


def test_the_report_of_a_copy_is_not_drawn_again(small, drawn, tmp_path):
    copy = type(small)(Path(shutil.copytree(small.folder, tmp_path / "copy", copy_function=shutil.copyfile)))
    before = pages(copy)
    assert {stage.action for stage in copy.run(until="report").stages} == {"up-to-date"}
    assert pages(copy) == before
    (copy.layout.report.parent / "quality.html").unlink()
    copy.run(until="report")
    assert drawn == []
