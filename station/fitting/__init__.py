"""Least squares with priors, noise, outliers, and the accuracy that follows from a covariance."""

from __future__ import annotations

from station.fitting.accuracy import (
    ErrorFields,
    error_bounds,
    expected_largest_error_bound,
    largest_error_bound,
    largest_error_bounds,
    position_error_field,
    position_error_summary,
    rms_and_max,
)
from station.fitting.least_squares import (
    BLIND,
    MAX_STEPS,
    NotConvergedError,
    Prior,
    Residuals,
    Solution,
    solve,
)
from station.fitting.linear import positive, solved
from station.fitting.noise import (
    FEWEST_REPEATS,
    MINIMUM_DOF,
    REFUSED_P,
    Noise,
    chance_of,
    estimate_noise,
    lack_of_fit,
    pure_error,
    specified_noise,
)
from station.fitting.outliers import (
    Outlier,
    check_outlier_share,
    few_enough,
    find_outliers,
    outliers_of_fit,
)
from station.fitting.prior import tolerance_prior
from station.fitting.separability import describe_separability

__all__ = [
    "BLIND",
    "FEWEST_REPEATS",
    "MAX_STEPS",
    "MINIMUM_DOF",
    "REFUSED_P",
    "ErrorFields",
    "Noise",
    "NotConvergedError",
    "Outlier",
    "Prior",
    "Residuals",
    "Solution",
    "chance_of",
    "check_outlier_share",
    "describe_separability",
    "error_bounds",
    "estimate_noise",
    "expected_largest_error_bound",
    "few_enough",
    "find_outliers",
    "lack_of_fit",
    "largest_error_bound",
    "largest_error_bounds",
    "outliers_of_fit",
    "position_error_field",
    "position_error_summary",
    "positive",
    "pure_error",
    "rms_and_max",
    "solve",
    "solved",
    "specified_noise",
    "tolerance_prior",
]
