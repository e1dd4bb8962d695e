"""A watch handles what arrives, gives a line on each test, and leaves what a run would."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from colonnade.errors import StoreError
from colonnade.store.records.advice import Advice
from colonnade.workflow.execution.lock import only_watch
from colonnade.workflow.watching import watch as module
from colonnade.workflow.watching.line import Line
from colonnade.workflow.watching.watch import watch


def test_arriving_files_become_lines_and_the_rest_follows(
    small: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "GRACE", 1.0)
    share = tmp_path / "share"
    share.mkdir()
    for test in ("pulse-02", "free-02"):
        shutil.move(small.raw(test), share)
        shutil.rmtree(small.layout.test(test))
        small.edit(f'id = "{test}"', f'id = "{test}"\nplanned = true')
    broken = share / "pulse-03.csv"
    broken.write_bytes(b"\x00\x01 nothing that can be read")
    text = small.folder / "campaign.toml"
    entry = (
        '[[tests]]\nid = "pulse-03"\nkind = "pulse"\nspecimen = "prism"\nsetup = "frame"\nfile = "raw/pulse-03.csv"\n'
    )
    text.write_text(f"{text.read_text(encoding='utf-8')}\n{entry}planned = true\n", encoding="utf-8")
    shown: list[Line | Advice] = []
    said: list[str] = []
    code = watch(small.folder, share=share, once=True, workers=1, show=shown.append, say=said.append)
    found = {line.test: line for line in shown if isinstance(line, Line)}
    assert set(found) == {"pulse-02", "free-02", "pulse-03"}
    assert found["pulse-03"].record.status == "failed"
    assert code == 1
    assert found["pulse-02"].record.outcome == "overturned"
    assert found["pulse-02"].record.predicted["nonlinear"].outcome == "overturned"
    assert found["free-02"].restitution.tests == ("free-01", "free-02")
    assert "e 0.930" in found["free-02"].text()
    assert [each.kind for each in shown if isinstance(each, Advice)] == ["free-vibration"]
    assert small.summary()["tests"]["pulse-02"]["status"] == "done"
    assert any(sentence.startswith("pulse-03") for sentence in said)
    assert (small.folder / "report" / "tests" / "free-02.html").exists()
    assert "free-02" in small.layout.watch_log.read_text(encoding="utf-8")
    assert '"watched": false' in small.layout.state.read_text(encoding="utf-8")
    before = small.contents()
    assert watch(small.folder, once=True, workers=1, show=shown.append, say=said.append) == 1
    assert small.contents() == before


def test_a_second_watch_names_the_first(small: Any) -> None:
    with only_watch(small.layout), pytest.raises(StoreError, match=r"already being watched, by process \d+"):
        watch(small.folder, once=True, show=lambda line: None, say=lambda sentence: None)
