#include "tactile_net/inverse/line_problem.hpp"

#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "inverse/assembly.hpp"
#include "tactile_net/elasticity/hat_kernel.hpp"
#include "tactile_net/sensing/aperture.hpp"
#include "tactile_net/sensing/surface_kernel.hpp"

namespace tactile_net {
namespace {

/// Fills K for a regular array, whose taxels lie on values' places: each block is a Toeplitz
/// matrix.
void add_lags(const SensorArray& array, const Material& material, const LineProblemOptions& options,
              const Surface& surface, LinearProblem& problem) {
  const std::size_t n = surface.count;
  for (std::size_t c = 0; const Channel& channel : channels(array)) {
    const double weight = options.channel_rms.empty() ? 1.0 : 1.0 / options.channel_rms[c];
    ++c;
    for (std::size_t u = 0; u < problem.components; ++u) {
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
void add_hats(const Material& material, const Surface& surface, LinearProblem& problem) {
  const std::size_t n = surface.count;
  // By quantity, unknown and depth; by width and depth.
  std::map<std::tuple<Quantity, std::size_t, double>, HatKernel> made;
  std::map<std::pair<double, double>, Aperture> apertures;
  for (std::size_t row = 0; row < problem.sites.size(); ++row) {
    const Site& site = problem.sites[row];
    const Aperture& aperture =
        apertures.try_emplace({site.width, site.depth}, site.width, site.depth).first->second;
    for (std::size_t u = 0; u < problem.components; ++u) {
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

bool is_measured(const SensorArray& array, const LineProblemOptions& options) {
  return is_measured(sites(array), options.dead_taxels, options.unknown_offsets);
}

void check(const SensorArray& array, const Material& material, const LineProblemOptions& options) {
  check(array);
  check(material);
  if (options.unknowns != 1 && options.unknowns != 2)
    throw std::invalid_argument("unknowns must be 1 (normal) or 2 (normal and tangential)");
  if (options.unknowns > channel_count(array))
    throw std::invalid_argument(
        "two tractions cannot be told apart by one quantity at one depth: read a second one");
  check_common_options(options.smoothing_length, options.tangential_weight, options.channel_rms,
                       channels(array), options.dead_taxels, array.count);
}

LinearProblem make_problem(const SensorArray& array, const Material& material,
                           const LineProblemOptions& options) {
  check(array, material, options);
  const Surface surface = surface_of(array, options.surface);
  LinearProblem problem{.sites = sites(array),
                        .taxels = array.count,
                        .components = options.unknowns,
                        .grid = grid_of(surface),
                        .is_line = true,
                        .measure = measure_of(array, surface),
                        .smoothing_length = options.smoothing_length,
                        .tangential_weight = options.tangential_weight,
                        .unknown_offsets = options.unknown_offsets};
  problem.weights = row_weights(problem.sites, options.dead_taxels, options.channel_rms);
  require_measured(problem.sites, options.dead_taxels, options.unknown_offsets);
  problem.kernel = make_kernel(problem.sites.size(), problem.components * surface.count);
  if (is_even(array))
    add_lags(array, material, options, surface, problem);
  else
    add_hats(material, surface, problem);
  finish_kernel(problem);
  return problem;
}

}  // namespace tactile_net
