#include "tactile_net/inverse/dft_friction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "tactile_net/sensing/sampled.hpp"

namespace tactile_net {
namespace {

constexpr double tolerated = 0.1;  // of f_v, outside the contact or antisymmetric

}  // namespace

std::string_view name(FrictionVerdict verdict) noexcept {
  switch (verdict) {
    case FrictionVerdict::ok:
      return "ok";
    case FrictionVerdict::dft:
      return "dft";
    case FrictionVerdict::not_one_contact:
      return "not_one_contact";
    case FrictionVerdict::no_contact:
      return "no_contact";
  }
  return "";
}

DftFriction::DftFriction(const SensorArray& array, const Material& material, double friction,
                         double gain_limit)
    : division_(array, material, gain_limit),
      friction_(friction),
      kernel_(sampled_kernel(channels(array).front(), Traction::tangential, material, array.count,
                             array.pitch)) {
  if (!std::isfinite(friction)) throw std::invalid_argument("friction must be finite");
}

FrictionSolution DftFriction::solve(std::span<const double> readings) {
  const std::size_t n = kernel_.size() / 2 + 1;
  std::vector<double> even(n);
  std::vector<double> odd(n);
  FrictionSolution solution{.normal = std::vector<double>(n), .tangential = std::vector<double>(n)};
  if (readings.size() != n) throw std::invalid_argument("readings need one value per taxel");
  for (std::size_t i = 0; i < n; ++i) {
    even[i] = 0.5 * (readings[i] + readings[n - 1 - i]);
    odd[i] = 0.5 * (readings[i] - readings[n - 1 - i]);
  }
  if (division_.solve(even, solution.normal) != Status::ok)
    throw std::invalid_argument("readings are not finite");
  solution.dft = division_.verdict(even);
  const double force = std::accumulate(solution.normal.begin(), solution.normal.end(), 0.0);
  if (!(force > 0.0)) {
    solution.verdict = FrictionVerdict::no_contact;
    (void)division_.solve(readings, solution.normal);
    return solution;
  }

  // Boxes that grow by a taxel on each side; `pattern` is K2 * box of height 1 / w.
  std::vector<double> sum(n);
  std::vector<double> best(n);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t width = n % 2 == 0 ? 2 : 1; width <= n; width += 2) {
    const std::size_t first = (n - width) / 2;
    const auto add = [&](std::size_t source) {
      for (std::size_t i = 0; i < n; ++i) sum[i] += kernel_[i + n - 1 - source];
    };
    add(first);
    if (width > 1) add(n - 1 - first);
    const double height = friction_ * force / static_cast<double>(width);
    double misfit = 0.0;
    for (std::size_t i = 0; i < n; ++i) misfit += std::pow(odd[i] - height * sum[i], 2);
    // Without friction every width fits: then the one that holds nearly all of the normal force.
    if (friction_ == 0.0) {
      double inside = 0.0;
      for (std::size_t i = first; i < n - first; ++i) inside += solution.normal[i];
      misfit = inside >= 0.99 * force ? static_cast<double>(width)
                                      : static_cast<double>(n) + force - inside;
    }
    if (misfit < least) {
      least = misfit;
      solution.width = width;
      for (std::size_t i = 0; i < n; ++i) best[i] = height * sum[i];
    }
  }

  std::vector<double> rest(readings.begin(), readings.end());
  for (std::size_t i = 0; i < n; ++i) rest[i] -= best[i];
  (void)division_.solve(rest, solution.normal);
  const std::size_t first = (n - solution.width) / 2;
  double size = 0.0;
  double outside = 0.0;
  double lopsided = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool inside = i >= first && i < n - first;
    if (inside) solution.tangential[i] = friction_ * force / static_cast<double>(solution.width);
    size += std::abs(solution.normal[i]);
    if (!inside) outside += std::abs(solution.normal[i]);
    lopsided += 0.5 * std::abs(solution.normal[i] - solution.normal[n - 1 - i]);
  }
  if (solution.dft != DftVerdict::ok)
    solution.verdict = FrictionVerdict::dft;
  else if (outside > tolerated * size || lopsided > tolerated * size)
    solution.verdict = FrictionVerdict::not_one_contact;
  return solution;
}

}  // namespace tactile_net
