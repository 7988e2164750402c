/// @file
/// Plans made by hand, without the planner: every structure, precision and number of blocks.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "tactile_net/realtime/estimator_plan.hpp"
#include "tests/realtime/skin_plans.hpp"

namespace tactile_net {

struct PlanShape {
  std::size_t count = 13;
  std::size_t channels = 1;
  std::size_t unknowns = 1;
  Structure structure = Structure::reflections_low_rank;
  Precision precision = Precision::float64;
  bool diagnostics = true;
};

/// Random factors between -1 and 1; a prediction that smooths, with eigenvalues in (0, 0.8).
inline EstimatorPlan made_plan(const PlanShape& shape, unsigned seed = 1) {
  std::mt19937 generator(seed);
  EstimatorPlan plan;
  plan.label = "made by hand";
  plan.count = shape.count;
  plan.channels = shape.channels;
  plan.unknowns = shape.unknowns;
  plan.values = plan.count;
  plan.spacing = 0.25;
  set_units(plan);
  make_reconstruction(
      plan, shape.structure, shape.precision,
      [&] { return static_cast<double>(generator()) / 0x1p31 - 1.0; },
      [&](ProductPlan& product) {
        std::vector<std::int8_t> signs(std::max(shape.unknowns, shape.channels), -1);
        signs[0] = 1;
        const auto first = [&](std::size_t blocks) {
          return std::vector<std::int8_t>(signs.begin(),
                                          signs.begin() + static_cast<std::ptrdiff_t>(blocks));
        };
        product.row_grid = line_blocks(plan.values, first(shape.unknowns));
        product.column_grid = line_blocks(plan.count, first(shape.channels));
      });
  if (shape.diagnostics) add_smoothing(plan);
  return plan;
}

/// y = A x by the words of product_plan.hpp, in long double.
inline std::vector<double> by_definition(const ProductPlan& plan, const std::vector<double>& x) {
  if (has_reflections(plan.structure)) return by_reflections(plan, x);
  std::vector<long double> y(x.begin(), x.end());
  for (const Factor& factor : plan.factors) {
    std::vector<long double> product(factor.rows, 0.0L);
    for (std::size_t i = 0; i < factor.rows; ++i)
      for (std::size_t j = 0; j < factor.columns; ++j)
        product[i] += static_cast<long double>(factor.values[i * factor.columns + j]) * y[j];
    y = product;
  }
  std::vector<double> result;
  for (const long double value : y)
    result.push_back(static_cast<double>(value * static_cast<long double>(plan.scale)));
  return result;
}

}  // namespace tactile_net
