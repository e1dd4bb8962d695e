"""The run behind a watch: it does what a run does, gives way, and is tried again if it was refused."""

from __future__ import annotations

import time
from typing import Any

from colonnade.workflow.execution.lock import only_run
from colonnade.workflow.watching.behind import Behind, Ended


def ended(behind: Behind) -> Ended:
    until = time.monotonic() + 120
    while (found := behind.ended()) is None:
        assert time.monotonic() < until
        time.sleep(0.05)
    return found


def test_it_gives_way_and_then_says_what_failed_and_when_it_was_refused(small: Any) -> None:
    small.raw("pulse-02").write_text("nothing\n")
    behind = Behind(small.folder / "campaign.toml", None, 1)
    behind.start()
    assert behind.is_running
    behind.give_way()
    assert not behind.is_running
    assert behind.ended() is None
    behind.start()
    found = ended(behind)
    assert (found.code, found.was_refused) == (1, False)
    assert [failure.partition(":")[0] for failure in found.failures] == ["pulse-02"]
    with only_run(small.layout):
        behind.start()
        assert ended(behind).was_refused
