"""Machine code is kept between processes, follows every source that it is made of, and needs no folder."""

import os
import shutil
import subprocess
import sys

import pytest

from colonnade.dynamics import kernel

CALLEE = """
from colonnade.dynamics.kernel import kernel
from colonnade.dynamics.number import FACTOR

@kernel
def scaled(x):
    return FACTOR * x
"""

CALLER = """
from colonnade.dynamics.callee import scaled
from colonnade.dynamics.kernel import kernel

@kernel
def raised(x):
    return scaled(x) + 1.0
"""

ASKED = """
from colonnade.dynamics.caller import raised
value = raised(2.0)
print(value, sum(raised.stats.cache_hits.values()), sum(raised.stats.cache_misses.values()))
"""


@pytest.fixture
def package(tmp_path):
    """A package of two kernels in two files, a constant in a third, and the house's own `kernel`."""
    folder = tmp_path / "source" / "colonnade" / "dynamics"
    folder.mkdir(parents=True)
    (folder.parent / "__init__.py").touch()
    (folder / "__init__.py").touch()
    shutil.copy(kernel.__file__, folder)
    (folder / "callee.py").write_text(CALLEE)
    (folder / "caller.py").write_text(CALLER)
    (folder / "number.py").write_text("FACTOR = 3.0\n")
    return folder


def asked(package, **environment):
    """Value, cache hits and misses in a process of its own."""
    code = f"import sys; sys.path.insert(0, {str(package.parents[1])!r}){ASKED}"
    plain = {key: value for key, value in os.environ.items() if key not in ("NUMBA_CACHE_DIR", "PYTHONPATH")}
    done = subprocess.run(
        [sys.executable, "-c", code], env={**plain, **environment}, capture_output=True, text=True, check=True
    )
    value, hits, misses = done.stdout.split()
    return float(value), int(hits), int(misses)


@pytest.mark.whole
def test_kept_machine_code_follows_every_source_that_it_is_made_of(package):
    assert asked(package) == (7.0, 0, 1)
    assert asked(package) == (7.0, 1, 0)
    (package / "callee.py").write_text(CALLEE.replace("FACTOR * x", "FACTOR * x * x"))
    assert asked(package) == (13.0, 0, 1)
    (package / "number.py").write_text("FACTOR = 1.0\n")
    assert asked(package) == (5.0, 0, 1)
    (package / "other.py").write_text("not_in_a_kernel = 1\n")
    assert asked(package) == (5.0, 1, 0)
    assert len(list((package / "__pycache__").glob("caller.raised-*.nbi"))) == 3


@pytest.mark.whole
def test_without_any_folder_each_process_compiles(package, tmp_path):
    (package / "__pycache__").touch()  # a file, so that nothing can be put there
    (tmp_path / "file").touch()
    nowhere = str(tmp_path / "file" / "inside")
    for _ in range(2):
        assert asked(package, XDG_CACHE_HOME=nowhere) == (7.0, 0, 1)


@pytest.mark.whole
def test_machine_code_is_kept_where_the_user_says_or_else_at_home(package, tmp_path):
    (package / "__pycache__").touch()
    for name in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME"):
        found = [asked(package, **{name: str(tmp_path / name)}) for _ in range(2)]
        assert found == [(7.0, 0, 1), (7.0, 1, 0)]
        assert list((tmp_path / name).rglob("caller.raised-*.nbi"))
