"""Modes that a run keeps: the low ones, as many as its step follows with its law."""

from __future__ import annotations

import numpy as np
import pytest

from colonnade.dynamics.contact.elastic.assembly import assemble
from colonnade.dynamics.contact.elastic.mesh import prism_mesh
from colonnade.dynamics.contact.elastic.reduction import reduce_body, rigid_on_nodes
from colonnade.dynamics.contact.law import ContactLaw
from colonnade.dynamics.contact.modes import FOLLOWED, keep_modes, keep_modes_for_step
from colonnade.dynamics.contact.simulate import simulate
from colonnade.dynamics.contact.stability import longest_step

PRISM = assemble(prism_mesh(0.086, 0.086, 0.456, (2, 2, 6)), 26.10)


def test_dropping_modes_keeps_the_low_ones_and_ends_at_the_rigid_body() -> None:
    reduced = reduce_body(PRISM)
    limit = 2 / 1e-5
    low = keep_modes(reduced, limit)
    assert 0 < low.frequencies.size < reduced.frequencies.size
    assert low.frequencies.max() <= limit
    assert low.modes == pytest.approx(reduced.modes[:, :, : low.frequencies.size])
    assert keep_modes(reduced, np.inf) is reduced
    rigid = keep_modes(reduced, 1.0)
    assert rigid.frequencies.size == 0
    assert rigid.nodes == pytest.approx(rigid_on_nodes(PRISM).nodes)


def test_a_step_of_ten_microseconds_keeps_modes_that_the_engine_advances_with_closed_energy() -> None:
    reduced = reduce_body(PRISM)
    law = ContactLaw.stiff(reduced, 9.81, penetration=1e-6)
    kept = keep_modes_for_step(reduced, law, 1e-5)
    count = kept.frequencies.size
    assert count >= 4
    assert longest_step(kept, law) >= 1e-5 / FOLLOWED
    assert longest_step(keep_modes(reduced, reduced.frequencies[count + 1]), law) < 1e-5 / FOLLOWED
    history = simulate(kept, law=law, theta0=0.05, duration=0.3, step=1e-5)
    assert history.impact_times.size == 1
    assert history.energies.closes


def test_a_step_that_not_even_the_rigid_body_allows_is_refused() -> None:
    reduced = reduce_body(PRISM, vibration_modes=6, attachment=False)
    with pytest.raises(ValueError, match="even the rigid body on this contact needs one of at most"):
        keep_modes_for_step(reduced, ContactLaw.stiff(reduced, 9.81), 1e-2)
