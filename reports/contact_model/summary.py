"""What the document on the contact model tells of the study, in a few lines."""

from __future__ import annotations

from typing import Any

from contact_model.convergence import COLLAPSING, scatter, step_errors
from contact_model.drawings import named
from contact_model.free import MESHES, TARGET
from contact_model.misfit_words import verdict


def summary(found: dict[str, Any]) -> str:
    """Write the measured part of `docs/explanation/contact.md`."""
    lines = [
        f"The paper's prism, free rocking from α/2. With a step of 10 µs it has e = {TARGET} with:",
        "",
        "| body | stiffness (10: default) | ξ | ξ_eff | e | seconds for 10 s of motion |",
        "|---|---|---|---|---|---|",
    ]
    for cell in found["table"]:
        if cell["step"] == 1e-5 and cell["damping_fraction"] is not None:
            lines.append(
                f"| {named(cell['body'])} | {cell['multiple']:g} | {cell['damping_fraction']:.2f} "
                f"| {cell['effective_damping']:.2f} | {cell['restitution']:.4f} | {cell['cost']:.1f} |"
            )
    released = [(run["release"], run["restitution"]) for run in found["amplitudes"]]
    everything, meshes = (
        max(row["highest"] - row["lowest"] for row in scatter(found["collapse"], chosen))
        for chosen in (COLLAPSING, MESHES)
    )
    orders = ", ".join(
        f"{named(series['body'])} {series['orders']['peaks']:.1f}" for series in step_errors(found["steps"])
    )
    large = max(run["release"] for run in found["misfit"])
    lines += [
        "",
        f"- e over the amplitude, of the calibrated rigid prism: {released[0][1]:.4f} from {released[0][0]:g} α, "
        f"{released[-1][1]:.4f} from {released[-1][0]:g} α.",
        f"- e at equal ξ_eff scatters by up to {everything:.3f} over all bodies, {meshes:.3f} over the meshes.",
        f"- Peaks converge with the step with the observed orders: {orders}.",
        "",
        "What can turn rocking three-dimensional, as the paper says of its large first amplitudes:",
        "",
        *verdict(found["misfit"], large),
    ]
    return "\n".join(lines)
