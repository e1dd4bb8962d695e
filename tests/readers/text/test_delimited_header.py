"""What is known of a delimited text from its head, before its samples are read."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

from colonnade.errors import ReadError
from colonnade.readers.text.delimited import DelimitedOptions, read_header
from colonnade.readers.text.encoding import Text
from every import every

ROWS = "".join(f"{number},0;{number},25;{-number},5\n" for number in range(30))


def header(path, text, encoding="utf-8", **options):
    path.write_bytes(text.encode(encoding))
    given = DelimitedOptions.model_validate(options)
    return read_header(Text.of(path, given.encoding), given)


def test_the_head_gives_dialect_names_units_and_claims(tmp_path):
    found = header(tmp_path / "a.csv", "Prüfung 3, interval 0.01 s\nZeit;Weg\xa0oben;ACC\ns;mm;g\n" + ROWS, "cp1252")
    dialect = found.form.dialect
    assert (dialect.delimiter, dialect.decimal) == (";", ",")
    assert found.notes[0].startswith("encoding cp1252")
    assert found.heading.units == ("s", "mm", "g")
    assert (found.first, found.heading.is_named) == (3, True)
    assert found.claims.step == 0.01


def test_words_between_single_blanks_may_be_a_sentence(tmp_path):
    rows = "1.5 2.5 3.5\n" * 20
    assert header(tmp_path / "a.txt", "three plain words\n" + rows).heading.is_named is False
    assert header(tmp_path / "a.txt", "three  plain  words\n" + rows).heading.is_named is True
    assert header(tmp_path / "a.txt", rows).heading.is_named is False


@every(
    ("text", "options", "told"),
    [
        ("", {}, "no rows of numbers were found in the first 0 lines"),
        ("\n \n", {}, "no rows of numbers were found in the first 2 lines"),
        ("\x01\x02\x03" * 100, {}, "not printable"),
        ("only words\n" * 5, {}, "no rows of numbers were found in the first 5 lines"),
        ("a b\n1 2\n", {"delimiter": ";", "decimal": ","}, "with delimiter = ';', decimal = ','"),
    ],
)
def test_a_text_without_rows_is_refused_with_the_reason(tmp_path, text, options, told):
    with pytest.raises(ReadError, match=told):
        header(tmp_path / "a.csv", text, **options)


def test_text_in_another_encoding_than_given_is_refused(tmp_path):
    (tmp_path / "a.csv").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ReadError, match="utf-32"):
        read_header(Text.of(tmp_path / "a.csv", "utf-32"), DelimitedOptions(encoding="utf-32"))


@every(("word", "sign"), [("tab", "\t"), ("Semicolon", ";"), ("spaces", " "), ("|", "|")])
def test_a_delimiter_may_be_a_word(word, sign):
    assert DelimitedOptions(delimiter=word).delimiter == sign


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60, deadline=None)
@given(
    some.lists(some.text("abc 1.5;,\t#", max_size=20), max_size=4),
    some.sampled_from([";", ",", "\t"]),
    some.integers(2, 5),
)
def test_whatever_is_above_the_rows_these_are_found(tmp_path, above, delimiter, width):
    rows = [delimiter.join(f"{row + column}.5" for column in range(width)) for row in range(200)]
    found = header(tmp_path / "a.csv", "\n".join([*above, *rows, ""]))
    assert len(found.form.kinds) == width
    assert found.first <= len(above) + 1


NAMELESS = ["column 1", "column 2", "column 3"]


@pytest.mark.parametrize(
    ("above", "names"),
    [("Time, Disp, Acc", ["Time", "Disp", "Acc"]), ("Simulator, Stand 3", NAMELESS), ("rate: 200 Hz", NAMELESS)],
    ids=["names", "a sentence", "a setting"],
)
def test_words_with_commas_above_columns_between_blanks(tmp_path, above, names):
    path = tmp_path / "record.txt"
    path.write_text(f"{above}\n" + "".join(f"{n / 100:.2f}  {n % 7}.5  {n % 5}.25\n" for n in range(30)))
    assert list(read_header(Text.of(path), DelimitedOptions()).heading.names) == names
