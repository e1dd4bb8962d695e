"""
A million histories of an assessment: against the kernel's own time, and on a cluster.

Marked slow; `python -m pytest -m slow tests/benchmarks/test_assessment_speed.py -s` prints the figures.
"""

import json
import math
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from colonnade.assessment.cases import Cases, factors_at, in_plane
from colonnade.assessment.real_column import RealColumn, draw, drawn_column
from colonnade.dynamics.block import Block
from colonnade.dynamics.motion import Motion
from colonnade.dynamics.plane.march import propagate
from colonnade.dynamics.plane.run import forcing_of
from colonnade.dynamics.plane.sides import sides_of

BLOCK = Block.measured(mass=1000.0, pole_distance=4.0, critical_angle=0.18, inertia=4 / 3 * 1000.0 * 16.0)
COLUMN = RealColumn(BLOCK, 0.95, restitution_range=(0.93, 0.97), critical_angle_range=(0.16, 0.2), p_range=(1.2, 1.5))
INTERVAL, SAMPLES = 0.005, 4000

pytestmark = pytest.mark.slow


def _record(seed):
    """Broad-band noise about 1.5 Hz that rises and dies away, 20 s at 200 Hz, both components; peak 1 m/s²."""
    random = np.random.default_rng(seed)
    moment = np.arange(SAMPLES) * INTERVAL
    hertz = np.fft.rfftfreq(SAMPLES, INTERVAL)

    def component():
        wave = np.fft.irfft(
            np.fft.rfft(random.standard_normal(SAMPLES)) * np.exp(-(((hertz - 1.5) / 1.5) ** 2)), SAMPLES
        )
        wave *= (moment / 5.0 * np.exp(1.0 - moment / 5.0)) ** 2
        return wave / np.abs(wave).max()

    return Motion(component(), INTERVAL, transverse=component())


def _cases(records, levels, draws):
    """Levels from well above uplift on, so that every history rocks: records, two components, levels, draws."""
    peaks = np.geomspace(1.2, 6.0, levels) * BLOCK.uplift_acceleration
    motions = tuple(_record(seed) for seed in range(records))
    return Cases(
        COLUMN, np.stack([draw(COLUMN, draws - 1)] * records), motions, factors_at(peaks, np.ones((records, 2)))
    )


def _kernel(cases, chosen):
    """Processor time of the kernel alone for some cases, s, with all that it takes prepared."""
    ready = []
    for case in chosen:
        record, level, which, _sign, place = np.unravel_index(int(case), cases.shape)
        motion = in_plane(cases.motions[record], place, float(cases.factors[record, level, place]))
        block, e = drawn_column(cases.column, cases.draws[record, which])
        ready.append((forcing_of(Motion(motion.acceleration / BLOCK.gravity, INTERVAL), 1.0), sides_of(block, e)))
    propagate(*ready[0], is_linearised=False)
    begin = time.process_time()
    for forcing, sides in ready:
        propagate(forcing, sides, is_linearised=False)
    return time.process_time() - begin


MILLION = """
import json, resource, sys, time
from functools import partial
from pathlib import Path
import test_assessment_speed as bench
from colonnade.assessment.cases import run_cases
cases = bench._cases(50, 20, 500)
run_cases(bench._cases(1, 1, 1))
begin = time.perf_counter()
outcomes = bench.outcomes_of(cases, bench.Where(workers=2), Path(sys.argv[1]), "key")
elapsed = time.perf_counter() - begin
from joblib.externals.loky import get_reusable_executor
get_reusable_executor().shutdown(wait=True)
workers = resource.getrusage(resource.RUSAGE_CHILDREN)
own = next(int(line.split()[1]) for line in Path("/proc/self/status").open() if line.startswith("VmHWM"))
print(json.dumps({
    "histories": int(outcomes.is_run.sum()), "overturned": float((outcomes.outcome == 2).mean()), "elapsed": elapsed,
    "processor": workers.ru_utime + workers.ru_stime, "memory": 1024 * (own + 2 * workers.ru_maxrss),
}))
"""


def test_a_million_histories_take_little_more_than_the_kernels_own_time(tmp_path, capsys):
    cases = _cases(50, 20, 500)
    assert math.prod(cases.shape) == 1_000_000
    chosen = np.random.default_rng(0).choice(1_000_000, 10_000, replace=False)
    kernel = 100.0 * _kernel(cases, chosen)
    command = [sys.executable, "-c", MILLION, str(tmp_path)]
    ended = subprocess.run(command, cwd=Path(__file__).parent, capture_output=True, text=True, check=True)
    found = json.loads(ended.stdout)
    ratio = found["processor"] / kernel
    with capsys.disabled():
        print(
            f"\n{found['histories']:,} histories, {100 * found['overturned']:.0f} % overturn: {found['elapsed']:.0f} s "
            f"on two processes, {found['processor']:.0f} s of their processor time, {ratio:.3f} times the kernel's own "
            f"{kernel:.0f} s; at most {found['memory'] / 1e6:.0f} MB in all three"
        )
    assert found["histories"] == 1_000_000
    assert ratio <= 1.3
    assert found["elapsed"] <= 720.0
    assert found["memory"] < 1e9
