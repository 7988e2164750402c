/// @file
/// Plans of skins made by hand, and their products by the words of product_plan.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "tactile_net/realtime/estimator_plan.hpp"

namespace tactile_net {

struct SkinPlanShape {
  std::size_t rows = 5;  ///< of taxels
  std::size_t columns = 4;
  std::size_t margin = 1;  ///< of cells around them
  std::size_t unknowns = 3;
  Structure structure = Structure::reflections;
  Precision precision = Precision::float64;
  bool exchanged = false;  ///< y and z; rows = columns
  bool diagnostics = true;
  std::size_t dead = 0;  ///< taxels that the plan fills in
};

/// p, q_y, q_z; or stress_x, shear_xy, shear_xz.
inline GridBlocks grid_blocks(std::size_t rows, std::size_t columns, std::size_t blocks,
                              bool exchanged) {
  GridBlocks grid{.rows = rows, .columns = columns};
  grid.signs_y = blocks == 1 ? std::vector<std::int8_t>{1} : std::vector<std::int8_t>{1, -1, 1};
  grid.signs_z = blocks == 1 ? std::vector<std::int8_t>{1} : std::vector<std::int8_t>{1, 1, -1};
  if (exchanged)
    grid.partners =
        blocks == 1 ? std::vector<std::uint32_t>{0} : std::vector<std::uint32_t>{0, 2, 1};
  return grid;
}

/// What plans made by hand have in common; the label and the shape are there before.
inline void set_units(EstimatorPlan& plan) {
  plan.alpha = 1e-3;
  plan.accuracy = 1e-7;
  plan.friction_coefficient = 0.5;
  plan.ranges.assign(plan.channels, {-1e9, 1e9});
}

/// Constraints with P = 1: S = 1 / 2 of every traction, so the minimum is the point of the cones
/// next to the linear frame, cell by cell, and what is between is its distance. Reflections as
/// those of the tractions, where these have any.
inline void add_cone(EstimatorPlan& plan, std::optional<double> friction_limit) {
  ProductPlan step{.structure = has_reflections(plan.reconstruction.structure)
                                    ? Structure::reflections
                                    : Structure::dense,
                   .precision = Precision::float32,
                   .rows = plan.tractions(),
                   .columns = plan.tractions()};
  const auto add = [&](std::size_t size, const auto& entry) {
    Factor factor{size, size, std::vector<double>(size * size)};
    for (std::size_t i = 0; i < size; ++i) factor.values[i * size + i] = entry(i);
    step.factors.push_back(std::move(factor));
  };
  if (step.structure == Structure::dense) {
    add(step.rows, [](std::size_t) { return 0.5; });
  } else {
    step.row_grid = step.column_grid = plan.reconstruction.row_grid;
    // A sum of k places that goes back to each of them: what is 1/2 of it is 1 / (2 k).
    step.row_grid.partners.clear();
    step.column_grid.partners.clear();
    const std::vector<std::size_t> sizes = class_sizes(step.row_grid);
    for (std::size_t c = 0; c < sizes.size(); ++c) {
      std::vector<double> places;
      const int y = c < 2 ? 1 : -1;
      const int z = c % 2 == 0 ? 1 : -1;
      const GridBlocks& grid = step.row_grid;
      for (std::size_t b = 0; b < grid.signs_y.size(); ++b) {
        const auto half = [](std::size_t count, int parity) {
          return parity > 0 ? count - count / 2 : count / 2;
        };
        const std::size_t rows = half(grid.rows, grid.signs_y[b] * y);
        const std::size_t columns = half(grid.columns, grid.signs_z[b] * z);
        for (std::size_t i = 0; i < rows; ++i)
          for (std::size_t j = 0; j < columns; ++j)
            places.push_back((2 * i + 1 == grid.rows ? 1.0 : 2.0) *
                             (2 * j + 1 == grid.columns ? 1.0 : 2.0));
      }
      add(sizes[c], [&](std::size_t i) { return 0.5 / places[i]; });
    }
  }
  plan.cone = ConePlan{.friction_limit = friction_limit,
                       .steps = 9,
                       .tangential_scale = 2.0,
                       .step = std::move(step),
                       .bound = 2.0,
                       .rounding = 1e-6,
                       .expected = {0.1, 0.2, 0.3}};
}

/// Random factors.
///
/// @param set_grids  (product): the grids of a structure with reflections
inline void make_reconstruction(EstimatorPlan& plan, Structure structure, Precision precision,
                                const auto& random, const auto& set_grids) {
  ProductPlan& product = plan.reconstruction;
  product.structure = structure;
  product.precision = precision;
  product.rows = plan.tractions();
  product.columns = plan.readings();
  product.scale = 0.5;
  std::vector<std::size_t> heights{product.rows};
  std::vector<std::size_t> widths{product.columns};
  if (has_reflections(structure)) {
    set_grids(product);
    heights = class_sizes(product.row_grid);
    widths = class_sizes(product.column_grid);
  }
  const auto add = [&](std::size_t height, std::size_t width) {
    Factor factor{height, width, {}};
    for (std::size_t i = 0; i < height * width; ++i) {
      const double value = random();
      factor.values.push_back(precision == Precision::float32 ? static_cast<float>(value) : value);
    }
    product.factors.push_back(std::move(factor));
  };
  for (std::size_t c = 0; c < heights.size(); ++c) {
    const std::size_t least = std::min(heights[c], widths[c]);
    const std::size_t rank = least == 0 ? 0 : 1 + least / 2;  // 0: a class without places
    if (is_low_rank(structure)) add(rank, widths[c]);
    add(heights[c], is_low_rank(structure) ? rank : widths[c]);
  }
  plan.weights.assign(plan.readings(), 1.0);
}

/// A prediction that smooths, with eigenvalues in (0, 0.8).
inline void add_smoothing(EstimatorPlan& plan) {
  const std::size_t n = plan.readings();
  plan.prediction.emplace();
  plan.prediction->rows = plan.prediction->columns = n;
  Factor smoothing{n, n, {}};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const double distance = std::abs(static_cast<double>(i) - static_cast<double>(j));
      smoothing.values.push_back(0.2 * std::exp2(-distance));  // sums of 3 at most
      if (i == j) plan.leverages.push_back(smoothing.values.back());
    }
  plan.prediction->factors = {std::move(smoothing)};
}

