"""Compare: measured and predicted -> how well they agree."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from colonnade.arrays import Array, Dataset, dataset
from colonnade.campaign import Campaign, Test
from colonnade.dynamics.block import Block
from colonnade.dynamics.history import NO_ROCKING_RATIO, amplitude
from colonnade.findings import MEASUREMENT, Finding, serious, warning
from colonnade.identification.response.base_motion import FEWEST_CYCLES, Forcing, fit_forcing
from colonnade.identification.response.order import Response, response_order
from colonnade.signals.metrics import nrmse
from colonnade.store.provenance import Inputs


class CompareInputs(Inputs):
    """What `compare` reads of the campaign: block, kind, outcome as seen; of a sine its frequency (Hz), amplitude."""

    block: Block
    observed_outcome: str | None
    kind: str
    frequency: float | None = None
    amplitude: float | None = None

    @classmethod
    def of(cls, campaign: Campaign, test: Test) -> CompareInputs:
        """Gather what `compare` reads for one test."""
        return cls(
            block=campaign.block(test.specimen),
            observed_outcome=test.observed_outcome,
            kind=test.kind,
            frequency=test.frequency,
            amplitude=test.amplitude,
        )


def compare(
    rocking: Dataset,
    predicted: Mapping[str, Dataset],
    inputs: CompareInputs,
    ensembles: Mapping[str, Dataset] | None = None,
) -> Dataset:
    """
    Compare measured and predicted in numbers.

    Parameters
    ----------
    rocking : Dataset
        Result of `rocking`.
    predicted : mapping of str to Dataset
        Results of `predict` by model, on the same clock.
    inputs : CompareInputs
    ensembles : mapping of str to Dataset, optional
        Results of `ensemble` by model.

    Returns
    -------
    compared : Dataset
        On the dimension `model`: `nrmse`, RMS(predicted − measured)/α until either first passes α, `compared_until`
        (s) and `peak_ratio_error`. NaN if nothing was measured. The measured angle counts over the time that is
        predicted, about its true zero and with its true gain (`zero_offset`, `angle_gain`): its `measured_peak_ratio`
        and `measured_peak_time` (s); of a free vibration the largest before that is the `release_ratio`. Of a sine test
        also what `_with_sine` adds; with ensembles `RANKED`.
    """
    models, block = sorted(predicted), inputs.block
    zero = {name: float(predicted[models[0]][name]) if models else usual for name, usual in ZERO.items()}
    if "rocking_angle" in rocking:
        true = (rocking["rocking_angle"] - zero["zero_offset"]) / zero["angle_gain"]
        rocking = rocking.assign(rocking_angle=true)
    peak, peak_time, release = _peak(rocking, predicted, inputs)
    misfits, untils = np.reshape([_misfit(rocking, predicted[model], block) for model in models], (-1, 2)).T
    warnings: list[Finding] = []
    measured, observed = rocking.attrs["outcome"], inputs.observed_outcome
    if measured and observed not in (None, measured) and (observed != "not-overturned" or measured == "overturned"):
        text = f"The transducers show {measured}, the test log says {observed}: check the record."
        warnings.append(serious("outcome", text, follows=MEASUREMENT))
    compared = dataset(
        {
            "nrmse": ("model", misfits),
            "compared_until": ("model", untils),
            "peak_ratio_error": ("model", [float(predicted[model]["peak_ratio"]) - peak for model in models]),
            "measured_peak_ratio": peak,
            "measured_peak_time": peak_time,
            "release_ratio": release,
            **zero,
        },
        coords={"model": ("model", np.array(models, dtype=object))},
        attrs={"warnings": warnings},
    )
    for name in RANKED if ensembles else ():
        known = {model: float(each[name]) for model, each in (ensembles or {}).items() if name in each}
        compared[name] = "model", [known.get(model, np.nan) for model in models]
    return _with_sine(compared, rocking, predicted, inputs) if inputs.kind == "sine" else compared


RANKED = ("horizon", "within_spread", "peak_rank", "overturning_probability")
"""What the ensemble of each model says of it."""

ZERO = {"zero_offset": 0.0, "angle_gain": 1.0}
"""Of the measured angle, where no prediction says another."""


def _misfit(rocking: Dataset, predicted: Dataset, block: Block) -> tuple[float, float]:
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


SETTLED = 0.1
"""Over p: time before the release over which the held angle is averaged."""


def _peak(rocking: Dataset, predicted: Mapping[str, Dataset], inputs: CompareInputs) -> tuple[float, float, float]:
    """
    Find the largest measured |θ|/α over the time that is predicted, when it is (s), and where a free vibration began.

    NaN of what is not known, the ratio also of what overturned; the last, |θ|/α of the release, of other tests.
    """
    if "rocking_angle" not in rocking:
        return np.nan, np.nan, np.nan
    if inputs.kind != "free-vibration":
        return float(rocking["peak_ratio"]), float(rocking["peak_time"]), np.nan
    time, angle = rocking["elapsed"].to_numpy(), np.nan_to_num(rocking["rocking_angle"].to_numpy())
    ratio = amplitude(angle, inputs.block)
    is_predicted = np.any([np.isfinite(each["rocking_angle"].to_numpy()) for each in predicted.values()], axis=0)
    first = int(np.argmax(is_predicted))
    largest = first + int(np.argmax(ratio[first:]))
    held = angle[:first] * np.sign(angle[first]) < 0.0
    release = _release(time[:first][held], ratio[:first][held], inputs.block.p, least=0.5 * ratio[largest])
    fell = rocking.attrs["outcome"] == "overturned"
    return np.nan if fell else float(ratio[largest]), float(time[largest]), release


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


TOLERANCES = {"frequency": 0.01, "amplitude": 0.1}
"""Largest departures of the recorded motion from what was asked for, as fractions, that are not reported."""


def _with_sine(compared: Dataset, rocking: Dataset, predicted: Mapping[str, Dataset], inputs: CompareInputs) -> Dataset:
    """
    Add frequency and amplitude ratio of a sine test, and the order of the measured and of each predicted response.

    An order is text: "1" harmonic, "n" sub-harmonic 1/n, "irregular", or empty if unknown; the attributes
    `response_order` and `response_order_reason` are the measured one's.
    """
    block, warnings = inputs.block, compared.attrs["warnings"]
    forcing = forcing_of(rocking)
    if forcing is None:
        reason = (
            f"The table's recorded motion along x has no stretch of {FEWEST_CYCLES} periods of an even amplitude, so "
            "this sine test has no amplitude ratio and no order of response."
        )
        given = {} if inputs.frequency is None else {"frequency_ratio": 2 * np.pi * inputs.frequency / block.p}
        warnings = [*warnings, warning("no steady sine", reason)]
        return compared.assign(given).assign_attrs(response_order="", response_order_reason=reason, warnings=warnings)
    measured = _measured(rocking, forcing)
    least = NO_ROCKING_RATIO * block.critical_angle
    orders = [str(_response(predicted[model], forcing, least, 0.0).order or "") for model in sorted(predicted)]
    return compared.assign(
        {
            "forcing_frequency": forcing.frequency,
            "forcing_amplitude": forcing.amplitude,
            "forcing_distortion": forcing.distortion,
            "steady_start": forcing.start,
            "steady_stop": forcing.stop,
            "frequency_ratio": 2 * np.pi * forcing.frequency / block.p,
            "amplitude_ratio": forcing.amplitude / block.uplift_acceleration,
            "impacts_per_cycle": measured.impacts_per_cycle,
            "predicted_response_order": ("model", np.array(orders, dtype=object)),
        }
    ).assign_attrs(
        response_order=str(measured.order or ""),
        response_order_reason=measured.reason,
        warnings=warnings + contradictions(forcing, inputs.frequency, inputs.amplitude),
    )


def forcing_of(rocking: Dataset) -> Forcing | None:
    """Return the steady sine of the table's recorded motion; None if there is none."""
    return fit_forcing(rocking["elapsed"], rocking["base_acceleration"]) if "base_acceleration" in rocking else None


