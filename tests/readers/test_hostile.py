"""Hostile files by the names of tables; the files alone, and damaged, are read in tests/drill/test_hostile.py."""

import hostile
from colonnade.cli import invoke
from prism import TOP, campaign_of, entry


def test_no_command_runs_what_a_file_by_the_name_of_a_table_holds(tmp_path, tmp_path_factory, capsys):
    (tmp_path / "raw").mkdir()
    beside = tmp_path_factory.mktemp("beside") / "secrets"
    hostile.secrets(beside)
    inner = hostile.Place(tmp_path / "raw", beside, tmp_path / "made")
    text = campaign_of(TOP.replace('"top"', '"plain"'), before='[setups.frame]\nsampling_rate = "100 Hz"\n')
    for number, name in enumerate(("netcdf_elsewhere", "pickle_as_text", "matlab_elsewhere"), 1):
        path = hostile.FILES[name](inner)
        path = path.rename(path.with_name(f"free-0{number}.csv"))
        text += entry(path.stem, "other")
    for command in (["init"], ["check"], ["ingest", "--workers", "1"]):
        capsys.readouterr()
        invoke([*command, str(tmp_path)])
        if command == ["init"]:
            (tmp_path / "campaign.toml").write_text(text, encoding="utf-8")
        assert "Internal error" not in capsys.readouterr().out
    assert (tmp_path / "processed" / "tests" / "free-01" / "recorded.nc").exists()
    assert not inner.victim.exists()
