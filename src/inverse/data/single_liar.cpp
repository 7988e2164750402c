#include "inverse/data/single_liar.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>

#include "inverse/significance.hpp"
#include "tactile_net/inverse/data_verdict.hpp"

namespace tactile_net {
namespace {

double least_gain(double chance, std::span<const double> seen) noexcept {
  constexpr double model_error = 0.05;  // of the largest reading
  double largest = 0.0;
  for (const double reading : seen) largest = std::max(largest, std::abs(reading));
  return std::max(chance, std::pow(model_error * largest, 2));
}

}  // namespace

std::vector<std::size_t> suspects(std::span<const double> residual, std::span<const Site> sites,
                                  std::size_t taxels) {
  constexpr std::size_t most = 4;
  std::vector<double> squares(taxels);
  for (std::size_t row = 0; row < residual.size(); ++row)
    squares[sites[row].taxel] += residual[row] * residual[row];
  std::vector<std::size_t> order(taxels);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return squares[a] > squares[b]; });
  order.resize(std::min(order.size(), most));
  return order;
}

double taxel_gain(double readings, std::size_t taxels) {
  return chi_squared_quantile(readings, false_alarms / static_cast<double>(taxels));
}

double sum_of_squares(std::span<const double> residual) noexcept {
  return std::accumulate(residual.begin(), residual.end(), 0.0,
                         [](double sum, double left) { return sum + left * left; });
}

SingleLiar::SingleLiar(double rows) {
  constexpr double odd_frames = 0.05;
  largest_ = boost::math::quantile(boost::math::complement(
      boost::math::normal_distribution<double>(), 0.5 * odd_frames / std::max(rows, 1.0)));
}

bool SingleLiar::may_be_in(std::span<const double> residual) const noexcept {
  return std::any_of(residual.begin(), residual.end(),
                     [this](double left) { return !(std::abs(left) <= largest_); });
}

bool SingleLiar::is_found(std::span<const double> before, std::span<const double> without,
                          double chance, std::span<const double> seen) const noexcept {
  return sum_of_squares(before) - sum_of_squares(without) >= least_gain(chance, seen) &&
         !may_be_in(without);
}

bool SingleLiar::may_gain(std::span<const double> before, double chance,
                          std::span<const double> seen) noexcept {
  return sum_of_squares(before) >= least_gain(chance, seen);
}

}  // namespace tactile_net
