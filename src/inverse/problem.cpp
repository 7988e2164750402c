#include "tactile_net/inverse/problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/stabiliser.hpp"
#include "inverse/weighting.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/elasticity/hat_kernel.hpp"
#include "tactile_net/sensing/aperture.hpp"
#include "tactile_net/sensing/surface_kernel.hpp"

namespace tactile_net {
namespace {

std::vector<bool> dead_places(const SensorArray& array, const ProblemOptions& options) {
  std::vector<bool> dead(array.count);
  for (const std::size_t taxel : options.dead_taxels) dead[taxel] = true;
  return dead;
}

/// Fills K for a regular array, whose taxels lie on values' places: each block is a Toeplitz
/// matrix.
void add_lags(const SensorArray& array, const Material& material, const ProblemOptions& options,
              InverseProblem& problem) {
  const Surface& surface = problem.surface;
  const std::size_t n = surface.count;
  for (std::size_t c = 0; const Channel& channel : channels(array)) {
    const double weight = options.channel_rms.empty() ? 1.0 : 1.0 / options.channel_rms[c];
    ++c;
    for (std::size_t u = 0; u < problem.unknowns; ++u) {
      const SurfaceKernel kernel = surface_kernel(channel, line_tractions[u], material, surface);
      problem.kernel_error = std::hypot(problem.kernel_error, weight * kernel.error);
      for (std::size_t i = 0; i < channel.count; ++i) {
        const std::size_t row = channel.first + i;
        const std::size_t at = surface.margin + i * surface.stride;
        for (std::size_t j = 0; j < n; ++j)
          problem.kernel(row, u * n + j) = problem.weights[row] * kernel.lags[at + n - 1 - j];
      }
    }
  }
}

/// Of taxels anywhere: entry by entry.
void add_hats(const Material& material, InverseProblem& problem) {
  const Surface& surface = problem.surface;
  const std::size_t n = surface.count;
  // By quantity, unknown and depth; by width and depth.
  std::map<std::tuple<Quantity, std::size_t, double>, HatKernel> made;
  std::map<std::pair<double, double>, Aperture> apertures;
  for (std::size_t row = 0; row < problem.sites.size(); ++row) {
    const Site& site = problem.sites[row];
    const Aperture& aperture =
        apertures.try_emplace({site.width, site.depth}, site.width, site.depth).first->second;
    for (std::size_t u = 0; u < problem.unknowns; ++u) {
      const auto [kernel, is_new] =
          made.try_emplace({site.quantity, u, site.depth}, site.quantity, line_tractions[u],
                           material, site.depth, surface.spacing);
      const HatKernel& hat = kernel->second;
      const auto error = [&](double y) { return hat.error_bound(y); };
      for (std::size_t j = 0; j < n; ++j) {
        const double distance = site.y - surface.position(j);
        const double weight = problem.weights[row];
        problem.kernel(row, u * n + j) = weight * aperture.mean(hat, distance);
        problem.kernel_error =
            std::hypot(problem.kernel_error, weight * aperture.mean(error, distance));
      }
    }
  }
}

}  // namespace

bool is_measured(const SensorArray& array, const ProblemOptions& options) {
  const std::vector<bool> dead = dead_places(array, options);
  std::vector<std::size_t> living(channel_count(array));
  for (const Site& site : sites(array))
    if (!dead[site.taxel]) ++living[site.channel];
  return *std::max_element(living.begin(), living.end()) >= (options.unknown_offsets ? 2 : 1);
}

void check(const SensorArray& array, const Material& material, const ProblemOptions& options) {
  check(array);
  check(material);
  if (options.unknowns != 1 && options.unknowns != 2)
    throw std::invalid_argument("unknowns must be 1 (normal) or 2 (normal and tangential)");
  if (options.unknowns > channel_count(array))
    throw std::invalid_argument(
        "two tractions cannot be told apart by one quantity at one depth: read a second one");
  if (!(options.smoothing_length >= 0.0) || !std::isfinite(options.smoothing_length))
    throw std::invalid_argument("smoothing_length must be >= 0 and finite");
  if (!(options.tangential_weight > 0.0) || !std::isfinite(options.tangential_weight))
    throw std::invalid_argument("tangential_weight must be > 0 and finite");
  if (options.channel_rms.empty()) {
    const bool strain = std::any_of(array.reads.begin(), array.reads.end(), is_strain);
    const bool stress = !std::all_of(array.reads.begin(), array.reads.end(), is_strain);
    if (strain && stress)
      throw std::invalid_argument(
          "strains and stresses read together need channel_rms: the sum of their squares has no "
          "unit");
  } else if (options.channel_rms.size() != channel_count(array)) {
    throw std::invalid_argument("channel_rms needs one value per channel");
  }
  for (const double rms : options.channel_rms)
    if (!(rms > 0.0) || !std::isfinite(rms))
      throw std::invalid_argument("channel_rms must be > 0 and finite");
  for (const std::size_t taxel : options.dead_taxels)
    if (taxel >= array.count)
      throw std::invalid_argument("dead taxel " + std::to_string(taxel) + " is not < count");
}

InverseProblem make_problem(const SensorArray& array, const Material& material,
                            const ProblemOptions& options) {
  check(array, material, options);

  InverseProblem problem{.sites = sites(array),
                         .taxels = array.count,
                         .unknowns = options.unknowns,
                         .surface = surface_of(array, options.surface),
                         .smoothing_length = options.smoothing_length,
                         .tangential_weight = options.tangential_weight,
                         .unknown_offsets = options.unknown_offsets};
  const std::vector<bool> dead = dead_places(array, options);
  for (const Site& site : problem.sites)
    problem.weights.push_back(dead[site.taxel] ? 0.0
                              : options.channel_rms.empty()
                                  ? 1.0
                                  : 1.0 / options.channel_rms[site.channel]);
  if (!is_measured(array, options))
    throw std::invalid_argument(
        options.unknown_offsets
            ? "no channel has two living taxels, and a channel's offset takes one reading: nothing "
              "is measured"
            : "every taxel is dead: nothing is measured");

  const std::size_t n = problem.surface.count;
  problem.kernel = make_kernel(problem.sites.size(), options.unknowns * n);
  if (is_even(array))
    add_lags(array, material, options, problem);
  else
    add_hats(material, problem);
  take_offsets_out(problem);
  drop_kernel_of_rounding(problem);
  return problem;
}

void leave_out(InverseProblem& problem, std::span<const std::size_t> taxels) {
  leave_taxels_out(problem, taxels);
}

std::vector<double> weighted(const InverseProblem& problem, std::span<const double> readings) {
  check_size(readings, problem.weights.size());
  const Eigen::VectorXd rows = Weighting(problem)(readings);
  return {rows.begin(), rows.end()};
}

std::vector<double> offsets(const InverseProblem& problem, std::span<const double> readings,
                            std::span<const double> tractions) {
  return offsets_of(problem, readings, tractions);
}

std::size_t independent_readings(const InverseProblem& problem) {
  return static_cast<std::size_t>(Weighting(problem).rows());
}

std::size_t line_length(const InverseProblem& problem) {
  std::vector<std::size_t> lengths(problem.sites.back().channel + 1);
  for (const Site& site : problem.sites) ++lengths[site.channel];
  const bool alike = std::all_of(lengths.begin(), lengths.end(),
                                 [&](std::size_t one) { return one == lengths.front(); });
  return alike ? lengths.front() : problem.sites.size();
}

Matrix normal_matrix(const InverseProblem& problem, double alpha) {
  check_alpha(alpha);
  const auto kernel = as_eigen(problem.kernel);
  RowMajor p = RowMajor::Zero(kernel.cols(), kernel.cols());
  p.selfadjointView<Eigen::Upper>().rankUpdate(kernel.transpose());

  const Eigen::VectorXd sizes = stabiliser_sizes(problem);
  const Eigen::VectorXd couplings = stabiliser_couplings(problem, alpha);
  for (Eigen::Index i = 0; i < p.rows(); ++i) {
    p(i, i) += alpha * sizes(i) * sizes(i);
    if (couplings(i) == 0.0) continue;
    p(i, i) += couplings(i);
    p(i + 1, i + 1) += couplings(i);
    p(i, i + 1) -= couplings(i);
  }
  p.triangularView<Eigen::StrictlyLower>() = p.transpose();
  return from_eigen(p);
}

std::vector<double> normal_right_side(const InverseProblem& problem,
                                      std::span<const double> readings) {
  check_size(readings, problem.weights.size());
  std::vector<double> right_side(problem.kernel.columns);
  Eigen::Map<Eigen::VectorXd>(right_side.data(), std::ssize(right_side)) =
      as_eigen(problem.kernel).transpose() * Weighting(problem)(readings);
  return right_side;
}

}  // namespace tactile_net
