"""What a criterion predicts against what is computed, as a 2 × 2 table."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from colonnade.validation import samples


@dataclass(frozen=True)
class Agreement:
    """
    Numbers of motions.

    Attributes
    ----------
    hits, false_alarms, misses, rejections : int
        Predicted and happened; predicted and did not; not predicted and happened; neither.
    unknown : int
        Without a prediction, because a demand is not known.
    """

    hits: int
    false_alarms: int
    misses: int
    rejections: int
    unknown: int

    @property
    def fails(self) -> Literal["never", "to the safe side", "to the unsafe side", "to both sides"]:
        """Direction of its failures: it predicts what does not happen (safe), or the other way round."""
        if not self.false_alarms and not self.misses:
            return "never"
        if not self.misses:
            return "to the safe side"
        return "to both sides" if self.false_alarms else "to the unsafe side"


def agreement(ratio: ArrayLike, happened: ArrayLike) -> Agreement:
    """
    Count agreement and failures of a criterion.

    Parameters
    ----------
    ratio : array_like, shape (n,)
        Demand over capacity of each motion (`Criterion.ratio`); NaN if not known.
    happened : array_like of bool, shape (n,)
        Whether the block rocked or overturned, whichever the criterion predicts.

    Returns
    -------
    agreement : Agreement

    Raises
    ------
    ValueError
        If the shapes differ.

    Examples
    --------
    >>> agreement([0.5, 2.0, 3.0], [False, False, True])
    Agreement(hits=1, false_alarms=1, misses=0, rejections=1, unknown=0)
    """
    demand = samples("ratio", ratio, gaps=True, finite=False)
    mask = np.asarray(happened)
    if mask.dtype.kind != "b" or mask.shape != demand.shape:
        raise ValueError(
            f"happened has shape {mask.shape}, {mask.dtype}; truth values of shape {demand.shape} were expected"
        )
    known = ~np.isnan(demand)
    predicted = demand > 1.0
    return Agreement(
        hits=int((predicted & mask).sum()),
        false_alarms=int((predicted & ~mask).sum()),
        misses=int((known & ~predicted & mask).sum()),
        rejections=int((known & ~predicted & ~mask).sum()),
        unknown=int((~known).sum()),
    )
