"""Compare: measured and predicted -> how well they agree."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from colonnade.arrays import Array
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import NO_ROCKING_RATIO, amplitude
from colonnade.findings import MEASUREMENT, Finding, serious, warning
from colonnade.identification.response.base_motion import FEWEST_CYCLES, Forcing, fit_forcing
from colonnade.identification.response.order import Response, response_order
from colonnade.signals.metrics import nrmse
from colonnade.stages.parts.rank import horizons_and_ranks
from colonnade.store.provenance import Inputs

if TYPE_CHECKING:
    import xarray as xr


class CompareInputs(Inputs):
    """What `compare` reads of the campaign: block, kind, outcome as seen; of a sine its frequency (Hz), amplitude."""

    block: Block
    observed_outcome: str | None
    free_vibration: bool = False
    is_sine: bool = False
    frequency: float | None = None
    amplitude: float | None = None

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> CompareInputs:
        """Gather what `compare` reads for one test."""
        return cls(
            block=campaign.specimens[test.specimen].block(campaign.gravity),
            observed_outcome=test.observed_outcome,
            free_vibration=test.kind == "free-vibration",
            is_sine=test.kind == "sine",
            frequency=test.frequency,
            amplitude=test.amplitude,
        )


def compare(
    rocking: xr.Dataset,
    predicted: Mapping[str, xr.Dataset],
    inputs: CompareInputs,
    ensembles: Mapping[str, xr.Dataset] | None = None,
) -> xr.Dataset:
    """
    Compare measured and predicted in numbers.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`.
    predicted : mapping of str to xr.Dataset
        Results of `predict` by model, on the same clock.
    inputs : CompareInputs
    ensembles : mapping of str to xr.Dataset, optional
        Results of `ensemble` by model.

    Returns
    -------
    compared : xr.Dataset
        On the dimension `model`: `nrmse`, RMS(predicted − measured)/α until either first passes α, `compared_until`
        (s), `predicted_peak_ratio`, `peak_ratio_error` and `predicted_outcome`. NaN if nothing was measured. The
        measured angle counts over the time that is predicted, about its true zero and with its true gain
        (`zero_offset`, `angle_gain`): its `measured_peak_ratio` and `measured_peak_time` (s); of a free vibration the
        largest before that is the `release_ratio`. Of a sine test also what `sine` adds; with ensembles what
        `horizons_and_ranks` adds.
    """
    import xarray as xr

    models = sorted(predicted)
    zero = {"zero_offset": 0.0, "angle_gain": 1.0}
    zero = {name: float(predicted[models[0]][name]) for name in zero} if models else zero
    if "rocking_angle" in rocking:
        true = (rocking["rocking_angle"] - zero["zero_offset"]) / zero["angle_gain"]
        rocking = rocking.assign(rocking_angle=true)
    peak = _find_peak(rocking, predicted, inputs.block, free_vibration=inputs.free_vibration)
    rows = [_row(rocking, predicted[model], inputs.block) for model in models]
    ratios = np.array([float(predicted[model]["peak_ratio"]) for model in models])
    warnings: list[Finding] = []
    measured, observed = rocking.attrs["outcome"], inputs.observed_outcome
    if measured and observed and not _agree(measured, observed):
        text = f"The transducers show {measured}, the test log says {observed}: check the record."
        warnings.append(serious("outcome", text, follows=MEASUREMENT))
    steady = sine(rocking, predicted, inputs.block, inputs.frequency, inputs.amplitude) if inputs.is_sine else Sine()
    return xr.Dataset(
        {
            "nrmse": ("model", np.array([row[0] for row in rows])),
            "compared_until": ("model", np.array([row[1] for row in rows])),
            "predicted_peak_ratio": ("model", ratios),
            "peak_ratio_error": ("model", ratios - peak.ratio),
            "predicted_outcome": (
                "model",
                np.array([predicted[model].attrs["outcome"] for model in models], dtype=object),
            ),
            "measured_peak_ratio": ((), peak.ratio),
            "measured_peak_time": ((), peak.time),
            "release_ratio": ((), peak.release),
            **{name: ((), value) for name, value in zero.items()},
        }
        | steady.variables
        | horizons_and_ranks(rocking, ensembles or {}, models, inputs.block),
        coords={"model": ("model", np.array(models, dtype=object))},
        attrs={
            "outcome_measured": measured or observed or "",
            **steady.attributes,
            "warnings": [*warnings, *steady.warnings],
        },
    )


def _row(rocking: xr.Dataset, predicted: xr.Dataset, block: Block) -> tuple[float, float]:
    """Return the nrmse and the end of the time that it covers."""
    if "rocking_angle" not in rocking:
        return np.nan, np.nan
    time = rocking["elapsed"].to_numpy()
    measured, model = rocking["rocking_angle"].to_numpy(), predicted["rocking_angle"].to_numpy()
    beyond = np.fmax(amplitude(measured, block), amplitude(model, block)) > 1
    until = int(np.argmax(beyond)) if beyond.any() else time.size
    both = np.isfinite(measured[:until]) & np.isfinite(model[:until])
    if not both.any():
        return np.nan, np.nan
    return nrmse(measured[:until][both], model[:until][both], block.critical_angle), float(time[until - 1])


def _agree(measured: str, observed: str) -> bool:
    return measured == observed or (observed == "not-overturned" and measured != "overturned")


SETTLED = 0.1
"""Over p: time before the release over which the held angle is averaged."""


class _Peak(NamedTuple):
    """
    Largest measured |θ|/α.

    Attributes
    ----------
    ratio, time : float
        Over the time that is predicted, and when, s; NaN if it is not known, the ratio also of what overturned.
    release : float
        |θ|/α from which a free vibration was released; NaN of other tests.
    """

    ratio: float = np.nan
    time: float = np.nan
    release: float = np.nan


def _find_peak(
    rocking: xr.Dataset, predicted: Mapping[str, xr.Dataset], block: Block, *, free_vibration: bool
) -> _Peak:
    """
    Find the measured peak.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`, its angle about the true zero.
    predicted : mapping of str to xr.Dataset
        Results of `predict` by model.
    block : Block
    free_vibration : bool
    """
    if "rocking_angle" not in rocking:
        return _Peak()
    if not free_vibration:
        return _Peak(float(rocking["peak_ratio"]), float(rocking["peak_time"]))
    time, angle = rocking["elapsed"].to_numpy(), np.nan_to_num(rocking["rocking_angle"].to_numpy())
    ratio = amplitude(angle, block)
    is_predicted = np.any([np.isfinite(each["rocking_angle"].to_numpy()) for each in predicted.values()], axis=0)
    first = int(np.argmax(is_predicted))
    largest = first + int(np.argmax(ratio[first:]))
    held = angle[:first] * np.sign(angle[first]) < 0.0
    return _Peak(
        np.nan if rocking.attrs["outcome"] == "overturned" else float(ratio[largest]),
        float(time[largest]),
        _release(time[:first][held], ratio[:first][held], block.p, least=0.5 * ratio[largest]),
    )


def _release(time: Array, ratio: Array, p: float, *, least: float) -> float:
    """
    |θ|/α at which a specimen was released, given the samples before its first impact.

    That is at rest, so that the impact comes a quarter period later, acosh(1/(1 − |θ|/α))/p (Housner 1963, eq. 3);
    what is held longer has been at that angle before, what moves already arrives earlier.
    """
    if time.size == 0:
        return np.nan
    later = time[-1] - time
    arriving = np.arccosh(1.0 / (1.0 - np.minimum(ratio, 1.0 - 1e-9))) / p
    waits = np.flatnonzero((later >= arriving) & (ratio > least))
    if not waits.size:
        return float(ratio.max())
    let_go = time[waits[-1]]
    return float(np.median(ratio[(time >= let_go - SETTLED / p) & (time <= let_go)]))


FREQUENCY_TOLERANCE = 0.01
"""Largest departure of the recorded frequency from the given one, as a fraction, that is not reported."""

AMPLITUDE_TOLERANCE = 0.1
"""The same of its amplitude: a table hardly does better."""


@dataclass
class Sine:
    """What a sine test adds to a comparison: variables, attributes and warnings."""

    variables: dict[str, Any] = field(default_factory=dict)
    attributes: dict[str, str] = field(default_factory=dict)
    warnings: list[Finding] = field(default_factory=list)


def sine(
    rocking: xr.Dataset,
    predicted: Mapping[str, xr.Dataset],
    block: Block,
    frequency: float | None,
    amplitude: float | None,
) -> Sine:
    """
    Find frequency and amplitude ratio of a sine test, and the order of the measured and of each predicted response.

    Parameters
    ----------
    rocking : xr.Dataset
        Result of `rocking`.
    predicted : mapping of str to xr.Dataset
        Results of `predict` by model.
    block : Block
    frequency, amplitude : float or None
        As given in the campaign, Hz and m/s².

    Returns
    -------
    sine : Sine
        An order is text: "1" harmonic, "n" sub-harmonic 1/n, "irregular", or empty if unknown; the
        attributes `response_order` and `response_order_reason` are the measured one's.
    """
    forcing = _forcing(rocking)
    if forcing is None:
        reason = (
            f"The table's recorded motion along x has no stretch of {FEWEST_CYCLES} periods of an even amplitude, so "
            "this sine test has no amplitude ratio and no order of response."
        )
        given = {} if frequency is None else {"frequency_ratio": ((), 2 * np.pi * frequency / block.p)}
        return Sine(given, {"response_order": "", "response_order_reason": reason}, [warning("no steady sine", reason)])
    result = Sine(_forcing_variables(forcing, block), warnings=contradictions(rocking, frequency, amplitude))
    measured = _measured(rocking, forcing)
    orders = [_text(_predicted(predicted[model], forcing, block)) for model in sorted(predicted)]
    result.attributes = {"response_order": _text(measured), "response_order_reason": measured.reason}
    result.variables |= {
        "response_misfit": ("order", measured.misfit),
        "impacts_per_cycle": ((), measured.impacts_per_cycle),
        "predicted_response_order": ("model", np.array(orders, dtype=object)),
    }
    return result


def contradictions(rocking: xr.Dataset, frequency: float | None, amplitude: float | None) -> list[Finding]:
    """Say where the table's recorded motion is not the sine that was asked for; see `sine`."""
    forcing, found = _forcing(rocking), []
    if forcing is None:
        return []
    if frequency is not None and abs(forcing.frequency / frequency - 1) > FREQUENCY_TOLERANCE:
        found.append(
            warning(
                "frequency",
                f"The table moved at {forcing.frequency:.4g} Hz; the test's frequency is given as {frequency:g} Hz. "
                "The recorded one is used: correct the test's `frequency`, or the recorder's sampling rate if that is "
                "wrong.",
            )
        )
    if amplitude is not None and abs(forcing.amplitude / amplitude - 1) > AMPLITUDE_TOLERANCE:
        ratio = forcing.amplitude / amplitude
        found.append(
            warning(
                "amplitude",
                f"The table's acceleration has an amplitude of {forcing.amplitude:.3g} ± "
                f"{2 * forcing.amplitude_spread:.1g} m/s², {ratio:.2f} times the test's `amplitude` of "
                f"{amplitude:.3g} m/s². The recorded one is used: the table did not do what was asked for, or the "
                f"accelerometer's gain is wrong; then A is {1 / ratio:.2f} times what is given.",
                follows=("gain", "unit", "AC coupling", "hum", "end of the range", "dead channel"),
            )
        )
    return found


