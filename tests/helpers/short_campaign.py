"""A campaign of short files that the tests of runs, watches and kills write, run and change."""

import json
import shutil
from hashlib import sha256
from pathlib import Path

import numpy as np

from colonnade.dynamics.motion import Motion
from colonnade.dynamics.rock import rock
from colonnade.store import files
from colonnade.store.layout import Layout
from colonnade.store.provenance import hash_of
from colonnade.workflow import run
from colonnade.workflow.product import mark_of
from prism import PRISM, TOP, campaign_of, entry

CAMPAIGN = campaign_of(
    TOP,
    'table = {column = "table", quantity = "acceleration", unit = "m/s^2", on = "table", direction = [1, 0, 0]}',
    before="[processing.predict.ensemble]\nmembers = 20\n",
)
TESTS = {"free-01": "free-vibration", "free-02": "free-vibration", "pulse-01": "pulse", "pulse-02": "pulse"}
RATE = 200.0


def write_campaign(folder, tests=TESTS):
    """Write the campaign and its raw files; the folder is returned."""
    (folder / "raw").mkdir(parents=True)
    text = CAMPAIGN
    for number, (name, kind) in enumerate(tests.items()):
        text += entry(name, kind)
        moved = {"theta0": 0.5 * PRISM.critical_angle} if kind == "free-vibration" else {"pulse": 2.4 + 0.2 * number}
        write_columns(folder / "raw" / f"{name}.csv", record(number, **moved))
    (folder / "campaign.toml").write_text(text, encoding="utf-8")
    return folder


def record(number, *, theta0=0.0, pulse=0.0, rate=RATE, duration=8.0):
    """Columns of a release or of a pulse, m/s², with noise: s, mm and m/s²."""
    noise, time = np.random.default_rng(number), np.arange(0.0, duration, 1 / rate)
    base = np.where((time > 1.0) & (time < 1.3), pulse * np.sin((time - 1.0) * 2 * np.pi / 0.3), 0.0)
    angle = rock(PRISM, Motion(base, 1 / rate), restitution=0.93, theta0=theta0).angle
    top = 440 * np.sin(angle) + 0.01 * noise.standard_normal(time.size)
    return {"time": time, "top": top, "table": base + 0.002 * noise.standard_normal(time.size)}


def write_columns(path, columns, sign=","):
    """Write them as delimited text."""
    rows = np.column_stack(list(columns.values()))
    np.savetxt(path, rows, delimiter=sign, header=sign.join(columns), comments="", fmt="%.6f")


def copied(campaign, folder):
    """Copy a campaign with its results, as if it had been run there: the catalogue knows the copies of its files."""
    layout = Layout(Path(shutil.copytree(campaign, folder)))
    known = json.loads(layout.catalogue.read_text(encoding="utf-8"))
    del known["sha256"]
    for name, kept in known.items():
        kind, place, *_ = name.split(" ")
        if kind in ("raw", "results", "pages"):
            kept[0] = list(mark_of(folder / place))
    known["sha256"] = hash_of(known)
    layout.catalogue.write_text(json.dumps(known, separators=(",", ":")), encoding="utf-8")
    return folder


class Small:
    """A copy of the small campaign."""

    def __init__(self, folder):
        self.folder = folder
        self.layout = Layout(folder)

    def run(self, **options):
        """Run it up to the comparison, in this process."""
        return run(self.folder, **({"workers": 1, "until": "compare"} | options))

    def complete(self):
        """Run all of it, with the report."""
        assert not self.run(until="report").failed

    def redone(self, **options):
        """Run it; return the reason of each stage that was executed."""
        return {(stage.subject, stage.stage): stage.because for stage in self.run(**options).stages if stage.because}

    def summary(self):
        """Return summary.json."""
        return json.loads(self.layout.summary_json.read_text(encoding="utf-8"))

    def files(self):
        """Time and hash of every file but the lock, which holds nothing."""
        return {
            path.relative_to(self.folder).as_posix(): (path.stat().st_mtime_ns, sha256(path.read_bytes()).hexdigest())
            for path in sorted(self.folder.rglob("*"))
            if path.is_file() and path != self.layout.lock
        }

    def contents(self):
        """Hash of the values of every result; each is whole, or this raises."""
        return {
            path.relative_to(self.folder).as_posix(): files.read(path).attrs["content"]
            for path in sorted(self.layout.processed.rglob("*.nc"))
        }

    def raw(self, test):
        """Raw file of a test."""
        return self.folder / "raw" / f"{test}.csv"

    def change_a_sample(self, test, line=300):
        """Add 0.1 mm to one sample of the transducer."""
        lines = self.raw(test).read_text(encoding="utf-8").splitlines()
        time, top, table = lines[line].split(",")
        lines[line] = f"{time},{float(top) + 0.1:.6f},{table}"
        self.raw(test).write_text("\n".join(lines) + "\n", encoding="utf-8")

    def edit(self, before, after):
        """Change campaign.toml."""
        path = self.folder / "campaign.toml"
        text = path.read_text(encoding="utf-8")
        assert before in text
        path.write_text(text.replace(before, after), encoding="utf-8")
