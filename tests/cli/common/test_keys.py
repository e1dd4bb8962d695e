"""Options that come from the keys of tables."""

from colonnade.cli.app import app


def options(name):
    return {each.name: each for each in app.commands[name].params}


def test_options_of_a_table_are_those_of_its_keys():
    from colonnade.campaign.assessment import Assessment
    from colonnade.workflow.spectrum import Asked

    made = options("spectrum")
    assert Asked.model_fields.keys() <= made.keys()
    assert all(made[key].help.startswith(field.description) for key, field in Asked.model_fields.items())
    assert (made["omega"].nargs, made["slenderness"].multiple, made["slenderness"].opts) == (2, True, ["--slenderness"])
    assert made["points"].help.endswith("Default: 24.")
    assert [made[key].type.name for key in ("points", "cycles", "peak", "model")] == [
        "integer",
        "float",
        "text",
        "choice",
    ]
    left_out = {"specimen", "scale", "measures", "displaced"}
    assess = options("fragility")
    assert Assessment.model_fields.keys() - left_out <= assess.keys()
    assert assess["levels"].opts == ["--level"]
