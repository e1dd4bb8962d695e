"""A bad file, a missing file, a share that drops: only that test fails, with its reason."""

import errno
from dataclasses import replace

import pytest

from colonnade.errors import StageError
from colonnade.readers import registry
from colonnade.stages import specimen
from colonnade.store import files

pytestmark = [pytest.mark.whole, pytest.mark.usefixtures("undrawn")]


def failures(result):
    return {stage.subject: stage for stage in result.stages if stage.action == "failed"}


@pytest.mark.smoke
def test_a_bad_file_fails_its_test_alone_with_the_reason_and_leaves_the_specimen_to_the_others(untouched):
    untouched.raw("pulse-01").write_bytes(b"\x00\x01 not a recording")
    untouched.raw("free-01").write_text("time,top\n")
    result = untouched.run(until="report")
    assert result.failed
    assert list(failures(result)) == ["free-01", "pulse-01"]
    tests = untouched.summary()["tests"]
    assert [test["status"] for test in tests.values()] == ["failed", "done", "failed", "done"]
    assert untouched.summary()["specimens"]["prism"]["restitution"]["tests"] == ["free-02"]
    assert "pulse-01.csv" in tests["pulse-01"]["reason"]
    stored = files.read(untouched.layout.stage("pulse-01", "ingest"))
    assert (stored.attrs["status"], len(stored.variables)) == ("failed", 0)
    assert result.report is not None
    assert "pulse-01.csv" in result.report.read_text(encoding="utf-8")


def test_a_missing_file_fails_its_test_until_it_comes(untouched):
    raw = untouched.raw("pulse-02").read_bytes()
    untouched.raw("pulse-02").unlink()
    assert "pulse-02.csv" in failures(untouched.run())["pulse-02"].reason
    untouched.raw("pulse-02").write_bytes(raw)
    assert not untouched.run().failed
    assert untouched.summary()["tests"]["pulse-02"]["status"] == "done"


def fails(error):
    def work(*arguments, **named):
        raise error

    return work


def test_a_specimen_that_fails_is_no_fault_of_its_tests(untouched, monkeypatch):
    monkeypatch.setattr(specimen, "specimen", fails(StageError("No two free vibrations agree.")))
    assert "prism" in failures(untouched.run())
    assert untouched.summary()["tests"]["pulse-01"]["reason"].endswith("specimen prism: No two free vibrations agree.")


def test_a_share_that_drops_while_a_file_is_read_is_not_kept_against_it(untouched, monkeypatch):
    known = registry.formats()["delimited"]
    dropped = replace(known, read=fails(OSError(errno.EIO, "Input/output error")))
    monkeypatch.setattr(registry, "_recognised", lambda path: (dropped, "a look"))
    told = failures(untouched.run())
    assert "Input/output error" in told["pulse-01"].reason
    monkeypatch.undo()
    assert not untouched.run().failed
