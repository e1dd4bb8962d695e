"""The faults of the atlas, by page."""

from __future__ import annotations

from faults.clocks import CLOCKS
from faults.course import COURSE
from faults.fault import Fault
from faults.samples import SAMPLES
from faults.scales import SCALES

GROUPS = (SCALES, CLOCKS, SAMPLES, COURSE)

FAULTS: dict[str, Fault] = {fault.slug: fault for group in GROUPS for fault in group.faults}
