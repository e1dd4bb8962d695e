import json

from colonnade.cli import invoke
from foreseeing import TEST


def test_a_forecast_is_shown_and_kept(foreseen_copy, capsys):
    asked = ["foresee", str(foreseen_copy), "--motion", TEST, "--specimen", "prism"]
    assert invoke([*asked, "--level", "0.01 g"]) == 0
    said = capsys.readouterr().out.replace("\xa0", " ")
    assert "100 %" in said
    assert max(map(len, said.partition("forecast: ")[0].splitlines())) <= 80
    assert "forecast: " in said
    assert invoke([*asked, "--level", "1x", "--json"]) == 0
    (made,) = json.loads(capsys.readouterr().out)
    assert made["level"] == "1x"
    assert made["models"]["linear"]["bands"][2]["probability"] == 0.95


def test_a_wrong_level_is_a_wrong_use(foreseen_copy, capsys):
    assert invoke(["foresee", str(foreseen_copy), "--motion", TEST, "--level", "strong", "--specimen", "prism"]) == 2
    assert "--level strong" in capsys.readouterr().err
