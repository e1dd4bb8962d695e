"""Which components of a pose a set-up of transducers can separate."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from colonnade.arrays import Array
from colonnade.dynamics.block import Block
from colonnade.dynamics.kinematics import Outline, Pose
from colonnade.identification.fusion.sensors import UNKNOWNS, Transducer, predict

LARGEST_AMPLIFICATION = 10.0
"""An unknown is fitted if, together with the others, no standard error grows by more than this factor."""

SIGHT = 0.1
"""Share of a motion, of a rotation times the pole distance, that a transducer has to read in order to see it."""

_ROTATIONS = ("rocking_angle", "out_of_plane_angle", "yaw")
_WORDS = {name: name.replace("_", " ").replace("out of plane", "out-of-plane") for name in UNKNOWNS}
_WORDS["rocking_angle"] = "angle"


class UnseenRotationError(ValueError):
    """The transducers on a specimen do not see its rotation; the message says what would."""


@dataclass(frozen=True)
class Separation:
    """
    What is fitted.

    Attributes
    ----------
    unknowns : tuple of str
        Of `UNKNOWNS`, in that order; the rocking angle always.
    designs : ndarray, shape (2, m, k)
        Derivatives of the readings by the unknowns at rest, about the pole of θ < 0 and of θ > 0.
    text : str
        What is separated and what is not, for the report.
    """

    unknowns: tuple[str, ...]
    designs: Array
    text: str


def separate(transducers: list[Transducer], sigma: Array, block: Block, outline: Outline) -> Separation:
    """
    Decide which unknowns of a pose are fitted.

    Parameters
    ----------
    transducers : list of Transducer, length m
    sigma : ndarray, shape (m,)
        Standard deviations of the readings, m or rad.
    block : Block
    outline : Outline

    Returns
    -------
    separation : Separation

    Raises
    ------
    UnseenRotationError
        A ValueError, if no transducer measures the rotation about both poles.

    Notes
    -----
    Unknowns are taken one after the other, each where it is seen and the design about either pole keeps all of them
    apart; what is left out counts as zero. Uplift of the pole takes two transducers that look along z: a single one
    with others is a check of the angle rather than a measurement of bounce.
    """
    designs = design_at_rest(transducers, block, outline)
    sizes = np.array([block.pole_distance if name in _ROTATIONS else 1.0 for name in UNKNOWNS])
    seen_by = (np.abs(designs) > SIGHT * sizes).any(axis=0).sum(axis=0)
    _refuse_unseen(designs[:, :, 0])
    fitted, mixed = [0], []
    for index in range(1, len(UNKNOWNS)):
        if seen_by[index] == 0:
            continue
        enough = seen_by[index] > 1 or UNKNOWNS[index] != "uplift"
        if enough and is_separated(designs[:, :, [*fitted, index]], sigma):
            fitted.append(index)
        else:
            mixed.append(index)
    unseen = [index for index in range(1, len(UNKNOWNS)) if seen_by[index] == 0]
    names = tuple(UNKNOWNS[index] for index in fitted)
    return Separation(names, designs[:, :, fitted], _text(names, mixed, unseen, transducers))


def design_at_rest(transducers: list[Transducer], block: Block, outline: Outline) -> Array:
    """Derivatives of readings at rest by all unknowns, about the pole of θ < 0 and of θ > 0, shape (2, m, 6)."""
    rest = Pose(*np.zeros((len(UNKNOWNS), 1)))
    return np.array([predict(transducers, rest, side, block, outline)[1][..., 0] for side in (-1.0, 1.0)])


def is_separated(designs: Array, sigma: Array) -> bool:
    """Whether columns (2, m, k) are independent enough about either pole; sigma is infinite of a missing reading."""
    for design in designs / sigma[:, None]:
        lengths = np.sqrt((design**2).sum(axis=0))
        if not lengths.all():
            return False
        scaled = design / lengths
        correlation = scaled.T @ scaled
        if np.linalg.eigvalsh(correlation)[0] < 1e-9:
            return False
        if np.sqrt(np.linalg.inv(correlation).diagonal().max()) >= LARGEST_AMPLIFICATION:
            return False
    return True


def _refuse_unseen(rotation: Array) -> None:
    seen = np.asarray((np.abs(rotation) > 0).any(axis=1))
    if not seen.any():
        raise UnseenRotationError(
            "No transducer measures the rotation: each is at the height of the base, or points across the plane. Add "
            "a displacement transducer above the base, with a direction along x"
        )
    if not seen.all():
        blind = "θ < 0" if not seen[0] else "θ > 0"
        raise UnseenRotationError(
            f"No transducer measures the rotation at {blind}: each is on the edge that the specimen then rocks about. "
            "Add a vertical one on the other edge, or one above the base along x"
        )


def _text(names: tuple[str, ...], mixed: list[int], unseen: list[int], transducers: list[Transducer]) -> str:
    words = [_WORDS[name] for name in names]
    fitted = f"{words[0]} only" if len(words) == 1 else _listed(words)
    kind = "transducer" if any(each.sensing == "angle" for each in transducers) else "displacement transducer"
    count = f"one {kind}" if len(transducers) == 1 else f"{len(transducers)} {kind}s"
    notes = [f"{fitted}, from {count}"]
    if mixed:
        it, verb = "it" if len(names) == 1 else "these", "is" if len(mixed) == 1 else "are"
        unseparated = _listed([_WORDS[UNKNOWNS[index]] for index in mixed])
        notes.append(f"{unseparated} cannot be separated from {it} and {verb} taken as zero")
    if unseen:
        notes.append(f"no transducer measures {_listed([_WORDS[UNKNOWNS[index]] for index in unseen], 'or')}")
    return "; ".join(notes)


def _listed(words: list[str], last: str = "and") -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} {last} {words[-1]}"
