"""Which variables of the table the result of each stage may have; the channels of a test are further ones."""

from __future__ import annotations

_RESTITUTION = ("restitution", "restitution_low", "restitution_high")
_HISTORY = ("impact_time", "peak_angle", "peak_ratio", "peak_time", "overturning_time")
_MOTION = (
    *("base_acceleration", "transverse_base_acceleration", "vertical_base_acceleration"),
    *("base_displacement", "transverse_base_displacement", "vertical_base_displacement"),
)
_BASE = ("slide", "uplift", "out_of_plane_angle", "transverse_slide", "yaw")
_CONTACT = (
    *("contact_stiffness", "damping_fraction", "effective_damping", "friction"),
    *("node_mass", "node_weight", "ring_radius", "energy_residual"),
)
_OVERTURNING = ("overturning_probability", "overturning_probability_low", "overturning_probability_high")

CONTENTS: dict[str, tuple[str, ...]] = {
    "ingest": ("elapsed", "time"),
    "condition": ("elapsed", "time"),
    "rocking": (
        *("elapsed", "time", "rocking_angle", "rocking_angle_quality", "rocking_angle_standard_error"),
        *("rocking_angle_drift", "angle_deviation"),
        *(name for base in _BASE for name in (base, f"{base}_standard_error")),
        *("transducer", "residual_to_noise", "residual_to_reading", *_MOTION, *_HISTORY),
        *("peak_ground_acceleration", "noise_threshold"),
    ),
    "restitution": (
        *("impact_time", "impact_time_standard_error", "impact_velocity", "impact_used"),
        *("impact_restitution", "impact_restitution_standard_error"),
        *("peak_angle", "peak_time", "peak_angle_standard_error", "fitted_angle", "peak_used"),
        *(*_RESTITUTION, "restitution_standard_error", "level"),
        *("restitution_slope", "restitution_slope_standard_error", "zero_offset"),
        *("estimator", "estimate", "estimate_low", "estimate_high", "estimate_standard_error"),
        *("model", "restitution_history", "restitution_history_low", "restitution_history_high"),
        *("restitution_history_standard_error", "restitution_history_residual"),
        *("fitted_elapsed", "fitted_history", "history_residual"),
        *("region_restitution", "region_critical_angle", "region_restitution_error", "region_critical_angle_error"),
        "region_correlation",
    ),
    "specimen": (
        *(*_RESTITUTION, "level", "between_test_scatter", "side_restitution", "rigid_restitution"),
        *("test_id", "test_restitution", "test_restitution_standard_error"),
        *("critical_angle", "pole_distance", "inertia", "p"),
    ),
    "contact": (
        *("restitution", *_CONTACT, "contact_restitution", "contact_velocity_ratio", "contact_step"),
        *("tried_damping_fraction", "tried_stiffness", "tried_restitution"),
    ),
    "predict": (
        *("elapsed", "time", "rocking_angle", *_BASE, *_MOTION, *_HISTORY),
        *("impact_count", "restitution", "zero_offset", *_CONTACT),
    ),
    "ensemble": (
        *("elapsed", "time", "rocking_angle", "quantile", "rocking_angle_band", *_OVERTURNING),
        *("member_peak_ratio", "member_overturning_time", "input", "input_deviation", "peak_sensitivity"),
        *("horizon", "judged_peak_ratio", "measured_distance", "member_distance"),
    ),
    "compare": (
        *("model", "nrmse", "compared_until", "measured_peak_ratio", "measured_peak_time", "release_ratio"),
        *("predicted_peak_ratio", "peak_ratio_error", "predicted_outcome", "predicted_response_order", "zero_offset"),
        *("within_spread", "horizon", "peak_rank", "overturning_probability"),
        *("forcing_frequency", "forcing_amplitude", "forcing_amplitude_spread", "forcing_distortion"),
        *("steady_start", "steady_stop", "frequency_ratio", "amplitude_ratio", "response_misfit"),
        "impacts_per_cycle",
    ),
    "forecast": (
        *("basis", "model", "observed_amplitude", "forecast_overturning_probability", "forecast_crps"),
        *("forecast_ranked_probability", "forecast_brier", "forecast_logarithmic", "forecast_pit"),
    ),
    "map": (
        *("frequency_ratio", "amplitude_ratio", "outcome", "overturning_fraction"),
        *("no_rocking_limit", "lower_limit", "upper_limit"),
        *("interval_frequency_ratio", "interval_start", "interval_end"),
    ),
    "responses": (
        *("frequency_ratio", "amplitude_ratio", "steady_order", "steady_period", "steady_peak_ratio"),
        "impacts_per_cycle",
    ),
    "assessment": (
        *("record", "component", "measure", "measure_unit", "level_intensity", "record_measure"),
        *("spectrum_period", "record_spectrum"),
        *("case_outcome", "case_overturned", "case_peak_ratio", "case_factor", "case_friction"),
        *("drawn_restitution", "drawn_critical_angle", "drawn_p", "drawn_friction"),
        *("curve_intensity", "lognormal_probability", "lognormal_probability_low", "lognormal_probability_high"),
        *("stripe_intensity", "isotonic_probability", "isotonic_probability_low", "isotonic_probability_high"),
        *("rate_edge", "rate_share"),
    ),
}
"""Names by stage, of `store.variables.VARIABLES`. A result has those that its test and its campaign give rise to."""
