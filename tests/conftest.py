"""What every test shares: a deterministic hypothesis, figures without a screen, real files found or skipped."""

import gc
import inspect
import json
import os
import pickle
import shutil
import signal
import sys
import sysconfig
from hashlib import sha256
from pathlib import Path

import pytest
from filelock import FileLock
from hypothesis import settings

os.environ.setdefault("MPLBACKEND", "Agg")

settings.register_profile("colonnade", deadline=None, derandomize=True)
settings.load_profile("colonnade")

COMPILING = ("dynamics", "identification")
"""Folders whose tests compile, in one process each, the kernels that all later processes then find compiled."""

LONGEST = (
    "test_pages.py",
    "test_site.py",
    "test_processes.py",
    "test_cluster.py",
    "test_wheel.py",
    "test_histories.py",
    "test_every_format.py",
)
"""Files that take half a minute and more."""


def _turn(item):
    if not set(COMPILING).isdisjoint(item.path.parts):
        return 0
    return 1 + (LONGEST.index(item.path.name) if item.path.name in LONGEST else len(LONGEST))


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items):
    """First what compiles, then the longest files, so that no process is left with one of these in the end."""
    items.sort(key=_turn)


def pytest_collection_finish():
    """What was collected stays to the end: the garbage collector need not look through it again and again."""
    gc.freeze()


TESTS = Path(__file__).resolve().parent
SHARED_DATA = TESTS.parents[1] / "shared" / "data"


@pytest.fixture(scope="session")
def shared_data():
    """Folder of real files from other laboratories; they are not part of the project."""
    if not SHARED_DATA.is_dir():
        pytest.skip(f"the collection of other laboratories' files is not here ({SHARED_DATA})")
    return SHARED_DATA


@pytest.fixture
def interruptible():
    """Processes that a test starts hear Ctrl-C and a hangup, also where this one does not (`nohup make test &`)."""
    before = {signal.SIGINT: signal.signal(signal.SIGINT, signal.default_int_handler)}
    if hasattr(signal, "SIGHUP"):
        before[signal.SIGHUP] = signal.signal(signal.SIGHUP, signal.SIG_DFL)
    yield
    for each, handler in before.items():
        signal.signal(each, handler)


REPORTS = TESTS.parent / "reports"


@pytest.fixture(scope="session")
def as_reported():
    """Hold a report written anew in a folder against the reference report of that name, and against the truth."""

    def check(folder, name):
        now, then = (json.loads((each / f"{name}.json").read_text(encoding="utf-8")) for each in (folder, REPORTS))
        assert now["restitution"].keys() == then["restitution"].keys()
        for specimen, restitution in then["restitution"].items():
            for key, value in restitution.items():
                assert now["restitution"][specimen][key] == pytest.approx(value, abs=5e-5)
            assert now["restitution"][specimen]["low"] <= restitution["true"] <= now["restitution"][specimen]["high"]
        assert now["tests"].keys() == then["tests"].keys()
        for test, known in then["tests"].items():
            found = now["tests"][test]
            assert found["outcome"]["measured"] == known["outcome"]["measured"] == found["outcome"]["true"], test
            assert found["order"] == known["order"], test
            measured = known["peak_ratio"]["measured"]
            # A whole-record peak differs between platforms only as far as rocking is sensitive.
            expected = None if measured is None else pytest.approx(measured, rel=0.1, abs=1e-3)
            assert found["peak_ratio"]["measured"] == expected, test

    return check


@pytest.fixture(scope="session")
def made_once(tmp_path_factory, pytestconfig):
    """
    Have a folder filled by the first process of the tests that needs it; all only look at it.

    It is kept in pytest's cache for later runs of the tests, until something changes that it is made by; further files
    that it is made from are given. A run looks at a copy, so that what it does to it is gone with it.
    """
    shared, cache = tmp_path_factory.getbasetemp(), pytestconfig.cache.mkdir("made")
    if "PYTEST_XDIST_WORKER" in os.environ:
        shared = shared.parent

    def made(name, fill, *files):
        folder, kept = shared / name, cache / name / _made_by(fill, files)
        with FileLock(cache / f"{name}.lock"):
            if not kept.exists():
                shutil.rmtree(kept.parent, ignore_errors=True)
                kept.parent.mkdir()
                fill(kept.with_name("filled"))
                kept.with_name("filled").rename(kept)
            if not folder.exists():
                shutil.copytree(kept, folder)
        return folder

    return made


