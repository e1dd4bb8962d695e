"""Hostile files, one a library: nothing runs, nothing outside the campaign is read."""

import numpy as np
import pytest

import hostile
from colonnade.cli import invoke
from colonnade.errors import ReadError
from colonnade.readers.registry import read

pytest.importorskip("xlwt")


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A campaign's folder, and secrets beside it."""
    folder = tmp_path_factory.mktemp("hostile")
    hostile.secrets(folder / "secrets")
    (folder / "campaign").mkdir()
    return hostile.Place(folder / "campaign", folder / "secrets", folder / "made")


# The file that swells takes all that a reader may: seconds.
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.whole if name == "matlab_swelling" else ()) for name in hostile.FILES]
)
def test_a_hostile_file_is_only_read(place, name):
    write = hostile.FILES[name]
    path, format, options = write(place)
    try:
        recording = read(path, format, options, within=place.folder)
    except ReadError as refusal:
        assert path.name in str(refusal)  # noqa: PT017 - either outcome is right
    else:
        for channel in recording.channels:
            assert not np.isin(channel.values, [*hostile.SECRET, *np.floor(hostile.SECRET)]).any()
        assert not any("31337" in text for text in (*recording.notes, *recording.warnings))
    assert not place.victim.exists()


CAMPAIGN = """\
schema = 1
campaign = "strange"
title = "A stranger's files"

[specimens]
prism = {shape = "prism", width = "86 mm", depth = "86 mm", height = "456 mm", mass = "26.10 kg"}

[setups.frame]
sampling_rate = "100 Hz"

[setups.frame.channels]
top = {column = "plain", quantity = "displacement", unit = "mm", on = "specimen", at = ["43 mm", "0 mm", "440 mm"], \
direction = [1, 0, 0], relative_to = "table"}

"""


def test_no_command_runs_what_a_file_by_the_name_of_a_table_holds(place, tmp_path, capsys):
    (tmp_path / "raw").mkdir()
    inner = place._replace(folder=tmp_path / "raw", victim=tmp_path / "made")
    text = CAMPAIGN
    for number, name in enumerate(("netcdf_elsewhere", "pickle_as_text", "matlab_elsewhere"), 1):
        path = hostile.FILES[name](inner).path
        path = path.rename(path.with_name(f"free-0{number}.csv"))
        text += f'[[tests]]\nid = "{path.stem}"\nkind = "other"\nfile = "raw/{path.name}"\n'
        text += 'specimen = "prism"\nsetup = "frame"\n\n'
    for command in (["init"], ["check"], ["ingest", "--workers", "1"]):
        capsys.readouterr()
        invoke([*command, str(tmp_path)])
        if command == ["init"]:
            (tmp_path / "campaign.toml").write_text(text, encoding="utf-8")
        assert "Internal error" not in capsys.readouterr().out
    assert (tmp_path / "processed" / "tests" / "free-01" / "recorded.nc").exists()
    assert not inner.victim.exists()
