#include "tactile_net/skin/problem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "inverse/assembly.hpp"
#include "numeric/require.hpp"
#include "skin/cell_kernel.hpp"
#include "skin/curved_kernel.hpp"
#include "skin/problem_parts.hpp"
#include "tactile_net/skin/curved_skin.hpp"

namespace tactile_net {
namespace {

/// Of taxels on the grid's lattice.
void add_lattice(const SkinArray& skin, CellKernels& kernels, LinearProblem& problem) {
  const SurfaceGrid& grid = problem.grid;
  for (const Channel& channel : channels(skin))
    for (std::size_t u = 0; u < problem.components; ++u) {
      const LatticeKernel kernel(kernels(channel.depth), channel.quantity, skin_tractions[u], grid);
      for (std::size_t i = 0; i < channel.count; ++i) {
        const std::size_t row = channel.first + i;
        const auto [at_row, at_column] = cell_of(skin, grid, i);
        double* entry = &problem.kernel(row, u * grid.count());
        for (std::size_t m = 0; m < grid.rows; ++m)
          for (std::size_t n = 0; n < grid.columns; ++n)
            *entry++ = problem.weights[row] * kernel(at_row, at_column, m, n);
      }
    }
}

/// Of taxels anywhere: entry by entry.
void add_places(CellKernels& kernels, LinearProblem& problem) {
  const SurfaceGrid& grid = problem.grid;
  const std::size_t cells = grid.count();
  std::vector<double> y(cells), z(cells);
  for (std::size_t row = 0; row < problem.sites.size(); ++row) {
    const Site& site = problem.sites[row];
    for (std::size_t i = 0; i < cells; ++i) {
      y[i] = site.y - grid.y(i / grid.columns);
      z[i] = site.z - grid.z(i % grid.columns);
    }
    for (std::size_t u = 0; u < problem.components; ++u) {
      const std::span<double> entries(&problem.kernel(row, u * cells), cells);
      kernels(site.depth)(site.quantity, skin_tractions[u], y, z, entries);
      for (double& entry : entries) entry *= problem.weights[row];
    }
  }
}

/// Of K in the 2-norm, at most: that of the errors of its entries.
double kernel_error(CellKernels& kernels, const LinearProblem& problem) {
  std::map<std::pair<double, Quantity>, double> bounds;
  double square = 0.0;
  for (std::size_t row = 0; row < problem.sites.size(); ++row) {
    const Site& site = problem.sites[row];
    const auto [bound, is_new] = bounds.try_emplace({site.depth, site.quantity});
    if (is_new) bound->second = kernels(site.depth).error_bound(site.quantity);
    square = std::hypot(square, problem.weights[row] * bound->second);
  }
  return square * std::sqrt(static_cast<double>(problem.kernel.columns));
}

void add_flat_kernel(const SkinArray& skin, const Material& material, LinearProblem& problem) {
  CellKernels kernels(material, problem.grid);
  if (is_lattice(skin, problem.grid))
    add_lattice(skin, kernels, problem);
  else
    add_places(kernels, problem);
  problem.kernel_error = kernel_error(kernels, problem);
}

/// A cell's area over that of a taxel, length by length: an area may be too large, or too small,
/// for a number. A direction in which there is one taxel has the other's pitch, or the depth.
double area_ratio(const SkinArray& skin, const SurfaceGrid& grid) {
  const double depth = least_depth(skin);
  if (!is_even(skin)) {
    const bool one = skin.taxels.size() == 1;
    return grid.spacing_y / (one ? depth : skin.pitch_y) *
           (grid.spacing_z / (one ? depth : skin.pitch_z));
  }
  const double other = skin.rows > 1 ? skin.pitch_y : skin.columns > 1 ? skin.pitch_z : depth;
  return grid.spacing_y / (skin.rows > 1 ? skin.pitch_y : other) *
         (grid.spacing_z / (skin.columns > 1 ? skin.pitch_z : other));
}

double mean_depth(const std::vector<Site>& sites) {
  return std::accumulate(sites.begin(), sites.end(), 0.0,
                         [](double sum, const Site& site) { return sum + site.depth; }) /
         static_cast<double>(sites.size());
}

}  // namespace

void check(const SkinArray& skin, const Material& material, const SkinProblemOptions& options) {
  check(skin, material);
  require(options.components == 1 || options.components == 3,
          "components must be 1 (normal) or 3 (normal, tangential_y, tangential_z)");
  const std::vector<Channel> all = channels(skin);
  check_common_options(options.smoothing_length.value_or(0.0), options.tangential_weight,
                       options.channel_rms, all, options.dead_taxels, taxel_count(skin));
  for (const Channel& channel : all)
    for (std::size_t u = 0; u < options.components; ++u)
      check_quantity(channel.quantity, skin_tractions[u], material);
}

LinearProblem problem_without_kernel(const SkinArray& skin, const Material& material,
                                     const SkinProblemOptions& options) {
  check(skin, material, options);
  LinearProblem problem{.sites = sites(skin),
                        .taxels = taxel_count(skin),
                        .components = options.components,
                        .grid = grid_of(skin, options.grid),
                        .tangential_weight = options.tangential_weight,
                        .unknown_offsets = options.unknown_offsets};
  if (skin.curved)
    problem.cells = std::make_shared<const std::vector<SurfaceCell>>(cells_of(skin, problem.grid));
  problem.measure = area_ratio(skin, problem.grid);
  problem.smoothing_length = options.smoothing_length.value_or(mean_depth(problem.sites));
  problem.weights = row_weights(problem.sites, options.dead_taxels, options.channel_rms);
  require_measured(problem.sites, options.dead_taxels, options.unknown_offsets);
  return problem;
}

LinearProblem make_problem(const SkinArray& skin, const Material& material,
                           const SkinProblemOptions& options) {
  LinearProblem problem = problem_without_kernel(skin, material, options);
  const std::size_t rows = problem.sites.size();
  const std::size_t columns = problem.components * problem.grid.count();
  problem.kernel = make_kernel(rows, columns);
  if (skin.curved)
    CurvedReadings(skin, material).add_kernel(problem);
  else
    add_flat_kernel(skin, material, problem);
  require(
      std::all_of(problem.kernel.values.begin(), problem.kernel.values.end(),
                  [](double entry) { return std::isfinite(entry); }),
      "lengths, moduli or noise are of a size at which readings overflow a double: choose other "
      "units");
  finish_kernel(problem);
  return problem;
}

bool is_measured(const SkinArray& skin, std::span<const std::size_t> dead_taxels,
                 bool unknown_offsets) {
  return is_measured(sites(skin), dead_taxels, unknown_offsets);
}

}  // namespace tactile_net
