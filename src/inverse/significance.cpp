#include "inverse/significance.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>

namespace tactile_net {

double chi_squared_quantile(double degrees, double alarms) {
  return boost::math::quantile(
      boost::math::complement(boost::math::chi_squared_distribution<double>(degrees), alarms));
}

double variance_ratio_quantile(double above, double below, double alarms) {
  return boost::math::quantile(
      boost::math::complement(boost::math::fisher_f_distribution<double>(above, below), alarms));
}

}  // namespace tactile_net