/// Random factors between -1 and 1; with diagnostics a prediction that smooths.
inline EstimatorPlan made_skin_plan(const SkinPlanShape& shape, unsigned seed = 1) {
  std::mt19937 generator(seed);
  const auto random = [&] { return static_cast<double>(generator()) / 0x1p31 - 1.0; };
  EstimatorPlan plan;
  plan.label = "skin made by hand";
  plan.count = shape.rows * shape.columns;
  plan.channels = shape.unknowns;
  plan.unknowns = shape.unknowns;
  PlanCells& cells = plan.cells.emplace();
  cells = {.rows = shape.rows + 2 * shape.margin,
           .columns = shape.columns + 2 * shape.margin,
           .spacing_y = 0.5,
           .spacing_z = 0.25,
           .centre_y = 0.125,
           .centre_z = -1.0};
  plan.values = cells.rows * cells.columns;
  plan.spacing = std::sqrt(cells.area());
  set_units(plan);
  plan.unjudged = {0};
  make_reconstruction(plan, shape.structure, shape.precision, random, [&](ProductPlan& product) {
    product.row_grid = grid_blocks(cells.rows, cells.columns, plan.unknowns, shape.exchanged);
    product.column_grid = grid_blocks(shape.rows, shape.columns, plan.channels, shape.exchanged);
  });
  const std::size_t n = plan.readings();
  if (shape.dead > 0) {
    Factor& fill = plan.fill.emplace();
    fill.columns = n;
    for (std::size_t i = 0; i < n; ++i)
      if (i % plan.count > 0 && i % plan.count <= shape.dead) {
        plan.weights[i] = 0.0;
        ++fill.rows;
      }
    for (std::size_t i = 0; i < fill.rows * n; ++i)
      fill.values.push_back(plan.weights[i % n] > 0.0 ? 0.1 * random() : 0.0);
  }
  if (shape.diagnostics) add_smoothing(plan);
  return plan;
}

