"""What a stranger's file can do to its reader stays in the bounded process, fails that file alone, and has a name."""

import json
import multiprocessing
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from colonnade.errors import ReadError
from colonnade.readers.bounded import enclosure, messages, process
from colonnade.readers.recording import Recording
from colonnade.readers.registry import formats, read

on_linux = pytest.mark.skipif(sys.platform != "linux", reason="only Linux binds a process so far")
with_landlock = pytest.mark.skipif(not enclosure.landlock_version(), reason="this kernel has no Landlock")

Deed = Callable[..., Recording]


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """A folder in which a hostile format is installed as a package of its own."""
    folder = tmp_path_factory.mktemp("packages")
    (folder / "hostile_format.py").write_bytes((Path(__file__).parents[1] / "hostile_format.py").read_bytes())
    described = folder / "hostile_format-1.dist-info"
    described.mkdir()
    (described / "METADATA").write_text("Metadata-Version: 2.1\nName: hostile_format\nVersion: 1\n")
    (described / "entry_points.txt").write_text("[colonnade.formats]\nhostile = hostile_format:FORMAT\n")
    sys.path.insert(0, str(folder))
    formats.cache_clear()
    process.end()
    yield folder
    sys.path.remove(str(folder))
    formats.cache_clear()
    process.end()


@pytest.fixture
def do(installed, tmp_path):
    """Read a file of a campaign whose reader then does a deed to a victim."""
    folder = tmp_path / "campaign"
    folder.mkdir()
    path = folder / "free-01.hostile"
    path.write_bytes(bytes(1000))

    def read_it(deed="", victim=""):
        return read(path, options={"deed": deed, "victim": str(victim)}, within=folder)

    return read_it


def came_of(recording):
    return float(recording.channels[0].values[0])


def test_one_process_serves_all_files_and_each_is_read_in_a_copy(do):
    (first, server), (second, again) = (do().channels[0].values for _ in range(2))
    assert os.getpid() not in (first, server)
    assert server == again
    if sys.platform == "linux":
        assert len({first, second, server}) == 3


@pytest.mark.parametrize("deed", ["crash", "abort"])
def test_a_crash_fails_its_own_file_alone(do, deed):
    with pytest.raises(
        ReadError, match=r"reading it as .hostile. took .* or crashed the library that does it"
    ) as crash:
        do(deed)
    assert crash.value.__cause__ is None  # kept against the file
    assert do().channels


def test_an_exception_is_told_with_its_message_and_a_refusal_as_it_is(do):
    with pytest.raises(ReadError) as stumbled:
        do("stumble", 17)
    assert 'free-01.hostile: it cannot be read as "hostile" (ValueError: half a block at byte 17).' in str(
        stumbled.value
    )
    with pytest.raises(ReadError) as refused:
        do("refuse")
    assert str(refused.value) == "free-01.hostile: its rate is 0 Hz. Give sampling_rate."
    assert do().channels


@on_linux
def test_what_swells_is_stopped_at_its_bound(do, monkeypatch):
    monkeypatch.setattr(enclosure, "MEMORY", 200_000_000)
    with pytest.raises(ReadError, match=r"reading it as .hostile. took too much memory \(more than 200 MB"):
        do("swell")
    assert came_of(do("swell_natively")) == 0
    monkeypatch.undo()
    assert came_of(do("swell")) == 1e8  # which is none of a bound's business


@pytest.mark.whole
@on_linux
def test_what_does_not_end_is_stopped(do, monkeypatch):
    monkeypatch.setattr(enclosure, "SECONDS", 1)
    monkeypatch.setattr(enclosure, "PATIENCE", 100)
    with pytest.raises(ReadError, match=r"reading it as .hostile. took .* time \(more than 1 s\)"):
        do("spin")
    monkeypatch.setattr(enclosure, "PATIENCE", 1.5)
    with pytest.raises(ReadError, match=r"reading it as .hostile. took .* time") as late:
        do("sleep")
    assert isinstance(late.value.__cause__, OSError)  # the machine may have been busy: the next run tries again
    assert do().channels


@pytest.mark.parametrize("deed", ["look", "write", "remove", "spawn", "unpickle", "call"])
@on_linux
def test_a_reader_can_only_read_and_only_files_of_the_campaign(do, tmp_path, deed):
    victim = tmp_path / "victim"
    if deed in ("look", "remove"):
        victim.write_text("secret")
    with socket.create_server(("127.0.0.1", 0)) as server:
        where = server.getsockname()[1] if deed == "call" else victim
        with pytest.raises(ReadError, match=r'free-01.hostile: it cannot be read as "hostile" \(ForbiddenError: .*'):
            do(deed, where)
    assert victim.exists() == (deed in ("look", "remove"))


