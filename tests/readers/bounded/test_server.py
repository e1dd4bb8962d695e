"""The process that reads: one answer for each request, in order, whatever comes of it."""

import io
from importlib import import_module

import pytest

from colonnade.readers import registry
from colonnade.readers.bounded import messages, server
from colonnade.readers.bounded.enclosure import bounds_of
from colonnade.readers.bounded.messages import Request


def request(path, format="delimited", **options):
    given = {"format": format, "options": options, "window": None}
    modules = registry.formats()[format].modules
    function = "colonnade.readers.registry:read_here"
    told = {"function": function, "path": path, "within": path.parent, "options": given, "kind": format}
    return Request(**told, modules=modules, bounds=bounds_of(path))


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("t [s];top [mm]\n0;1\n1;2\n2;4\n", encoding="ascii")
    return path


def answers(*requests):
    """What is answered, without the process in between."""
    said = io.BytesIO()

    def handle(request, _, stream):
        arrays, answer = server._answer(request)
        messages.send(stream, arrays, **answer)

    server.serve(io.BytesIO(b"".join(each.line() for each in requests)), said, handle)  # type: ignore[arg-type]
    said.seek(0)
    return [messages.receive(said, 10_000)[0] for _ in requests]


def test_each_request_has_its_answer_in_order(table):
    read, missing, again = answers(request(table), request(table.with_name("b.csv")), request(table))
    assert isinstance(read.header, dict)
    assert [name for name, *_ in read.header["columns"]] == ["t", "top"]
    assert "there is no such file" in missing.refusal
    assert missing.error_number == 2
    assert again == read


def test_a_refusal_without_an_error_of_the_machine_is_the_files_own(table):
    table.write_text("words\n", encoding="ascii")
    (refused,) = answers(request(table))
    assert refused.refusal.startswith("a.csv: no rows of numbers were found")
    assert (refused.error_number, refused.exit_code) == (None, None)


def test_what_a_format_needs_is_imported_before_its_file_is_opened(table, monkeypatch):
    imported = []
    monkeypatch.setattr(server, "import_module", lambda name: imported.append(name) or import_module(name))
    answers(request(table, "tdms"))
    assert imported == ["colonnade.readers.registry", "nptdms", "colonnade.readers.registry"]