/// A matrix of a class's plain sums, a row each: by projection of every place on what the
/// reflections, and the exchange, make of it. Exchanged (-, +) is left out: it follows.
inline std::vector<std::vector<long double>> class_sums(const GridBlocks& grid, std::size_t which,
                                                        bool other = false) {
  const bool exchanged = !grid.partners.empty();
  // Class in the order of the plan: signs of y and z, and of the exchange (0: none).
  struct Kind {
    int y, z, exchange;
  };
  const std::vector<Kind> kinds =
      exchanged ? std::vector<Kind>{{1, 1, 1}, {1, 1, -1}, {1, -1, 0}, {-1, -1, 1}, {-1, -1, -1}}
                : std::vector<Kind>{{1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}};
  const Kind kind = kinds[which];
  const std::size_t cells = grid.rows * grid.columns;
  std::vector<std::vector<long double>> sums;
  std::vector<std::vector<long double>> alone;
  const auto exchange = [&](std::size_t at) {
    const std::size_t cell = at % cells;
    return grid.partners[at / cells] * cells + cell % grid.columns * grid.columns +
           cell / grid.columns;
  };
  for (std::size_t b = 0; b < grid.signs_y.size(); ++b)
    for (std::size_t i = 0; i < (grid.rows + 1) / 2; ++i)
      for (std::size_t j = 0; j < (grid.columns + 1) / 2; ++j) {
        std::vector<long double> row(grid.size(), 0.0L);
        const std::size_t back_i = grid.rows - 1 - i;
        const std::size_t back_j = grid.columns - 1 - j;
        const int y = grid.signs_y[b] * kind.y;
        const int z = grid.signs_z[b] * kind.z;
        if ((i == back_i && y < 0) || (j == back_j && z < 0)) continue;
        const auto at = [&](std::size_t m, std::size_t n) -> long double& {
          return row[b * cells + m * grid.columns + n];
        };
        at(i, j) = 1.0L;
        at(i, back_j) = z;
        at(back_i, j) = y;
        at(back_i, back_j) = y * z;
        if (kind.exchange == 0) {
          if (other) {  // (-, +), exchanged
            std::vector<long double> turned(row.size(), 0.0L);
            for (std::size_t k = 0; k < row.size(); ++k) turned[exchange(k)] = row[k];
            row = turned;
          }
          sums.push_back(std::move(row));
          continue;
        }
        const std::size_t own = b * cells + i * grid.columns + j;
        if (exchange(own) < own) continue;
        std::vector<long double> both = row;
        for (std::size_t k = 0; k < row.size(); ++k) both[exchange(k)] += kind.exchange * row[k];
        if (exchange(own) != own)
          sums.push_back(std::move(both));
        else if (kind.exchange > 0)
          alone.push_back(std::move(row));
      }
  sums.insert(sums.end(), alone.begin(), alone.end());
  return sums;
}

/// y = A x by definition, in long double.
inline std::vector<double> by_reflections(const ProductPlan& plan, const std::vector<double>& x) {
  using Vector = std::vector<long double>;
  const auto times = [](const Factor& factor, const Vector& in) {
    Vector out(factor.rows, 0.0L);
    for (std::size_t i = 0; i < factor.rows; ++i)
      for (std::size_t j = 0; j < factor.columns; ++j)
        out[i] += static_cast<long double>(factor.values[i * factor.columns + j]) * in[j];
    return out;
  };
  Vector y(plan.rows, 0.0L);
  const std::size_t classes = class_sizes(plan.row_grid).size();
  const std::size_t per_class = is_low_rank(plan.structure) ? 2 : 1;
  for (std::size_t c = 0; c < classes; ++c)
    for (const bool other : {false, true}) {
      if (other && !(classes == 5 && c == 2)) continue;
      Vector in;
      for (const auto& row : class_sums(plan.column_grid, c, other)) {
        long double sum = 0.0L;
        for (std::size_t k = 0; k < row.size(); ++k) sum += row[k] * x[k];
        in.push_back(sum);
      }
      for (std::size_t k = 0; k < per_class; ++k) in = times(plan.factors[c * per_class + k], in);
      const auto rows = class_sums(plan.row_grid, c, other);
      for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t k = 0; k < y.size(); ++k) y[k] += rows[i][k] * in[i];
    }
  std::vector<double> result;
  for (const long double value : y)
    result.push_back(static_cast<double>(value * static_cast<long double>(plan.scale)));
  return result;
}

}  // namespace tactile_net