def _made_by(fill, files):
    """Hash the package, the versions of others, examples, helpers, the module of the function, and further files."""
    from colonnade.sources import package_hash

    versions = sorted(path.name for path in Path(sysconfig.get_path("purelib")).glob("*.dist-info"))
    digest = sha256(f"{package_hash()} {sys.version} {versions}".encode())
    examples = sorted(path for path in (TESTS.parent / "raw_schema" / "examples").rglob("*") if path.is_file())
    helpers = sorted((TESTS / "helpers").rglob("*.py")) + sorted((TESTS / "helpers").rglob("*.toml"))
    for path in (*examples, *helpers, Path(inspect.getfile(fill)), *files):
        digest.update(f"{path.name}\n".encode() + path.read_bytes())
    return digest.hexdigest()[:16]


BEGINNINGS = ("colonnade demo demo --short", "python recordings.py")
"""Commands that many pages begin with."""


@pytest.fixture(scope="session")
def instead(made_once):
    """What many pages begin with is made by the first of them; the others get a copy. See `page_blocks.Reader`."""
    from page_blocks import Block, Reader

    def copied(words, folder):
        line = " ".join(words)
        if line not in BEGINNINGS:
            return None

        def make(shared):
            (shared / "made").mkdir(parents=True)
            for script in folder.glob("*.py"):
                shutil.copy(script, shared / "made")
            reader = Reader(shared / "made")
            reader.do(Block("", "sh", f"{line}\n"))
            (shared / "output.txt").write_text(reader.output, encoding="utf-8")

        shared = made_once(line.replace(" ", "-"), make, *sorted(folder.glob("*.py")))
        shutil.copytree(shared / "made", folder, dirs_exist_ok=True)
        return (shared / "output.txt").read_text(encoding="utf-8")

    return copied


@pytest.fixture
def undrawn(monkeypatch):
    """Pictures of pages are empty: for tests of what is made again and when, not of what it shows."""

    def empty(figure, *, identity, title, description):
        return f'<svg xmlns="http://www.w3.org/2000/svg" id="{identity}"></svg>'

    monkeypatch.setattr("colonnade.figures.files.output.to_svg", empty)


@pytest.fixture(scope="session")
def filled_campaign(made_once):
    """A small virtual campaign and its layout after one real run; look only."""
    from colonnade.campaign import load
    from colonnade.store.layout import Layout
    from small_campaign import run_small_campaign

    folder = made_once("small-campaign", run_small_campaign)
    return load(folder), Layout(folder)


@pytest.fixture(scope="session")
def reported(filled_campaign):
    """Each of its tests as its page and its figures see it."""
    from colonnade.report.pictures import read_of_test

    return {name: read_of_test(*filled_campaign, name) for name in filled_campaign[0].tests}


@pytest.fixture(scope="session")
def empty_campaign(made_once, tmp_path_factory):
    """The same campaign before anything was run."""
    from colonnade.campaign import load
    from colonnade.store.layout import Layout
    from small_campaign import write_small_campaign

    written = made_once("empty-campaign", write_small_campaign)
    folder = Path(shutil.copytree(written, tmp_path_factory.mktemp("empty") / "campaign"))
    return load(folder), Layout(folder)


@pytest.fixture(scope="session")
def foreseen(filled_campaign, tmp_path_factory):
    """A copy of the filled campaign with two forecasts of a planned test; look only."""
    from foreseeing import foresee_a_planned_test

    folder = tmp_path_factory.mktemp("foreseen") / "campaign"
    return folder, foresee_a_planned_test(filled_campaign[0].folder, folder)


@pytest.fixture
def foreseen_copy(foreseen, undrawn, tmp_path):
    """The same, to change."""
    return Path(shutil.copytree(foreseen[0], tmp_path / "campaign"))


@pytest.fixture(scope="session")
def shaken_drums(made_once):
    """How a column of drums moved, and a campaign of its recording that was run."""
    import drums
    from colonnade.workflow import run

    def record(folder):
        history = drums.write_campaign(folder)
        (folder / "history").write_bytes(pickle.dumps(history))
        assert not run(folder, workers=1).failed

    folder = made_once("drums", record)
    return pickle.loads((folder / "history").read_bytes()), folder


@pytest.fixture(scope="session")
def assessed(made_once):
    """A campaign with a real column that is assessed, after one real run; look only."""
    from assessing import write_assessed
    from colonnade.workflow.run import run

    return made_once("assessed", lambda folder: run(write_assessed(folder), workers=1))


@pytest.fixture
def assessed_copy(assessed, undrawn, tmp_path):
    """The same, to change."""
    from short_campaign import copied

    return copied(assessed, tmp_path / "assessed")
