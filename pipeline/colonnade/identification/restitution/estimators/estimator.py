"""The base of an estimator of e: its name, its assumptions, and a fit to a free vibration."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from math import exp
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

from colonnade.identification.restitution.fitting.mixture import Mean
from colonnade.identification.restitution.result import Estimate, FittedHistory

if TYPE_CHECKING:
    from colonnade.identification.restitution.free_vibration import FreeVibration


@dataclass(frozen=True)
class Fit:
    """
    The result of an estimator; each estimator may add to it.

    Attributes
    ----------
    estimate : Estimate
    fitted : FittedHistory or None
        The history fitted to the record, if the estimator fits one.
    """

    estimate: Estimate
    fitted: FittedHistory | None = None

    @property
    def objection(self) -> str:
        """Why the value cannot be used by itself; empty if it can."""
        return self.estimate.reason

    @property
    def zero_offset(self) -> float:
        """Angle at which the block is upright by this fit, rad; 0 if it does not identify one."""
        return 0.0


FitT_co = TypeVar("FitT_co", bound=Fit, covariant=True)


class Estimator(ABC, Generic[FitT_co]):
    """
    One way to identify e. A new one is a subclass in a module of its own, and an entry in `registry.ESTIMATORS`.

    Attributes
    ----------
    name : str
        Its name in stored results.
    label : str
        Its name in figures and tables.
    assumptions : str
        What has to be true for the value to be right.
    description : str
        How it works, for the report's page of methods.
    references : tuple of str
        Keys of the report's references for it.
    method : str
        How the value was found, for an estimator that may be recommended.
    priority : int
        Place among those that may be recommended, from 1 on (`choice.choose`); 0 for one that is only reported.
    follows_table : bool
        Whether it is valid on a moving table.
    result : type of Fit
        What `fit` returns; a refusal makes it from an `Estimate` alone.
    """

    name: ClassVar[str]
    label: ClassVar[str]
    assumptions: ClassVar[str]
    description: ClassVar[str]
    references: ClassVar[tuple[str, ...]] = ()
    method: ClassVar[str] = ""
    priority: ClassVar[int] = 0
    follows_table: ClassVar[bool] = False
    result: ClassVar[type[Any]] = Fit

    @abstractmethod
    def fit(self, record: FreeVibration) -> FitT_co:
        """Fit a record; `estimate` of the result has the value, or the reason why it is missing."""

    def refuse(self, level: float, reason: str) -> FitT_co:
        """Return a fit without a value, for this reason."""
        refused: FitT_co = self.result(Estimate(self.name, None, None, None, None, level, self.assumptions, reason))
        return refused

    def estimate_of(self, mean: Mean, level: float, *, residual: float | None = None, freed: str = "") -> Estimate:
        """
        Return the estimate for a mean of ln e.

        Parameters
        ----------
        mean : Mean
            Of ln e, with its interval at `level`.
        level : float
        residual : float, optional
            RMS of measured − fitted, rad.
        freed : str, optional
            What else was identified or assumed, for the assumptions.
        """
        low, value, high = exp(mean.low), exp(mean.value), exp(mean.high)
        assumptions = self.assumptions + (f"; {freed}" if freed else "")
        error = value * mean.standard_error
        return Estimate(self.name, value, low, high, error, level, assumptions, residual=residual)
