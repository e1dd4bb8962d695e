"""A file goes to the format that recognises it, else each says why; what belongs to it is beside it, nowhere else."""

import struct
import subprocess
import sys
from dataclasses import replace
from importlib.util import find_spec

import pytest
from pydantic import ValidationError

from colonnade.errors import ReadError
from colonnade.readers import registry
from colonnade.readers.format import Format, Options, Recognition
from colonnade.readers.registry import companions, formats, read
from colonnade.readers.text.delimited import FORMAT as DELIMITED
from every import every


def test_delimited_text_is_always_known_and_asked_last():
    assert list(formats())[-1] == "delimited"


def test_the_format_that_took_a_file_is_noted(path):
    path.write_text("a;b\n1;2\n3;4\n")
    recording = read(path)
    assert recording.format == "delimited"
    assert recording.notes[0].startswith('format "delimited" (text with rows of 2 numbers from line 2 on)')


def test_a_file_that_nobody_takes_gives_each_formats_reason(path):
    path.write_text("nothing but words\n")
    with pytest.raises(ReadError) as refusal:
        read(path)
    for name in formats():
        assert f"\n  {name}: " in str(refusal.value)


def test_a_missing_file_is_told_with_the_nearest_name(tmp_path):
    (tmp_path / "free-01.csv").write_text("1\n")
    with pytest.raises(ReadError, match=r'free-10.csv: there is no such file in .* Did you mean "free-01.csv"'):
        read(tmp_path / "free-10.csv")
    with pytest.raises(ReadError, match="there is no folder"):
        read(tmp_path / "raw" / "free-10.csv")


def test_a_folder_is_no_raw_file(tmp_path):
    with pytest.raises(ReadError, match="this is a folder"):
        read(tmp_path)


def test_an_unknown_format_is_told_with_the_nearest_name(tmp_path):
    with pytest.raises(ReadError, match=r'Unknown format "delimitted". Did you mean "delimited"'):
        read(tmp_path / "record.csv", "delimitted")


def stumbling(error, **told):
    """A format whose parser stumbles over every file."""

    def read(path, options):
        raise error

    return Format("odd", "", (), lambda path: Recognition(True, "always"), read, in_process=True, **told)


@pytest.fixture
def only(tmp_path, monkeypatch):
    (tmp_path / "r.bin").write_bytes(b"1")

    def use(format):
        monkeypatch.setattr(registry, "formats", lambda: {format.name: format})

    return use


def test_whatever_a_parser_stumbles_over_is_told_with_the_file_and_what_to_do(tmp_path, only):
    only(stumbling(RecursionError()))
    with pytest.raises(ReadError, match=r'r.bin: it cannot be read as "odd" \(RecursionError.*Copy it from'):
        read(tmp_path / "r.bin")


def test_a_recogniser_that_stumbles_leaves_the_others_their_turn(path, monkeypatch):
    def recognise(path):
        raise struct.error("unpack requires 8 bytes")

    odd = replace(stumbling(ValueError()), recognise=recognise)
    monkeypatch.setattr(registry, "formats", lambda: {"odd": odd, "delimited": DELIMITED})
    path.write_text("a;b\n1;2\n3;4\n")
    assert read(path).format == "delimited"
    path.write_text("words\n")
    with pytest.raises(ReadError, match=r"odd: it could not be examined \(error: unpack requires 8 bytes\)"):
        read(path)


def test_looking_at_a_file_loads_none_of_the_heavy_packages(path):
    path.write_bytes(bytes(range(256)) * 20)
    code = (
        "import sys; from pathlib import Path; from colonnade.readers.registry import formats; "
        f"[format.recognise(Path({str(path)!r})) for format in formats().values()]; "
        "print(*sorted({'obspy', 'pandas', 'scipy', 'h5py', 'matplotlib'} & sys.modules.keys()))"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert told.stdout.split() == []


def test_the_values_of_a_diadem_header_are_found_and_named_where_they_are_missing(written):
    path = written("diadem")
    assert companions(path) == (path.with_suffix(".tdx"),)
    path.with_suffix(".tdx").unlink()
    assert companions(path) == (path.with_suffix(".tdx"),)
    with pytest.raises(ReadError, match=r"its values are in the file \"record.tdx\"; they were expected next to it"):
        read(path)


def test_values_that_are_a_link_out_of_the_campaign_are_refused(written, tmp_path):
    path = written("diadem")
    values = path.with_suffix(".tdx")
    outside = tmp_path.parent / f"{tmp_path.name}-outside"
    values.rename(outside)
    values.symlink_to(outside)
    with pytest.raises(ReadError, match=r"its values are in record.tdx, which is a link to .*outside, outside "):
        read(path)
    assert companions(path) == (values,)  # to be hashed once it is a file
    inside = tmp_path / "elsewhere"
    inside.mkdir()
    outside.rename(inside / "record.tdx")
    values.unlink()
    values.symlink_to(inside / "record.tdx")
    assert read(path, within=tmp_path).channels


@every("format", ["tdms", "famos", "catman", "delimited"])
def test_a_file_that_is_whole_has_no_companions(format, path):
    path.write_text("a,b\n1,2\n3,4\n")
    assert companions(path, format) == ()
    assert companions(path) == ()


NAMES = tuple(formats())
RANDOM = bytes((37 * k * k + 11 * k) % 251 for k in range(4096))
"""Bytes of no format."""


@every("name", NAMES)
def test_a_format_describes_itself_in_one_line_under_its_own_name(name):
    known = formats()[name]
    assert known.name == name
    assert known.summary.strip() == known.summary != ""
    assert "\n" not in known.summary
    assert all(suffix.startswith(".") and suffix == suffix.lower() for suffix in known.suffixes)


@every("name", NAMES)
def test_every_option_of_a_format_is_optional_and_no_other_is_known_and_none_changes(name):
    options = formats()[name].options
    assert issubclass(options, Options)
    assert options() == options.model_validate({})
    with pytest.raises(ValidationError, match="no_such_option"):
        options.model_validate({"no_such_option": 1})
    with pytest.raises(ValidationError, match="frozen"):
        options().no_such_option = 1


@every("name", NAMES)
def test_the_modules_that_a_format_loads_late_exist(name):
    assert [module for module in formats()[name].modules if find_spec(module) is None] == []


@every("content", [b"\0", RANDOM, b"PK\x03\x04", b"\x89HDF\r\n\x1a\n"])
@every("name", NAMES)
def test_a_format_gives_its_reason_for_a_file_of_whatever_it_is(path, name, content):
    path.write_bytes(content)
    found = formats()[name].recognise(path)
    assert found.reason.strip() == found.reason != ""
    assert not (found.yes and found.is_known)
    assert not (found.yes and content == RANDOM)
