"""Paths of results, as the contract gives them."""

from pathlib import Path

from colonnade.store.layout import Layout


def test_each_stage_has_its_file_in_the_tests_folder():
    stages = ("ingest", "condition", "rocking", "restitution", "compare")
    found = [Layout(Path("c")).stage("free-01", stage) for stage in stages]
    names = ("recorded", "conditioned", "rocking", "restitution", "compared")
    assert found == [Path(f"c/processed/tests/free-01/{name}.nc") for name in names]


def test_each_model_has_a_file():
    layout = Layout(Path("c"))
    assert layout.stage("free-01", "predict", "linear").name == "predicted-linear.nc"
    assert layout.stage("free-01", "ensemble", "linear").name == "ensemble-linear.nc"
    assert layout.stage("prism", "contact") == Path("c/processed/contact/prism.nc")
    assert layout.stage("prism", "responses", "linear") == Path("c/processed/maps/prism-linear-response.nc")


def test_specimens_summary_and_report_lie_where_the_contract_says():
    layout = Layout(Path("c"))
    assert layout.stage("prism", "specimen") == Path("c/processed/specimens/prism.nc")
    assert layout.summary_json == Path("c/processed/summary.json")
    assert layout.report == Path("c/report/index.html")
    assert layout.stage("prism", "map", "linear") == Path("c/processed/maps/prism-linear.nc")
