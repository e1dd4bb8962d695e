"""Two thousand damaged files of all formats that are read here: read, warned of or refused, soon, and nothing else."""

import math
import os
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

import whole_files

pytestmark = pytest.mark.drill

HERE = Path(__file__).parent
MUTATIONS = int(os.environ.get("DRILL_MUTATIONS", "2000"))
SEED = os.environ.get("DRILL_SEED", "7")
OUTCOMES = ("read", "warned", "refused", "caught")
"""Caught is a refusal that the registry made of a parser's exception."""


def read_all(file, format, count, by_kind):
    """Read so many damaged copies, counting what came of them; return the findings."""
    findings = []
    first = 0
    while first < count:
        told = subprocess.run(
            [sys.executable, HERE / "read_damaged.py", file, format, SEED, str(first), str(count)],
            capture_output=True,
            text=True,
            errors="replace",
            env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
        )
        begun = ""
        for line in told.stdout.splitlines():
            kind, *said = line.split(" ", 2)
            if kind == "begin":
                begun, first = line, int(said[1]) + 1
                continue
            begun = ""
            if said[1] not in OUTCOMES:
                findings.append(f"{file.parent.name} {line}")
            by_kind[kind, said[1] if said[1] in OUTCOMES else "finding"] += 1
        if told.returncode == 0 and first >= count:
            break
        assert begun, told.stderr
        findings.append(f"{file.parent.name} {begun}: the process ended by {told.returncode}: {told.stderr[-1500:]}")
        by_kind[begun.split()[1], "finding"] += 1
    return findings


def table(counts, title):
    columns = (*OUTCOMES, "finding")
    rows = [f"{title:22s}" + "".join(f"{column:>9s}" for column in columns)]
    for name in dict.fromkeys(name for name, _ in counts):
        rows.append(f"{name:22s}" + "".join(f"{counts[name, column]:9d}" for column in columns))
    rows.append(f"{'':22s}" + "".join(f"{sum(counts[key] for key in counts if key[1] == c):9d}" for c in columns))
    return "\n".join(rows)


def test_damaged_files_are_read_or_refused(tmp_path, capsys):
    written = {name: whole_files.write(name, tmp_path) for name in whole_files.DRILLED}
    by_kind = Counter()
    by_name = Counter()
    findings = []
    for name, path in written.items():
        seen = Counter()
        findings += read_all(path, whole_files.format_of(name), math.ceil(MUTATIONS / len(written)), seen)
        by_kind += seen
        for (_, outcome), count in seen.items():
            by_name[name, outcome] += count
    with capsys.disabled():
        print(f"\n{table(by_name, 'file')}\n\n{table(by_kind, 'damage')}")
    assert not findings, "\n".join(findings)
    assert sum(by_name.values()) >= MUTATIONS
    for name in written:
        counts = {outcome: by_name[name, outcome] for outcome in OUTCOMES}
        assert counts["read"] + counts["warned"] > 0, name
        assert counts["warned"] + counts["refused"] + counts["caught"] > 0, name