def contradictions(forcing: Forcing | None, frequency: float | None, amplitude: float | None) -> list[Finding]:
    """Say where the table's recorded motion is not the sine that was asked for, in Hz and m/s²."""
    found: list[Finding] = []
    if forcing is None:
        return found
    for kind, recorded, asked, unit in (
        ("frequency", forcing.frequency, frequency, "Hz"),
        ("amplitude", forcing.amplitude, amplitude, "m/s²"),
    ):
        if asked is not None and abs(recorded / asked - 1) > TOLERANCES[kind]:
            text = (
                f"The table moved with {recorded:.4g} {unit}, {recorded / asked:.2f} times the test's `{kind}` of "
                f"{asked:.4g} {unit}. The recorded one is used: correct the entry if the table did something else, or "
                "the recorder's sampling rate or the accelerometer's gain if that is wrong."
            )
            others = ("gain", "unit", "end of the range", "dead channel")
            found.append(warning(kind, text, follows=others if kind == "amplitude" else ()))
    return found


def _measured(rocking: Dataset, forcing: Forcing) -> Response:
    if "rocking_angle" not in rocking:
        return Response(None, "No rocking angle was measured.")
    threshold = float(rocking["noise_threshold"])
    # The standard error of the angle also holds the transducers' drift, which is not noise: the excess stays small.
    noise = min(float(np.nanmedian(rocking["rocking_angle_standard_error"])), threshold / 2)
    return _response(rocking, forcing, threshold, noise)


NO_RESPONSE = {"overturned": "The specimen overturned.", "no-rocking": "The specimen did not rock."}


def _response(motion: Dataset, forcing: Forcing, threshold: float, noise: float) -> Response:
    if motion.attrs["outcome"] in NO_RESPONSE:
        return Response(None, NO_RESPONSE[motion.attrs["outcome"]])
    time, angle, steady = motion["elapsed"], motion["rocking_angle"], {"start": forcing.start, "stop": forcing.stop}
    return response_order(time, angle, forcing.frequency, threshold=threshold, noise=noise, **steady)
