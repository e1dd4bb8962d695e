"""What a process may take and gives up before it opens a stranger's file; each test binds a process of its own."""

import subprocess
import sys
from pathlib import Path

import pytest

from colonnade.readers.bounded import enclosure as bounds
from colonnade.readers.bounded.enclosure import OUT_OF_MEMORY, own_folders


def test_a_long_file_has_more_time_and_memory_up_to_the_machine(tmp_path):
    short, long = tmp_path / "short", tmp_path / "long"
    short.write_bytes(b"1")
    with long.open("wb") as stream:
        stream.truncate(50_000_000)
    small, large = bounds.bounds_of(short), bounds.bounds_of(short, long)
    assert small.processor == 8
    assert large.processor == 208
    assert small.memory < large.memory <= small.memory + 64 * 50_000_001
    assert bounds.bounds_of(tmp_path / "missing") == bounds.Bounds(bounds.MEMORY, 8, 24)


on_linux = pytest.mark.skipif(sys.platform != "linux", reason="only Linux binds a process so far")


def came_of(code, *arguments):
    """What a process prints, or the last line of what it says as it fails."""
    told = subprocess.run([sys.executable, "-c", code, *map(str, arguments)], capture_output=True, text=True)
    return told.stdout.strip() if told.returncode == 0 else told.stderr.strip().splitlines()[-1]


def test_the_folders_of_python_and_its_packages_are_never_the_whole_disk():
    folders = own_folders()
    assert Path(folders[0].anchor) not in folders
    assert any(Path(subprocess.__file__).is_relative_to(folder) for folder in folders)
    assert any(Path(pytest.__file__).is_relative_to(folder) for folder in folders)


WATCH = """
import os, sys
from pathlib import Path
from colonnade.readers.bounded.enclosure import watch
watch([Path(sys.argv[1])])
print({})
"""


@pytest.mark.parametrize(
    ("deed", "told"),
    [
        ("open(sys.argv[1] + '/inside').read()", "inside"),
        ("open(sys.argv[1] + '/link').read()", "opening a file outside the campaign's folder was refused"),
        ("open(sys.argv[1] + '/inside', 'a')", "writing a file was refused"),
        ("open(os.devnull, 'w').write('x')", "1"),
        ("watch([Path(sys.argv[1]).parent]) or open(sys.argv[1] + '/link').read()", "outside"),
    ],
    ids=["inside", "a link outside", "writing", "nothing", "the next file's folder"],
)
def test_python_code_may_only_read_and_only_in_some_folders(tmp_path, deed, told):
    (tmp_path / "campaign").mkdir()
    (tmp_path / "campaign" / "inside").write_text("inside")
    (tmp_path / "outside").write_text("outside")
    (tmp_path / "campaign" / "link").symlink_to(tmp_path / "outside")
    assert told in came_of(WATCH.format(deed), tmp_path / "campaign")


LIMIT = """
import sys
from colonnade.readers.bounded.enclosure import Bounds
from colonnade.readers.bounded.enclosure import limit
limit(Bounds(int(sys.argv[1]), 60, 60.0))
print(len(bytearray(100_000_000)))
"""


@on_linux
def test_a_limit_that_holds_already_is_kept():
    code = "import resource; resource.setrlimit(resource.RLIMIT_DATA, (90_000_000,) * 2)" + LIMIT
    assert "MemoryError" in came_of(code, 10**12)


WATCHED = """
import sys, time
from colonnade.readers.bounded.enclosure import Bounds
from colonnade.readers.bounded.enclosure import watched_memory
with watched_memory(Bounds(int(sys.argv[1]), 60, 60.0)):
    taken = bytearray(b"1") * 100_000_000
    time.sleep(0.5)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="without a shell")
def test_where_a_system_has_no_such_limit_a_process_ends_itself_with_a_code_of_its_own():
    by_shell = ["sh", "-c", '"$0" -c "$1" "$2"; exit $?', sys.executable, WATCHED]
    codes = [subprocess.run([*by_shell, str(bound)]).returncode for bound in (300_000_000, 50_000_000)]
    assert codes == [0, OUT_OF_MEMORY]


def test_a_kernel_without_it_restricts_nothing_and_says_so(monkeypatch, tmp_path):
    monkeypatch.setattr(sys, "platform", "darwin")
    assert bounds.landlock_version() == 0
    assert not bounds.restrict([tmp_path])
