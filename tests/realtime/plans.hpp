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
  plan.alpha = 1e-3;
  plan.accuracy = 1e-7;
  plan.friction_coefficient = 0.5;
  plan.ranges.assign(shape.channels, {-1e9, 1e9});

  ProductPlan& product = plan.reconstruction;
  product.structure = shape.structure;
  product.precision = shape.precision;
  product.rows = plan.tractions();
  product.columns = plan.readings();
  product.scale = 0.5;
  std::vector<std::size_t> heights{product.rows};
  std::vector<std::size_t> widths{product.columns};
  if (has_reflections(shape.structure)) {
    std::vector<std::int8_t> signs(std::max(shape.unknowns, shape.channels), -1);
    signs[0] = 1;
    const auto first = [&](std::size_t blocks) {
      return std::vector<std::int8_t>(signs.begin(),
                                      signs.begin() + static_cast<std::ptrdiff_t>(blocks));
    };
    product.row_grid = line_blocks(plan.values, first(shape.unknowns));
    product.column_grid = line_blocks(plan.count, first(shape.channels));
    heights = class_sizes(product.row_grid);
    widths = class_sizes(product.column_grid);
  }
  const auto add = [&](std::size_t height, std::size_t width) {
    Factor factor{height, width, {}};
    for (std::size_t i = 0; i < height * width; ++i) {
      const double value = static_cast<double>(generator()) / 0x1p31 - 1.0;
      factor.values.push_back(shape.precision == Precision::float32 ? static_cast<float>(value)
                                                                    : value);
    }
    product.factors.push_back(std::move(factor));
  };
  for (std::size_t c = 0; c < heights.size(); ++c) {
    const std::size_t least = std::min(heights[c], widths[c]);
    const std::size_t rank = least == 0 ? 0 : 1 + least / 2;  // 0: a class without places
    if (is_low_rank(shape.structure)) add(rank, widths[c]);
    add(heights[c], is_low_rank(shape.structure) ? rank : widths[c]);
  }

  plan.weights.assign(plan.readings(), 1.0);
  if (!shape.diagnostics) return plan;
  plan.prediction.emplace();
  plan.prediction->rows = plan.prediction->columns = plan.readings();
  Factor smoothing{plan.readings(), plan.readings(), {}};
  for (std::size_t i = 0; i < plan.readings(); ++i)
    for (std::size_t j = 0; j < plan.readings(); ++j) {
      const double distance = std::abs(static_cast<double>(i) - static_cast<double>(j));
      smoothing.values.push_back(0.2 * std::exp2(-distance));  // sums of 3 at most
      if (i == j) plan.leverages.push_back(smoothing.values.back());
    }
  plan.prediction->factors = {std::move(smoothing)};
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
