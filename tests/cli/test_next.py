"""`colonnade next`: a table for people, JSON for programs."""

from __future__ import annotations

import json


def test_without_results_it_says_what_to_do(colonnade, campaign):
    told = colonnade("next")
    assert told.returncode == 1
    assert "Run `colonnade run` first" in told.stderr


def test_what_was_run_gives_advice(colonnade, campaign):
    assert colonnade("run", "--until", "restitution", "--workers", "1").returncode == 0
    (advice,) = json.loads(colonnade("next", "--json").stdout)["advice"]
    assert {"specimen", "kind", "test", "reason", "risk", "left", "demand", "beyond"} <= advice.keys()
    assert advice["kind"] == "free-vibration"
    told = colonnade("next")
    assert told.returncode == 0
    assert told.stdout.startswith(f"Do this next: free-vibration of prism: {advice['test']}")
    assert f"Because {advice['reason']}." in told.stdout
