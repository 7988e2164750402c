#include "tactile_net/skin/problem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/weighting.hpp"
#include "numeric/eigen.hpp"
#include "numeric/require.hpp"
#include "skin/cell_kernel.hpp"
#include "skin/problem_parts.hpp"
#include "tactile_net/skin/stabiliser.hpp"

namespace tactile_net {
namespace {

/// Of taxels on the grid's lattice.
void add_lattice(const SkinArray& skin, CellKernels& kernels, SkinProblem& problem) {
  const SkinGrid& grid = problem.grid;
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
void add_places(CellKernels& kernels, SkinProblem& problem) {
  const SkinGrid& grid = problem.grid;
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
double kernel_error(CellKernels& kernels, const SkinProblem& problem) {
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

/// A cell's area over that of a taxel, length by length: an area may be too large, or too small,
/// for a number. A direction in which there is one taxel has the other's pitch, or the depth.
double area_ratio(const SkinArray& skin, const SkinGrid& grid) {
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
  require(!options.smoothing_length ||
              (*options.smoothing_length >= 0.0 && std::isfinite(*options.smoothing_length)),
          "smoothing_length must be >= 0 and finite");
  require(options.tangential_weight > 0.0 && std::isfinite(options.tangential_weight),
          "tangential_weight must be > 0 and finite");
  const std::vector<Channel> all = channels(skin);
  if (options.channel_rms.empty()) {
    const auto kind = [](const Channel& channel) { return traits(channel.quantity).kind; };
    require(std::all_of(all.begin(), all.end(),
                        [&](const Channel& one) { return kind(one) == kind(all.front()); }),
            "stresses, strains and displacements read together need channel_rms: the sum of their "
            "squares has no unit");
  } else {
    require(options.channel_rms.size() == all.size(), "channel_rms needs one value per channel");
  }
  for (const double rms : options.channel_rms)
    require(rms > 0.0 && std::isfinite(rms), "channel_rms must be > 0 and finite");
  for (const std::size_t taxel : options.dead_taxels)
    require(taxel < taxel_count(skin), "dead taxel " + std::to_string(taxel) + " is not < " +
                                           std::to_string(taxel_count(skin)));
  for (const Channel& channel : all)
    for (std::size_t u = 0; u < options.components; ++u)
      check_quantity(channel.quantity, skin_tractions[u], material);
}

SkinProblem problem_without_kernel(const SkinArray& skin, const Material& material,
                                   const SkinProblemOptions& options) {
  check(skin, material, options);
  SkinProblem problem{.sites = sites(skin),
                      .taxels = taxel_count(skin),
                      .components = options.components,
                      .grid = grid_of(skin, options.grid),
                      .tangential_weight = options.tangential_weight,
                      .unknown_offsets = options.unknown_offsets};
  problem.area = area_ratio(skin, problem.grid);
  problem.smoothing_length = options.smoothing_length.value_or(mean_depth(problem.sites));
  std::vector<bool> dead(problem.taxels);
  for (const std::size_t taxel : options.dead_taxels) dead[taxel] = true;
  for (const Site& site : problem.sites)
    problem.weights.push_back(dead[site.taxel] ? 0.0
                              : options.channel_rms.empty()
                                  ? 1.0
                                  : 1.0 / options.channel_rms[site.channel]);
  require(is_measured(skin, options.dead_taxels, options.unknown_offsets),
          options.unknown_offsets
              ? "unknown offsets take one reading a channel: two living taxels are needed"
              : "every taxel is dead: nothing is measured");
  return problem;
}

SkinProblem make_problem(const SkinArray& skin, const Material& material,
                         const SkinProblemOptions& options) {
  SkinProblem problem = problem_without_kernel(skin, material, options);
  const std::size_t rows = problem.sites.size();
  const std::size_t columns = problem.components * problem.grid.count();
  problem.kernel = make_kernel(rows, columns);
  CellKernels kernels(material, problem.grid);
  if (is_lattice(skin, problem.grid))
    add_lattice(skin, kernels, problem);
  else
    add_places(kernels, problem);
  require(
      std::all_of(problem.kernel.values.begin(), problem.kernel.values.end(),
                  [](double entry) { return std::isfinite(entry); }),
      "lengths, moduli or noise are of a size at which readings overflow a double: choose other "
      "units");
  problem.kernel_error = kernel_error(kernels, problem);
  take_offsets_out(problem);
  drop_kernel_of_rounding(problem);
  return problem;
}

bool is_measured(const SkinArray& skin, std::span<const std::size_t> dead_taxels,
                 bool unknown_offsets) {
  std::vector<bool> dead(taxel_count(skin));
  for (const std::size_t taxel : dead_taxels) dead[taxel] = true;
  std::vector<std::size_t> living(channel_count(skin));
  for (const Site& site : sites(skin))
    if (!dead[site.taxel]) ++living[site.channel];
  return *std::max_element(living.begin(), living.end()) >= (unknown_offsets ? 2 : 1);
}

void leave_out(SkinProblem& problem, std::span<const std::size_t> taxels) {
  leave_taxels_out(problem, taxels);
}

std::vector<double> weighted(const SkinProblem& problem, std::span<const double> readings) {
  check_size(readings, problem.weights.size());
  const Eigen::VectorXd rows = Weighting(problem)(readings);
  return {rows.begin(), rows.end()};
}

std::vector<double> offsets(const SkinProblem& problem, std::span<const double> readings,
                            std::span<const double> tractions) {
  return offsets_of(problem, readings, tractions);
}

std::size_t independent_readings(const SkinProblem& problem) {
  return static_cast<std::size_t>(Weighting(problem).rows());
}

Matrix normal_matrix(const SkinProblem& problem, double alpha) {
  const auto kernel = as_eigen(problem.kernel);
  const Matrix stabiliser = stabiliser_matrix(problem, alpha);
  RowMajor p = as_eigen(stabiliser);
  p.selfadjointView<Eigen::Upper>().rankUpdate(kernel.transpose());
  p.triangularView<Eigen::StrictlyLower>() = p.transpose();
  return from_eigen(p);
}

std::vector<double> normal_right_side(const SkinProblem& problem,
                                      std::span<const double> readings) {
  const std::vector<double> rows = weighted(problem, readings);
  const Eigen::VectorXd sums = as_eigen(problem.kernel).transpose() * as_eigen(std::span(rows));
  return {sums.begin(), sums.end()};
}

}  // namespace tactile_net
