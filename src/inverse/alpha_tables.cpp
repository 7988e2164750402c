#include "tactile_net/inverse/alpha_tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "inverse/alpha_criteria.hpp"

namespace tactile_net {
namespace {

constexpr double resolution = 64.0;  // units of rounding per row below which gamma means nothing
constexpr double high = 9.2;         // log alpha at which every component is below 1e-4
/// A component below this share of the largest holds noise and no signal, in readings of 1 % noise.
constexpr double silent_share = 0.01;
constexpr double fewest_silent = 5.0;

}  // namespace

double AlphaTables::Parts::at(std::size_t step) const noexcept {
  return low + (high - low) * (static_cast<double>(step) / (alpha_steps - 1.0));
}

double AlphaTables::Parts::alpha(double log_alpha) const noexcept {
  const double root = largest * std::exp(0.5 * log_alpha);
  return root * root;
}

AlphaTables::Parts::Parts(std::span<const double> all_gamma, std::size_t all_rows,
                          std::span<const double> all_shares, const Parts* like)
    : gamma(all_gamma.begin(), all_gamma.end()),
      shares(all_shares.begin(), all_shares.end()),
      relative(gamma.size()),
      rows(all_rows) {
  if (!shares.empty() && shares.size() != gamma.size())
    throw std::invalid_argument("a frame needs a share for every component, or none");

  // Components beyond the number of rows show in no reading, whatever rounding made of them.
  std::vector<std::size_t> order(gamma.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return gamma[a] > gamma[b]; });
  largest = like != nullptr ? like->largest : order.empty() ? 0.0 : gamma[order.front()];
  if (shares.empty()) order.resize(std::min(rows, order.size()));
  double smallest = 0.0;
  unexplained = static_cast<double>(rows);
  for (const std::size_t i : order) {
    if (!(gamma[i] > 0.0)) break;
    relative[i] = smallest = gamma[i] / largest;
    unexplained -= share(i);
  }
  if (unexplained < 1e-9 * static_cast<double>(rows)) unexplained = 0.0;  // shares are rounded

  const double floor = std::min(resolution * static_cast<double>(std::max<std::size_t>(rows, 1)) *
                                    std::numeric_limits<double>::epsilon(),
                                0.1);
  const double half_kept = 2.0 * std::log(std::max(smallest, floor));
  low = std::log(floor) + std::max(std::log(floor), half_kept);
  const auto step = [&](double log_alpha) {
    return static_cast<std::size_t>((log_alpha - low) / (high - low) * (alpha_steps - 1.0));
  };
  if (like != nullptr) {
    low = like->low;
    first = like->first;
    last = like->last;
  } else {
    first = step(std::min(half_kept, -1.0));  // all gamma equal: a bracket needs a width
    last = step(0.0);
  }
  cannot_estimate_noise = traces(2.0 * std::log(silent_share)).left < fewest_silent;
  fill();
}

Traces AlphaTables::Parts::traces(double log_alpha) const noexcept {
  const double alpha = std::exp(log_alpha);
  Traces sums{.left = unexplained};
  for (std::size_t i = 0; i < relative.size(); ++i) {
    const double one = relative[i];
    if (one == 0.0) continue;
    const double kept = one * one / (one * one + alpha);
    const double left = alpha / (one * one + alpha);
    sums.kept += share(i) * kept;
    sums.left += share(i) * left;
    sums.square += share(i) * kept * kept;
    sums.log_determinant += share(i) * std::log(left);
  }
  return sums;
}

void AlphaTables::Parts::fill() {
  const auto n = std::ssize(relative);
  lost.resize(n, alpha_count);
  weights.resize(4 * alpha_count, n);
  relative_alphas.resize(alpha_count);
  for (Eigen::VectorXd& one : penalties) one = Eigen::VectorXd::Zero(alpha_count);
  for (Eigen::Index a = 0; a < alpha_count; ++a) {
    const double log_alpha = at(static_cast<std::size_t>(a));
    const double relative_alpha = std::exp(log_alpha);
    relative_alphas(a) = relative_alpha;
    alphas.push_back(alpha(log_alpha));
    for (Eigen::Index i = 0; i < n; ++i) {
      const double one = relative[static_cast<std::size_t>(i)];
      const double square = one * one;
      const double left = relative_alpha / (square + relative_alpha);
      const double size = square / ((square + relative_alpha) * (square + relative_alpha));
      lost(i, a) = left;
      weights(a, i) = left * left;
      weights(alpha_count + a, i) = left;
      weights(2 * alpha_count + a, i) = size;
      weights(3 * alpha_count + a, i) = -4.0 * left * size;
    }
    const Traces sums = traces(log_alpha);
    for (const AlphaRule rule : alpha_rules)
      penalties[index(rule)](a) = penalty(rule, sums, static_cast<double>(rows));
  }
}

AlphaTables::AlphaTables(std::span<const double> gamma, std::size_t rows,
                         std::span<const double> shares)
    : parts_(std::make_unique<const Parts>(gamma, rows, shares)) {}
bool AlphaTables::cannot_estimate_noise() const noexcept { return parts_->cannot_estimate_noise; }

AlphaRule default_rule(const AlphaTables& tables, bool noise_known) noexcept {
  if (!tables.cannot_estimate_noise()) return AlphaRule::aicc;
  return noise_known ? AlphaRule::evidence : AlphaRule::gml;
}

AlphaTables::~AlphaTables() = default;
AlphaTables::AlphaTables(AlphaTables&&) noexcept = default;
AlphaTables& AlphaTables::operator=(AlphaTables&&) noexcept = default;

double penalty(AlphaRule rule, const Traces& sums, double rows) noexcept {
  switch (rule) {
    case AlphaRule::rgcv:
      return -2.0 * std::log(sums.left) + std::log(robustness(sums, rows));
    case AlphaRule::gcv:
      return -2.0 * std::log(sums.left);
    case AlphaRule::gml:
      return -sums.log_determinant / rows;
    case AlphaRule::evidence:
      return -0.5 * sums.log_determinant;
    case AlphaRule::aicc:
      if (!(sums.left > 2.0)) return std::numeric_limits<double>::infinity();
      return 1.0 - std::log(rows) + 2.0 * (sums.kept + 1.0) / (sums.left - 2.0);
    default:
      return 0.0;
  }
}

}  // namespace tactile_net
