"""An ensemble in parts is the one in one piece, bit for bit."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.block import Block
from colonnade.dynamics.ensembles.ensemble import Plan, ensemble
from colonnade.dynamics.ensembles.uncertainty import Uncertainty
from colonnade.dynamics.motion import Motion
from colonnade.workflow.execution.ensembles import run_ensemble

BLOCK = Block.prism(width=0.086, depth=0.086, height=0.456, mass=26.10)
MOTION = Motion(2.2 * np.sin(np.arange(400) * 0.15), 0.005)
UNCERTAINTY = Uncertainty(restitution=0.005, p=0.01, noise=0.05, cutoff=20.0, filter=0.1)


@pytest.mark.parametrize("workers", [1, 2])
def test_parts_on_several_processes_give_the_whole_bit_for_bit(workers):
    whole = ensemble(BLOCK, MOTION, restitution=0.97, uncertainty=UNCERTAINTY, count=150)
    parts = run_ensemble(Plan(BLOCK, MOTION, 0.97, UNCERTAINTY, count=150), workers=workers)
    for name in ("bands", "central", "inputs", "peak_ratio", "overturning_time"):
        np.testing.assert_array_equal(getattr(parts, name), getattr(whole, name), err_msg=name)
