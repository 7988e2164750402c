#include "skin/large/band_probes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numeric/split_mix.hpp"
#include "skin/large/system.hpp"

namespace tactile_net {
namespace {

/// Smoothing lengths between the cells of a probe, at least: correlations are then some 1e-3.
constexpr double apart = 8.0;
constexpr double residual = 1e-5;  // of a solve; deviations are compared to 1e-3

std::size_t cells_apart(const LinearProblem& problem) {
  const double finest = std::min(problem.grid.spacing_y, problem.grid.spacing_z);
  return static_cast<std::size_t>(std::ceil(apart * problem.smoothing_length / finest));
}

/// Evenly from the first cell to the last one.
std::vector<std::size_t> from_end_to_end(std::size_t cells, std::size_t least) {
  const std::size_t gaps = (cells - 1) / least;
  std::vector<std::size_t> at{0};
  for (std::size_t i = 1; i <= gaps; ++i) at.push_back(i * (cells - 1) / gaps);
  return at;
}

/// In the middle between those.
std::vector<std::size_t> between(const std::vector<std::size_t>& ends, std::size_t cells) {
  if (ends.size() == 1) return {cells / 2};
  std::vector<std::size_t> at;
  for (std::size_t i = 1; i < ends.size(); ++i) at.push_back((ends[i - 1] + ends[i]) / 2);
  return at;
}

/// Each component at every third of them.
BandProbe crossing(const std::vector<std::size_t>& rows, const std::vector<std::size_t>& columns,
                   const LinearProblem& problem) {
  BandProbe probe;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j)
      probe.tractions.push_back((i + j) % problem.components * problem.grid.count() +
                                rows[i] * problem.grid.columns + columns[j]);
  return probe;
}

BandProbe beside_dead(const LinearProblem& problem, std::size_t least) {
  const SurfaceGrid& grid = problem.grid;
  BandProbe probe;
  std::vector<std::pair<std::size_t, std::size_t>> taken;
  for (std::size_t i = 0; i < problem.sites.size(); ++i) {
    if (problem.weights[i] != 0.0) continue;
    const Site& site = problem.sites[i];
    const auto nearest = [](double at, double first, double spacing, std::size_t cells) {
      const double cell = std::round((at - first) / spacing);
      return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(cells - 1)));
    };
    // Every other one beside it.
    const std::size_t step = taken.size() % 2;
    const std::size_t row = nearest(site.y, grid.y(0), grid.spacing_y, grid.rows);
    const std::size_t column =
        std::min(nearest(site.z, grid.z(0), grid.spacing_z, grid.columns) + step, grid.columns - 1);
    const auto far = [&](const std::pair<std::size_t, std::size_t>& other) {
      const auto [least_row, most_row] = std::minmax(row, other.first);
      const auto [least_column, most_column] = std::minmax(column, other.second);
      return most_row - least_row >= least || most_column - least_column >= least;
    };
    if (!std::all_of(taken.begin(), taken.end(), far)) continue;
    probe.tractions.push_back(taken.size() % problem.components * grid.count() +
                              row * grid.columns + column);
    taken.emplace_back(row, column);
  }
  return probe;
}

}  // namespace

std::vector<BandProbe> band_probes(const LinearProblem& problem) {
  const SurfaceGrid& grid = problem.grid;
  const std::size_t least = cells_apart(problem);
  const std::vector<std::size_t> rows = from_end_to_end(grid.rows, least);
  const std::vector<std::size_t> columns = from_end_to_end(grid.columns, least);
  std::vector<BandProbe> all{
      crossing(rows, columns, problem),
      crossing(between(rows, grid.rows), between(columns, grid.columns), problem)};
  if (BandProbe dead = beside_dead(problem, least); !dead.tractions.empty())
    all.push_back(std::move(dead));
  return all;
}

std::vector<double> probed_deviations(LargeSkinTikhonov& solver, double prior_alpha,
                                      const BandProbe& probe) {
  LargeSkinSystem& system = *solver.system();
  std::vector<double> signs(system.tractions());
  for (std::size_t i = 0; i < probe.tractions.size(); ++i)
    signs[probe.tractions[i]] = random_sign(i * split_mix_step);
  // C = P^-1 (K'W^2 K + alpha^2 / prior_alpha L'L) P^-1
  //   = P^-1 + (alpha / prior_alpha - 1) P^-1 alpha L'L P^-1.
  std::vector<double> image = solver.solve_normal(signs, residual);
  const double more = solver.alpha() / prior_alpha - 1.0;
  if (more != 0.0) {
    std::vector<double> stacked = solver.stacked_product(image);
    std::fill_n(stacked.begin(), system.readings(), 0.0);
    std::vector<double> smoothed(system.tractions());
    system.apply_transposed(solver.alpha(), stacked, smoothed);
    const std::vector<double> again = solver.solve_normal(smoothed, residual);
    for (std::size_t i = 0; i < image.size(); ++i) image[i] += more * again[i];
  }
  std::vector<double> deviations;
  for (const std::size_t traction : probe.tractions)
    deviations.push_back(std::sqrt(std::max(signs[traction] * image[traction], 0.0)));
  return deviations;
}

}  // namespace tactile_net
