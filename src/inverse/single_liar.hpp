/// @file
/// Whether one taxel lies in a frame that contacts explain: a narrow contact beside it takes up
/// most of what it says too much, and the sum over all readings leaves room for the rest. Of lines
/// and of skins. Private.
#pragma once

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "inverse/significance.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/data_verdict.hpp"

namespace tactile_net {

/// The taxels with the largest residuals, largest first.
/// @param sites  of each row
template <class Sites>
[[nodiscard]] std::vector<std::size_t> suspects(const Eigen::VectorXd& residual, const Sites& sites,
                                                std::size_t taxels) {
  constexpr std::size_t most = 4;
  std::vector<double> squares(taxels);
  for (std::size_t row = 0; row < sites.size(); ++row)
    squares[sites[row].taxel] += std::pow(residual(static_cast<Eigen::Index>(row)), 2);
  std::vector<std::size_t> order(taxels);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return squares[a] > squares[b]; });
  order.resize(std::min(order.size(), most));
  return order;
}

/// What the sum over a taxel's readings takes of noise by chance, whichever the taxel is.
[[nodiscard]] inline double taxel_gain(double readings, std::size_t taxels) {
  return chi_squared_limit(readings, false_alarms / static_cast<double>(taxels));
}

class SingleLiar {
 public:
  /// @param rows  independent ones
  explicit SingleLiar(double rows)
      : largest_(boost::math::quantile(boost::math::complement(
            boost::math::normal_distribution<double>(), 0.5 * odd_frames / std::max(rows, 1.0)))) {}

  /// A residual, over the noise, is larger than noise has its largest in 19 frames of 20: only then
  /// is it worth while to leave out a taxel.
  [[nodiscard]] bool may_be_in(const Eigen::VectorXd& residual) const {
    return residual.size() > 0 && !(residual.cwiseAbs().maxCoeff() <= largest_);
  }
  /// By a gain in squares that neither noise nor an error of the model is likely to have, and that
  /// leaves nothing odd.
  ///
  /// @param before   what the best contact leaves, over the noise
  /// @param without  what the best one leaves of the rest; 0 at the taxel
  /// @param chance   `taxel_gain`
  /// @param seen     all readings, over the noise
  [[nodiscard]] bool is_found(const Eigen::VectorXd& before, const Eigen::VectorXd& without,
                              double chance, const Eigen::VectorXd& seen) const {
    constexpr double model_error = 0.05;  // of the largest reading
    const double of_model = model_error * seen.cwiseAbs().maxCoeff();
    return before.squaredNorm() - without.squaredNorm() >= std::max(chance, of_model * of_model) &&
           !may_be_in(without);
  }

 private:
  static constexpr double odd_frames = 0.05;
  double largest_;
};

}  // namespace tactile_net
