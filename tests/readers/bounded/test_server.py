"""The process that reads: one answer for each request, in order, whatever comes of it."""

from __future__ import annotations

import io
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import pytest

from colonnade.readers import registry
from colonnade.readers.bounded import messages, server
from colonnade.readers.bounded.enclosure import OUT_OF_MEMORY, bounds_of
from colonnade.readers.bounded.messages import Answer, Request


def request(path: Path, format: str = "delimited", **options: object) -> Request:
    given = {"format": format, "options": options, "window": None}
    modules = registry.formats()[format].modules
    function = "colonnade.readers.registry:read_here"
    return Request(function, str(path), str(path.parent), given, format, modules, bounds_of(path))


@pytest.fixture
def table(tmp_path: Path) -> Path:
    path = tmp_path / "a.csv"
    path.write_text("t [s];top [mm]\n0;1\n1;2\n2;4\n", encoding="ascii")
    return path


def answers(*requests: Request) -> list[Answer]:
    """What is answered, without the process in between."""
    said = io.BytesIO()

    def handle(request: Request, _: object, stream: io.BytesIO) -> None:
        arrays, answer = server._answer(request)
        messages.send(stream, arrays, **answer)

    server.serve(io.BytesIO(b"".join(each.line() for each in requests)), said, handle)  # type: ignore[arg-type]
    said.seek(0)
    return [messages.receive(said, 10_000)[0] for _ in requests]


def test_each_request_has_its_answer_in_order(table: Path) -> None:
    read, missing, again = answers(request(table), request(table.with_name("b.csv")), request(table))
    assert isinstance(read.header, dict)
    assert [name for name, *_ in read.header["columns"]] == ["t", "top"]
    assert "there is no such file" in missing.refusal
    assert missing.error_number == 2
    assert again == read


def test_a_refusal_without_an_error_of_the_machine_is_the_files_own(table: Path) -> None:
    table.write_text("words\n", encoding="ascii")
    (refused,) = answers(request(table))
    assert refused.refusal.startswith("a.csv: no rows of numbers were found")
    assert (refused.error_number, refused.exit_code) == (None, None)


def test_what_swells_says_so(table: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def swell(path: Path, options: object) -> None:
        raise MemoryError

    swelling = replace(registry.formats()["delimited"], read=swell)
    monkeypatch.setattr(registry, "formats", lambda: {"delimited": swelling})
    assert answers(request(table))[0].exit_code == OUT_OF_MEMORY


def test_what_a_format_needs_is_imported_before_its_file_is_opened(
    table: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    imported: list[str] = []
    monkeypatch.setattr(server, "import_module", lambda name: imported.append(name) or import_module(name))
    answers(request(table, "tdms"))
    assert imported == ["colonnade.readers.registry", "nptdms", "colonnade.readers.registry"]
