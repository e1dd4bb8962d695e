"""Raw files that are in several files: these are found beside the first, and nowhere else."""

import pytest

from colonnade.errors import ReadError
from colonnade.readers.registry import companions, read
from every import every


def test_the_values_of_a_diadem_header_are_found_and_named_where_they_are_missing(
    written,
):
    path = written("diadem")
    assert companions(path) == (path.with_suffix(".tdx"),)
    path.with_suffix(".tdx").unlink()
    assert companions(path) == (path.with_suffix(".tdx"),)
    with pytest.raises(ReadError, match=r"its values are in the file \"record.tdx\", which is not in its folder"):
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
def test_a_file_that_is_whole_has_no_companions(written, format, tmp_path):
    path = tmp_path / "r.csv"
    path.write_text("a,b\n1,2\n3,4\n")
    assert companions(path, format) == ()
    assert companions(path) == ()
