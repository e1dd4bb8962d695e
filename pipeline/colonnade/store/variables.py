"""
The one table of variables: units, names and CF attributes of everything that colonnade stores.

A stage returns values; `store.description` says by this table what they are.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

MEASURED = "physicalMeasurement"
MODELLED = "modelResult"
AUXILIARY = "auxiliaryInformation"
QUALITY = "qualityInformation"
COORDINATE = "coordinate"


@dataclass(frozen=True)
class Variable:
    """
    How one variable is stored and described.

    Attributes
    ----------
    long_name : str
        In words.
    units : str or None
        UDUNITS spelling; "1" for a number, None for text and flags.
    content : str
        ACDD coverage_content_type.
    standard_name : str or None
        Where CF has one; rocking has almost none.
    dtype : str
        numpy's name; "str" for text.
    comment : str or None
        Sign, frame or definition, where the name does not say it.
    """

    long_name: str
    units: str | None = "1"
    content: str = AUXILIARY
    standard_name: str | None = None
    dtype: str = "float64"
    comment: str | None = None

    def attributes(self) -> dict[str, Any]:
        """CF and ACDD attributes, those that are not given left out."""
        given = {
            "long_name": self.long_name,
            "standard_name": self.standard_name,
            "units": self.units,
            "coverage_content_type": self.content,
            "comment": self.comment,
        }
        return {name: value for name, value in given.items() if value is not None}


_SIGN = "Rotation about +y: positive when the top moves to +x."
_ABOUT_X = "Rotation about +x: positive when the top moves to -y."
_ABOUT_Z = "Rotation about +z, right-handed."
_OUTLINE = "Of the side with the smaller critical angle."
_WIDE = "Of the intervals that are at least as wide as the attribute `width`; missing if there is none."
_RANK = "By their largest distances up to the horizon. Up to 0.95 the measured angle is within the model's own spread."
_HORIZON = "First time at which the 95 % band of its runs is wider than the setting `horizon`, else the record's end."
_DISTANCE = "Up to the horizon; 1 is the edge of the 95 % band of all others."
_FEW_ARCS = (
    "If too few arcs are above the lowest amplitude to identify it, the mean velocity ratio of the impacts: see the "
    "attribute contact_restitution_source."
)
_CASES = "0 no rocking, 1 rocking, 2 overturned, -1 not run, -2 its base falls faster than the column."
_MEASURED = "In the unit of the measure, see the attribute measure_asked."
_ORDERS = "k: it repeats every k cycles of the base; 0 at rest, -1 irregular, -2 overturned."

VARIABLES: dict[str, Variable] = {
    # clocks
    "elapsed": Variable("time since the recorder's zero", "s", COORDINATE),
    "time": Variable("instant of the recorder's zero", "seconds since 1970-01-01T00:00:00Z", COORDINATE, "time"),
    # forecasts
    "basis": Variable("base motion and e of a forecast", None, COORDINATE, dtype="str"),
    "observed_amplitude": Variable("min(max |θ|, α)/α, 0 if it did not rock", "1", MEASURED),
    "forecast_overturning_probability": Variable("forecast probability of overturning", "1", MODELLED),
    "forecast_crps": Variable("continuous ranked probability score of the amplitude, over α", "1", QUALITY),
    "forecast_ranked_probability": Variable("ranked probability score of the outcome", "1", QUALITY),
    "forecast_brier": Variable("Brier score of overturning", "1", QUALITY),
    "forecast_logarithmic": Variable("logarithmic score of overturning, nats", "1", QUALITY),
    "forecast_pit": Variable("probability integral transform of the amplitude", "1", QUALITY),
    # rocking, predicted
    "rocking_angle": Variable("rocking angle", "rad", MEASURED, comment=_SIGN),
    "rocking_angle_quality": Variable("quality of the rocking angle", None, QUALITY, "quality_flag", "int8"),
    "rocking_angle_standard_error": Variable("standard error of the rocking angle", "rad", QUALITY),
    "rocking_angle_drift": Variable("drift of the rocking angle between the rests before and after", "rad", QUALITY),
    "slide": Variable("displacement of the active pole along x, relative to the table", "m", MEASURED),
    "slide_standard_error": Variable("standard error of the slide", "m", QUALITY),
    "uplift": Variable("height of the lowest point of the base above the table", "m", MEASURED),
    "uplift_standard_error": Variable("standard error of the uplift", "m", QUALITY),
    "out_of_plane_angle": Variable("rotation out of the plane of rocking", "rad", MEASURED, comment=_ABOUT_X),
    "out_of_plane_angle_standard_error": Variable("standard error of the out-of-plane angle", "rad", QUALITY),
    "transverse_slide": Variable("displacement of the base's centre along y, relative to the table", "m", MEASURED),
    "transverse_slide_standard_error": Variable("standard error of the transverse slide", "m", QUALITY),
    "yaw": Variable("rotation about the vertical", "rad", MEASURED, comment=_ABOUT_Z),
    "yaw_standard_error": Variable("standard error of the yaw", "rad", QUALITY),
    "angle_deviation": Variable(
        "standard error of the rocking angle at each time", "rad", QUALITY, comment="Where the angle is integrated."
    ),
    "transducer": Variable("transducer on the specimen", None, COORDINATE, dtype="str"),
    "residual_to_noise": Variable("root mean square of reading minus fitted reading, over the noise", "1", QUALITY),
    "residual_to_reading": Variable("root mean square of reading minus fitted reading, over the reading", "1", QUALITY),
    "base_acceleration": Variable("acceleration of the base along x", "m s-2", MEASURED),
    "transverse_base_acceleration": Variable("acceleration of the base along y", "m s-2", MEASURED),
    "vertical_base_acceleration": Variable("acceleration of the base along z", "m s-2", MEASURED),
    "base_displacement": Variable("displacement of the base along x", "m", MEASURED),
    "transverse_base_displacement": Variable("displacement of the base along y", "m", MEASURED),
    "vertical_base_displacement": Variable("displacement of the base along z", "m", MEASURED),
    "impact_time": Variable("time of each impact", "s", MEASURED),
    "impact_count": Variable("number of impacts followed by a peak above the threshold", "1", MEASURED, dtype="int32"),
    "peak_angle": Variable("peak rocking angle", "rad", MEASURED, comment=_SIGN),
    "peak_ratio": Variable("largest magnitude of the rocking angle over the critical angle", "1", MEASURED),
    "peak_time": Variable("time of the peak", "s", MEASURED),
    "peak_ground_acceleration": Variable("largest magnitude of the base acceleration", "m s-2", MEASURED),
    "overturning_time": Variable("time at which the critical angle is passed without return", "s", MEASURED),
    "noise_threshold": Variable("noise threshold of the rocking angle", "rad", QUALITY),
    # restitution, specimens
    "peak_angle_standard_error": Variable("standard error of the peak angle", "rad", QUALITY),
    "fitted_angle": Variable("peak angle by the fit", "rad", MODELLED, comment=_SIGN),
    "peak_used": Variable("whether the peak entered the fit", None, QUALITY, dtype="int8"),
    "restitution": Variable("coefficient of restitution", comment="Angular velocity after an impact to before."),
    "restitution_low": Variable("lower end of the interval of the coefficient of restitution"),
    "restitution_high": Variable("upper end of the interval of the coefficient of restitution"),
    "restitution_standard_error": Variable("standard error of the coefficient of restitution"),
    "restitution_history": Variable("coefficient of restitution from the whole history, by model"),
    "restitution_history_low": Variable("lower end of its interval, from the whole history"),
    "restitution_history_high": Variable("upper end of its interval, from the whole history"),
    "restitution_history_standard_error": Variable("standard error of the one from the whole history"),
    "restitution_history_residual": Variable("root mean square of measured minus simulated angle", "rad", QUALITY),
    "estimator": Variable("estimator of the coefficient of restitution", None, COORDINATE, dtype="str"),
    "estimate": Variable("coefficient of restitution by each estimator"),
    "estimate_low": Variable("lower end of its interval, by each estimator"),
    "estimate_high": Variable("upper end of its interval, by each estimator"),
    "estimate_standard_error": Variable("standard error of the coefficient of restitution by each estimator"),
    "impact_time_standard_error": Variable("standard error of the time of each impact", "s", QUALITY),
    "impact_velocity": Variable("magnitude of the angular velocity before each impact", "rad s-1", MEASURED),
    "impact_restitution": Variable("coefficient of restitution of each impact"),
    "impact_restitution_standard_error": Variable("standard error of the one of each impact"),
    "impact_used": Variable("whether the impact entered the estimate", None, QUALITY, dtype="int8"),
    "restitution_slope": Variable("change of the restitution with the angular velocity before the impact", "s rad-1"),
    "restitution_slope_standard_error": Variable("standard error of that change", "s rad-1", QUALITY),
    "fitted_elapsed": Variable("time since the recorder's zero, fitted part", "s", COORDINATE),
    "fitted_history": Variable("rocking angle of the fitted history", "rad", MODELLED, comment=_SIGN),
    "history_residual": Variable("measured minus fitted rocking angle", "rad", QUALITY, comment=_SIGN),
    "region_restitution": Variable("coefficient of restitution, the critical angle fitted too"),
    "region_critical_angle": Variable("fitted critical angle over the one given"),
    "region_restitution_error": Variable("standard error of the one with the critical angle fitted"),
    "region_critical_angle_error": Variable("standard error of the ratio of critical angles"),
    "region_correlation": Variable("correlation of restitution and critical angle in that fit"),
    "between_test_scatter": Variable("standard deviation of the coefficient of restitution between tests"),
    "side_restitution": Variable("coefficient of restitution that predictions use, for angles below and above zero"),
    "rigid_restitution": Variable("coefficient of restitution of a rigid body without bounce", comment=_OUTLINE),
    "level": Variable("confidence level of the interval"),
    "zero_offset": Variable("rest angle subtracted from the rocking angle", "rad", AUXILIARY, comment=_SIGN),
    "test_id": Variable("test", None, COORDINATE, dtype="str"),
    "test_restitution": Variable("coefficient of restitution of each test"),
    "test_restitution_standard_error": Variable("standard error of the coefficient of restitution of each test"),
    "critical_angle": Variable("critical angle", "rad", comment=_OUTLINE),
    "pole_distance": Variable("distance of the centre of mass from the pole", "m", comment=_OUTLINE),
    "inertia": Variable("moment of inertia about the pole", "kg m2", comment=_OUTLINE),
    "p": Variable("frequency parameter sqrt(m g R / I)", "rad s-1", comment=_OUTLINE),
    # compared
    "model": Variable("model", None, COORDINATE, dtype="str"),
    "nrmse": Variable("root mean square of predicted minus measured angle over the critical angle", "1", QUALITY),
    "measured_peak_ratio": Variable("measured peak angle over the critical angle", "1", MEASURED),
    "release_ratio": Variable("measured peak angle over the critical angle before the predicted time", "1", MEASURED),
    "measured_peak_time": Variable("time of the measured peak", "s", MEASURED),
    "predicted_peak_ratio": Variable("predicted peak angle over the critical angle", "1", MODELLED),
    "peak_ratio_error": Variable("predicted minus measured peak ratio", "1", QUALITY),
    "compared_until": Variable("time up to which measured and predicted are compared", "s", QUALITY),
    "predicted_outcome": Variable("predicted outcome", None, MODELLED, dtype="str"),
    "predicted_response_order": Variable("order of the predicted response", None, MODELLED, dtype="str"),
    "within_spread": Variable(
        "share of the model's runs that are closer to their median than the measured angle", "1", QUALITY, comment=_RANK
    ),
    "horizon": Variable("time up to which the model predicts the rocking angle", "s", MODELLED, comment=_HORIZON),
    "measured_distance": Variable(
        "largest distance of the measured angle from the median of the runs", "1", QUALITY, comment=_DISTANCE
    ),
    "member_distance": Variable(
        "largest distance of each run, as it would be measured, from the median of all others",
        "1",
        QUALITY,
        comment=_DISTANCE,
    ),
    "judged_peak_ratio": Variable(
        "peak ratio of each run as it would be measured, missing where it overturns", "1", QUALITY
    ),
    "peak_rank": Variable("share of the model's runs whose measured peak would be lower", "1", QUALITY),
    # ensembles
    "quantile": Variable("share of the runs that lie below", "1", COORDINATE),
    "rocking_angle_band": Variable("rocking angle below which that share of the runs lies", "rad", MODELLED),
    "overturning_probability": Variable("share of the runs that overturn", "1", MODELLED),
    "overturning_probability_low": Variable("lower end of its 95 % interval, for the number of runs", "1", QUALITY),
    "overturning_probability_high": Variable("upper end of its 95 % interval, for the number of runs", "1", QUALITY),
    "member_peak_ratio": Variable("peak ratio of each run, missing where it overturns", "1", MODELLED),
    "member_overturning_time": Variable("time at which each run overturns, missing where it stands", "s", MODELLED),
    "input": Variable("input that varies from run to run", None, COORDINATE, dtype="str"),
    "input_deviation": Variable(
        "its standard deviation", comment="Of restitution as such, of theta0 and out_of_plane in rad, else relative."
    ),
    "peak_sensitivity": Variable("rank correlation of the peak with the input", "1", MODELLED),
    # sine tests
    "forcing_frequency": Variable("frequency of the base motion while it is steady", "Hz", MEASURED),
    "forcing_amplitude": Variable("amplitude of the base acceleration while it is steady", "m s-2", MEASURED),
    "forcing_amplitude_spread": Variable("its standard deviation from period to period", "m s-2", QUALITY),
    "forcing_distortion": Variable("root mean square of the rest of the base motion over that of the sine"),
    "steady_start": Variable("time from which the base motion is steady", "s", MEASURED),
    "steady_stop": Variable("time up to which the base motion is steady", "s", MEASURED),
    "frequency_ratio": Variable("angular frequency of the base motion over p", "1", MEASURED),
    "amplitude_ratio": Variable("amplitude of the base acceleration over g tan α", "1", MEASURED),
    "response_misfit": Variable("misfit of the orders 1, 2, 3 … of the response", "1", QUALITY),
    "impacts_per_cycle": Variable("impacts per period of the base motion", "1", MEASURED),
    # contact
    "contact_stiffness": Variable("normal stiffness of the contact per area of the base", "N m-3"),
    "damping_fraction": Variable("critical damping fraction of the contact at each node"),
    "effective_damping": Variable("damping fraction of the whole body on all its nodes"),
    "friction": Variable("Coulomb's coefficient of friction between specimen and table"),
    "node_mass": Variable("mass of each base node", "kg"),
    "node_weight": Variable("weight of the standing specimen on each base node", "N"),
    "ring_radius": Variable("radius of the circle that a base node stands for, 0 for a point", "m"),
    "contact_restitution": Variable(
        "coefficient of restitution identified from the rocking angle of the contact model's free vibration",
        "1",
        MODELLED,
        comment=_FEW_ARCS,
    ),
    "contact_velocity_ratio": Variable(
        "mean velocity ratio of the impacts of the contact model's free vibration", "1", MODELLED
    ),
    "contact_step": Variable("step of the contact model", "s", AUXILIARY),
    "energy_residual": Variable("largest gap in the energy balance over the largest energy", "1", QUALITY),
    "tried_damping_fraction": Variable("critical damping fraction that was tried"),
    "tried_stiffness": Variable("stiffness that was tried, over the first"),
    "tried_restitution": Variable("coefficient of restitution that it gave", "1", MODELLED),
    # stability maps
    "outcome": Variable("outcome", None, MODELLED, dtype="int8"),
    "overturning_fraction": Variable("share of the cell around each amplitude ratio that overturns", "1", MODELLED),
    "no_rocking_limit": Variable("amplitude ratio up to which the block does not uplift", "1", MODELLED),
    "lower_limit": Variable("amplitude ratio from which the block overturns first", "1", MODELLED, comment=_WIDE),
    "upper_limit": Variable("amplitude ratio up to which the block survives last", "1", MODELLED, comment=_WIDE),
    "interval_frequency_ratio": Variable("frequency ratio of an interval that overturns", "1", MODELLED),
    "interval_start": Variable("amplitude ratio from which an interval overturns", "1", MODELLED),
    "interval_end": Variable("amplitude ratio up to which an interval overturns", "1", MODELLED),
    "steady_order": Variable("order of the steady response", "1", MODELLED, dtype="int32", comment=_ORDERS),
    "steady_period": Variable("period of the steady response", "s", MODELLED),
    "steady_peak_ratio": Variable("peak angle of the steady response over the critical angle", "1", MODELLED),
    # assessments
    "record": Variable("ground motion", None, COORDINATE, dtype="str"),
    "component": Variable("horizontal component of a ground motion", None, COORDINATE, dtype="str"),
    "measure": Variable("measure of the intensity of a ground motion", None, COORDINATE, dtype="str"),
    "measure_unit": Variable("SI unit of each measure", None, dtype="str"),
    "level_intensity": Variable("measure to which the ground motions are scaled", "1", COORDINATE, comment=_MEASURED),
    "spectrum_period": Variable("period of an oscillator damped by 5 %", "s", COORDINATE),
    "record_spectrum": Variable("pseudo-acceleration of each component as recorded", "m s-2", MEASURED),
    "record_measure": Variable("measure of each component as recorded", "1", MEASURED, comment="In its measure_unit."),
    "case_outcome": Variable("outcome of each history", None, MODELLED, dtype="int8", comment=_CASES),
    "case_overturned": Variable(
        "whether the angle goes beyond the share of the critical angle that counts as overturned",
        None,
        MODELLED,
        dtype="int8",
    ),
    "case_peak_ratio": Variable("largest angle over the critical angle, missing if it overturns", "1", MODELLED),
    "case_factor": Variable("factor on the ground motion, missing if it is not run", "1"),
    "case_friction": Variable("friction that the column needs with nothing varied", "1", MODELLED),
    "drawn_restitution": Variable("coefficient of restitution of each draw"),
    "drawn_critical_angle": Variable("critical angle of each draw", "rad"),
    "drawn_p": Variable("frequency parameter of each draw", "rad s-1"),
    "drawn_friction": Variable("coefficient of friction of each draw"),
    "curve_intensity": Variable("measure at which the lognormal curve is given", "1", MODELLED, comment=_MEASURED),
    "stripe_intensity": Variable("measure at which the isotonic curve is given", "1", MODELLED, comment=_MEASURED),
    "lognormal_probability": Variable("probability of overturning by the lognormal curve", "1", MODELLED),
    "lognormal_probability_low": Variable("lower end of its interval", "1", QUALITY),
    "lognormal_probability_high": Variable("upper end of its interval", "1", QUALITY),
    "isotonic_probability": Variable("probability of overturning by the isotonic curve", "1", MODELLED),
    "isotonic_probability_low": Variable("lower end of its interval", "1", QUALITY),
    "isotonic_probability_high": Variable("upper end of its interval", "1", QUALITY),
    "rate_edge": Variable("measures between which a share of the annual rate lies", "1", comment=_MEASURED),
    "rate_share": Variable("share of the annual rate of overturning between two of them", "1", MODELLED),
}