def _forcing(rocking: xr.Dataset) -> Forcing | None:
    return fit_forcing(rocking["elapsed"], rocking["base_acceleration"]) if "base_acceleration" in rocking else None


def _forcing_variables(forcing: Forcing, block: Block) -> dict[str, Any]:
    scalars = {
        "forcing_frequency": forcing.frequency,
        "forcing_amplitude": forcing.amplitude,
        "forcing_amplitude_spread": forcing.amplitude_spread,
        "forcing_distortion": forcing.distortion,
        "steady_start": forcing.start,
        "steady_stop": forcing.stop,
        "frequency_ratio": 2 * np.pi * forcing.frequency / block.p,
        "amplitude_ratio": forcing.amplitude / block.uplift_acceleration,
    }
    return {name: ((), value) for name, value in scalars.items()}


def _measured(rocking: xr.Dataset, forcing: Forcing) -> Response:
    if "rocking_angle" not in rocking:
        return Response(None, "No rocking angle was measured.")
    threshold = float(rocking["noise_threshold"])
    # The standard error of the angle also holds the transducers' drift, which is not noise: the excess stays small.
    noise = min(float(np.nanmedian(rocking["rocking_angle_standard_error"])), threshold / 2)
    return _response(rocking, forcing, threshold, noise)


def _predicted(predicted: xr.Dataset, forcing: Forcing, block: Block) -> Response:
    return _response(predicted, forcing, NO_ROCKING_RATIO * block.critical_angle, 0.0)


def _response(motion: xr.Dataset, forcing: Forcing, threshold: float, noise: float) -> Response:
    if motion.attrs["outcome"] == "overturned":
        return Response(None, "The specimen overturned.")
    if motion.attrs["outcome"] == "no-rocking":
        return Response(None, "The specimen did not rock.")
    return response_order(
        motion["elapsed"],
        motion["rocking_angle"],
        forcing.frequency,
        start=forcing.start,
        stop=forcing.stop,
        threshold=threshold,
        noise=noise,
    )


def _text(response: Response) -> str:
    return "" if response.order is None else str(response.order)
