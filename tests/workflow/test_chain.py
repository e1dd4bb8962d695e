"""Order, freshness, failure, removal and kills of results, on a toy graph: three numbers, each made from the last."""

import os
import random
import signal
import time
from dataclasses import replace
from functools import partial

import pytest
import xarray as xr

from colonnade.errors import RunEndedError, StageError, StoreError
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import Origin
from colonnade.store.results import ResultId
from colonnade.workflow.chain import Chain, bring_up_to_date
from colonnade.workflow.executors import WorkersEndedError
from colonnade.workflow.lock import expect_run, only_run
from colonnade.workflow.product import Product, stored_attributes

STAGES = ("ingest", "condition", "rocking")


def tenth(value, upstream):
    """A tenth of the last number, without its decimals; of the first, the number that is given."""
    before = [int(each.attrs["toy"]) for each in upstream.values()]
    return xr.Dataset(attrs={"toy": value if not before else before[0] // 10})


def fails(error, upstream):
    raise error


@pytest.fixture
def layout(tmp_path):
    (tmp_path / "campaign.toml").write_text("")
    return Layout(tmp_path)


def toys(layout, *, value=120, code="one", make=None, asked=()):
    """Three results of a test, of which the first has an input; `make` replaces what makes some, by their stages."""
    results = [ResultId("toy", stage) for stage in STAGES]
    paths = [layout.path(result) for result in results]
    return [
        Product(
            result,
            f'{{"value": {value}}}' if number == 0 else "{}",
            {"before": paths[number - 1]} if number else {},
            code,
            (make or {}).get(result.stage, partial(tenth, value)),
            (paths[number],),
            is_asked=result.stage in asked,
        )
        for number, result in enumerate(results)
    ]


def chain(layout, run_id, products):
    return Chain(products, layout, Origin("toy", "Toy", None), run_id)


def ran(layout, **given):
    """Bring the toys up to date; give what became of each, and why."""
    with only_run(layout) as run_id:
        runs = bring_up_to_date(chain(layout, run_id, toys(layout, **given)))
    return [(run.action, run.because or run.reason) for run in runs]


def there(layout):
    return {path.name: files.read(path).attrs.get("toy") for path in layout.test("toy").glob("*.nc")}


def test_all_is_made_in_its_order_once_and_a_damaged_result_again(layout):
    assert ran(layout) == [("done", "never run")] * 3
    assert there(layout) == {"recorded.nc": 120, "conditioned.nc": 12, "rocking.nc": 1}
    before = {path: path.stat().st_mtime_ns for path in layout.test("toy").iterdir()}
    assert ran(layout) == [("up-to-date", "")] * 3
    assert {path: path.stat().st_mtime_ns for path in layout.test("toy").iterdir()} == before
    path = layout.stage("toy", "condition")
    path.write_bytes(path.read_bytes()[:1000])
    assert ran(layout) == [("up-to-date", ""), ("done", "never run"), ("up-to-date", "")]


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"value": 121}, [("done", "settings changed"), ("done", "upstream changed"), ("up-to-date", "")]),
        ({"value": 130}, [("done", "settings changed"), ("done", "upstream changed"), ("done", "upstream changed")]),
        ({"code": "two"}, [("done", "code changed")] * 3),
        ({"value": 130, "code": "two"}, [("done", "settings changed"), *[("done", "upstream changed")] * 2]),
        ({"asked": STAGES[1:]}, [("up-to-date", ""), ("done", "asked for"), ("done", "asked for")]),
    ],
    ids=["equal values stop the cascade", "other values go on", "code", "values before code", "asked for"],
)
def test_what_changed_is_made_again_and_why_is_told(layout, change, told):
    ran(layout)
    assert ran(layout, **change) == told
    change.pop("asked", None)
    assert ran(layout, **change) == [("up-to-date", "")] * 3


def test_a_failure_is_a_result_and_nothing_follows_from_it(layout):
    ran(layout)
    bad = {"condition": partial(fails, StageError("no."))}
    assert ran(layout, value=130, make=bad) == [("done", "settings changed"), ("failed", "upstream changed")]
    assert there(layout) == {"recorded.nc": 130, "conditioned.nc": None}
    assert ran(layout, value=130) == [("up-to-date", ""), ("failed", "no.")]  # the same would fail again
    assert [action for action, _ in ran(layout, value=131)] == ["done", "done", "done"]


@pytest.mark.parametrize(
    "error",
    [MemoryError(), StoreError("full."), WorkersEndedError("gone."), ImportError("cut off.")],
    ids=lambda error: type(error).__name__,
)
def test_a_failure_of_the_machine_is_not_stored(layout, error):
    assert [action for action, _ in ran(layout, make={"condition": partial(fails, error)})] == ["done", "failed"]
    assert there(layout) == {"recorded.nc": 120}
    assert ran(layout) == [("up-to-date", ""), ("done", "never run"), ("done", "never run")]


def test_a_fault_of_colonnade_is_told_with_its_place(layout):
    told = ran(layout, make={"rocking": partial(fails, ZeroDivisionError("by zero"))})
    assert [action for action, _ in told] == ["done", "done", "failed"]
    reason = stored_attributes(layout.stage("toy", "rocking"))["reason"]
    assert "Internal error in rocking, ZeroDivisionError at chain.py:" in reason
    assert "test_chain.py:" in reason
    assert "by zero" in reason


def test_nothing_is_written_or_removed_once_the_run_has_ended(layout):
    with only_run(layout) as run_id:
        bring_up_to_date(chain(layout, run_id, toys(layout)[:1]))
    before, path = there(layout), layout.stage("toy", "ingest")
    with pytest.raises(RunEndedError):
        bring_up_to_date(chain(layout, run_id, toys(layout)))
    with files.only_while(partial(expect_run, layout, run_id)):
        for change in (partial(files.remove, path), partial(files.write_text, path, "late")):
            with pytest.raises(RunEndedError):
                change()
    assert there(layout) == before
    assert list(path.parent.iterdir()) == [path]


def test_a_worker_that_does_not_see_the_results_is_told(layout, tmp_path):
    with only_run(layout) as run_id:
        elsewhere = chain(replace(layout, results=tmp_path / "elsewhere"), run_id, toys(layout))
        with pytest.raises(RunEndedError, match="does not see this folder"):
            bring_up_to_date(elsewhere)


@pytest.mark.whole
@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes are forked")
def test_a_run_that_is_killed_loses_nothing(layout):
    """Every file is whole or absent, the lock is free, and the next run gives the undisturbed values."""
    ran(layout)
    expected, chance = there(layout), random.Random(1)
    for _ in range(25):
        for path in layout.test("toy").iterdir():
            path.unlink()
        child = os.fork()
        if child == 0:
            try:
                ran(layout)
            finally:
                os._exit(0)
        time.sleep(chance.uniform(0.0, 0.03))
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        assert there(layout).items() <= expected.items()
        ran(layout)
        assert there(layout) == expected
        assert not list(layout.processed.rglob(f"*{files.PARTIAL}"))
