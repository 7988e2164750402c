#include "inverse/single_liar.hpp"

#include <boost/math/distributions/normal.hpp>

#include "inverse/significance.hpp"
#include "tactile_net/inverse/data_verdict.hpp"

namespace tactile_net {

double taxel_gain(double readings, std::size_t taxels) {
  return chi_squared_quantile(readings, false_alarms / static_cast<double>(taxels));
}

SingleLiar::SingleLiar(double rows) : rows_(rows) {
  constexpr double odd_frames = 0.05;
  largest_ = boost::math::quantile(boost::math::complement(
      boost::math::normal_distribution<double>(), 0.5 * odd_frames / std::max(rows, 1.0)));
}

}  // namespace tactile_net
