#include "tactile_net/inverse/long_array_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "inverse/checks.hpp"
#include "numeric/kept_or_made.hpp"

namespace tactile_net {
namespace {

/// Of sums, kept at a time: more than a contact's force, moment and angle have, few enough to be
/// searched one by one.
constexpr std::size_t most_images = 24;

}  // namespace

LongArrayCovariance::LongArrayCovariance(const LongArrayFamily& family, FftTikhonov& solver,
                                         double alpha, double prior_alpha)
    : family_(family), solver_(solver), alpha_(alpha), prior_alpha_(prior_alpha) {
  check_alpha(prior_alpha);
  solver_.use_alpha(alpha);
}

std::vector<double> LongArrayCovariance::deviations() const {
  return family_.deviations(alpha_, prior_alpha_);
}

const std::vector<double>& LongArrayCovariance::image(std::span<const double> weights) const {
  const auto is = [&](const std::vector<double>& kept) {
    return std::equal(kept.begin(), kept.end(), weights.begin(), weights.end());
  };
  return kept_or_made(images_, most_images, is, [&] {
    check_weights(weights, solver_.tractions());
    solver_.use_alpha(alpha_);
    std::vector<double> image = solver_.stacked_product(solver_.solve_normal(weights));
    // Below the readings stands sqrt(alpha) L x.
    const auto smooth = image.begin() + static_cast<std::ptrdiff_t>(solver_.readings());
    const double prior = std::sqrt(alpha_ / prior_alpha_);
    std::for_each(smooth, image.end(), [=](double& value) { value *= prior; });
    return std::pair(std::vector<double>(weights.begin(), weights.end()), std::move(image));
  });
}

double LongArrayCovariance::deviation(std::span<const double> weights) const {
  return std::sqrt(covariance(weights, weights));
}

double LongArrayCovariance::covariance(std::span<const double> a, std::span<const double> b) const {
  const std::vector<double>& of_a = image(a);  // stays: it is not the one asked for longest ago
  const std::vector<double>& of_b = image(b);
  return std::inner_product(of_a.begin(), of_a.end(), of_b.begin(), 0.0);
}

double LongArrayCovariance::degrees_of_freedom() const noexcept {
  return family_.degrees_of_freedom(alpha_);
}

}  // namespace tactile_net
