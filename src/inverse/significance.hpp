/// @file
/// Upper quantiles: what chance alone exceeds in a given share of cases. Private.
#pragma once

namespace tactile_net {

/// Upper `alarms` quantile of chi-squared with `degrees` degrees of freedom: the sum of squares of
/// white noise of rms 1 exceeds it in this share of frames.
/// @pre  degrees > 0, 0 < alarms < 1
[[nodiscard]] double chi_squared_quantile(double degrees, double alarms);

/// Upper `alarms` quantile of F: the ratio of two variances with `above` and `below` degrees of
/// freedom exceeds it in this share of cases.
/// @pre  above > 0, below > 0, 0 < alarms < 1
[[nodiscard]] double variance_ratio_quantile(double above, double below, double alarms);

}  // namespace tactile_net
