/// @file
/// What chance alone exceeds in a given share of cases. Private.
#pragma once

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>

namespace tactile_net {

/// Of a sum of squares of white noise of rms 1.
inline double chi_squared_limit(double degrees, double alarms) {
  return boost::math::quantile(
      boost::math::complement(boost::math::chi_squared_distribution<double>(degrees), alarms));
}

/// Of the ratio of two variances with so many degrees of freedom.
inline double variance_ratio_limit(double above, double below, double alarms) {
  return boost::math::quantile(
      boost::math::complement(boost::math::fisher_f_distribution<double>(above, below), alarms));
}

}  // namespace tactile_net