@with_landlock
@pytest.mark.parametrize("deed", ["look_natively", "write_natively", "call_natively", "spawn_natively"])
def test_code_that_goes_round_python_is_held_by_the_kernel(do, tmp_path, deed):
    victim = tmp_path / "victim"
    if deed == "look_natively":
        victim.write_text("secret")
    with socket.create_server(("127.0.0.1", 0)) as server:
        came = came_of(do(deed, server.getsockname()[1] if deed == "call_natively" else victim))
    assert came < 0 or (deed == "spawn_natively" and came != 0)
    assert victim.exists() == (deed == "look_natively")


def test_a_reader_that_lies_is_not_believed(do):
    with pytest.raises(ReadError, match=r"reading it as .hostile. .* crashed the library"):
        do("lie")
    assert do().channels


def test_what_a_library_prints_is_not_taken_for_an_answer(do):
    assert came_of(do("chatter")) == 0


SCRIPT = """
import sys
from pathlib import Path
from colonnade.readers.registry import read
sys.path.insert(0, sys.argv[1])
path = Path(sys.argv[2])
print(int(read(path).channels[0].values[1]), flush=True)
if len(sys.argv) > 3:
    read(path, options={"deed": sys.argv[3]})
"""


def is_alive(pid):
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"


@on_linux
@pytest.mark.parametrize("deed", [None, "sleep"], ids=["in its end", "killed while it waits for a file"])
def test_the_process_does_not_outlive_the_one_that_asks(installed, tmp_path, deed):
    path = tmp_path / "free-01.hostile"
    path.write_bytes(b"1")
    script = [sys.executable, "-c", SCRIPT, str(installed), str(path), *([deed] if deed else [])]
    asking = subprocess.Popen(script, stdout=subprocess.PIPE, text=True)
    server = int(asking.stdout.readline())
    if deed:
        time.sleep(0.5)
        assert is_alive(server)
        asking.send_signal(signal.SIGKILL)
    asking.communicate(timeout=60)
    ends = time.monotonic() + 10
    while is_alive(server) and time.monotonic() < ends:
        time.sleep(0.05)
    assert not is_alive(server)


def _read_in_a_daemon(path, found):
    found.put(came_of(read(Path(path))))


@on_linux
def test_a_worker_that_may_have_no_children_of_multiprocessing_reads_too(do, tmp_path):
    assert do().channels  # which a fork must not go on asking
    context = multiprocessing.get_context("fork")
    found = context.SimpleQueue()
    where = str(tmp_path / "campaign" / "free-01.hostile")
    worker = context.Process(target=_read_in_a_daemon, args=(where, found), daemon=True)
    worker.start()
    worker.join(60)
    assert worker.exitcode == 0
    assert found.get() > 0
    assert do().channels


def test_a_system_without_safe_copies_reads_in_the_process_itself(installed, tmp_path):
    path = tmp_path / "free-01.hostile"
    path.write_bytes(b"1")
    function, given = "colonnade.readers.registry:read_here", {"format": "hostile", "options": {}}
    told = {"function": function, "path": path, "within": tmp_path, "kind": "hostile", "modules": ()}
    request = messages.Request(**told, options=given, bounds=enclosure.bounds_of(path))
    serve = (
        "import sys; sys.path.insert(0, sys.argv[1]); from colonnade.readers.bounded import server; "
        "server.serve(sys.stdin.buffer, sys.stdout.buffer, server.in_place)"
    )
    elsewhere = tmp_path.parent / f"{tmp_path.name}-secret"
    elsewhere.write_text("secret")
    deed = request.model_copy(update={"options": {**given, "options": {"deed": "look", "victim": str(elsewhere)}}})
    lines = request.line() + deed.line() + request.line()
    said = subprocess.run([sys.executable, "-c", serve, str(installed)], input=lines, capture_output=True, check=True)
    first, refused, last = (part.split(b"\n", 1)[0] for part in said.stdout.split(messages.BEGUN)[1:])
    assert json.loads(first)["arrays"] == json.loads(last)["arrays"] == [{"dtype": "<f8", "shape": [2]}]
    assert "outside the campaign's folder" in json.loads(refused)["refusal"]
