/// @file
/// Problems and frames that several tests share.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

struct NamedProblem {
  std::string name;
  LinearProblem problem;
};

/// One and several quantities and depths, weights, a dead taxel, even and odd counts, surfaces,
/// offsets.
inline std::vector<NamedProblem> sample_problems() {
  using enum Quantity;
  const Material material{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
  const auto make = [&](std::size_t count, double pitch, std::vector<double> depths,
                        std::vector<Quantity> reads, const LineProblemOptions& options) {
    return make_problem({count, pitch, std::move(depths), std::move(reads)}, material, options);
  };
  return {
      {"strain", make(81, 0.25, {1.5}, {strain_x}, {.smoothing_length = 1.0})},
      {"stress, even", make(20, 0.5, {1.5}, {stress_x}, {.smoothing_length = 1.5})},
      {"shear", make(21, 0.5, {1.0}, {shear_xy}, {.smoothing_length = 1.0})},
      {"two taxels", make(2, 1.0, {1.0}, {stress_x}, {.smoothing_length = 1.0})},
      {"two depths", make(31, 0.5, {1.0, 2.0}, {stress_x}, {.smoothing_length = 1.0})},
      {"weighted, a dead taxel",
       make(31, 0.5, {1.0}, {stress_x, strain_x},
            {.smoothing_length = 1.0, .channel_rms = {2.0, 0.1}, .dead_taxels = {3}})},
      {"two unknowns",
       make(31, 0.5, {1.0}, {stress_x, shear_xy}, {.unknowns = 2, .smoothing_length = 1.0})},
      {"a finer surface, beyond the ends",
       make(7, 2.0, {1.0}, {stress_x, shear_xy},
            {.unknowns = 2,
             .smoothing_length = 1.0,
             .dead_taxels = {2},
             .surface = {.basis = SurfaceBasis::hats, .spacing = 0.5, .margin = 1.0}})},
      {"a surface beyond the ends, even",
       make(20, 0.5, {1.5}, {stress_x},
            {.smoothing_length = 1.5, .surface = {.basis = SurfaceBasis::hats}})},
      {"two unknowns, the tangential one lighter",
       make(31, 0.5, {1.0}, {stress_x, shear_xy},
            {.unknowns = 2, .smoothing_length = 1.0, .tangential_weight = 0.3})},
      {"a finer surface, the tangential traction heavier",
       make(7, 2.0, {1.0}, {stress_x, shear_xy},
            {.unknowns = 2,
             .smoothing_length = 1.0,
             .tangential_weight = 3.0,
             .surface = {.basis = SurfaceBasis::hats, .spacing = 0.5, .margin = 1.0}})},
      {"two unknowns, two depths, even",
       make(20, 0.5, {1.0, 1.5}, {strain_x}, {.unknowns = 2, .smoothing_length = 1.0})},
      {"offsets, weighted", make(31, 0.5, {1.0}, {stress_x, shear_xy},
                                 {.unknowns = 2,
                                  .smoothing_length = 1.0,
                                  .channel_rms = {2.0, 0.5},
                                  .unknown_offsets = true})},
      {"a finer surface, offsets",
       make(9, 2.0, {1.0}, {stress_x},
            {.smoothing_length = 1.0,
             .dead_taxels = {2},
             .surface = {.basis = SurfaceBasis::hats, .spacing = 0.5, .margin = 1.0},
             .unknown_offsets = true})},
  };
}

/// Those, and skins: of four, two and one classes, a weight, dead taxels, offsets, one row.
inline std::vector<NamedProblem> all_problems() {
  using enum Quantity;
  const Material material{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
  const std::vector<Quantity> reads{stress_x, shear_xy, shear_xz};
  const auto make = [&](std::size_t rows, std::size_t columns, const SkinProblemOptions& options) {
    return make_problem(SkinArray{.rows = rows,
                                  .columns = columns,
                                  .pitch_y = 1.0,
                                  .pitch_z = 1.2,
                                  .depths = {1.5},
                                  .reads = reads},
                        material, options);
  };
  std::vector<NamedProblem> all = sample_problems();
  all.push_back({"a skin, drags heavier", make(3, 4, {.tangential_weight = 2.0})});
  all.push_back({"a skin, a finer surface",
                 make(3, 3, {.smoothing_length = 2.0, .grid = {.spacing = 0.5, .margin = 0.5}})});
  all.push_back({"a skin's dead ends", make(4, 3, {.dead_taxels = {0, 2}})});
  all.push_back(
      {"a skin, weighted, a dead taxel, offsets",
       make(3, 3, {.channel_rms = {2.0, 1.0, 0.5}, .dead_taxels = {2}, .unknown_offsets = true})});
  all.push_back({"one row of a skin", make(1, 5, {})});
  return all;
}

/// |L f|^2 as linear_problem.hpp has it, term by term: of f^2 + l^2 |grad f|^2 the integral.
inline double smoothness(const LinearProblem& problem, const std::vector<double>& f) {
  const SurfaceGrid& grid = problem.grid;
  const auto squared = [&](double difference, double spacing) {
    return std::pow(problem.smoothing_length / spacing * difference, 2);
  };
  double all = 0.0;
  for (std::size_t j = 0; j < f.size(); ++j) {
    const std::size_t row = j % grid.count() / grid.columns;
    const std::size_t column = j % grid.columns;
    double sum = f[j] * f[j];
    if (row + 1 < grid.rows) sum += squared(f[j + grid.columns] - f[j], grid.spacing_y);
    if (column + 1 < grid.columns) sum += squared(f[j + 1] - f[j], grid.spacing_z);
    // Hats fall to 0 beyond both ends.
    const bool ends = row == 0 || row + 1 == grid.rows;
    if (ends && grid.boundary_y == Boundary::zero_beyond) sum += squared(f[j], grid.spacing_y);
    all += j < grid.count() ? sum : std::pow(problem.tangential_weight, 2) * sum;
  }
  return problem.measure * all;
}

/// |W (K f - g)|^2 + alpha |L f|^2, term by term.
inline double functional_of(const LinearProblem& problem, double alpha,
                            const std::vector<double>& readings, const std::vector<double>& f) {
  double misfit = 0.0;
  for (std::size_t i = 0; i < problem.kernel.rows; ++i) {
    double residual = -problem.weights[i] * readings[i];
    for (std::size_t j = 0; j < f.size(); ++j) residual += problem.kernel(i, j) * f[j];
    misfit += residual * residual;
  }
  return misfit + alpha * smoothness(problem, f);
}

/// Readings between -1 and 1; equal seeds give equal readings.
inline std::vector<double> random_values(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<double> values(count);
  for (double& value : values) value = 2.0 * static_cast<double>(generator()) / 4294967295.0 - 1.0;
  return values;
}

}  // namespace tactile_net
