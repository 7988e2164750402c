/// @file
/// Plans made by hand, without the planner: every structure, precision and number of blocks.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tactile_net/realtime/estimator_plan.hpp"

namespace tactile_net {

struct PlanShape {
  std::size_t count = 13;
  std::size_t channels = 1;
  std::size_t unknowns = 1;
  Structure structure = Structure::parity_low_rank;
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
  for (std::size_t i = 0; i < shape.unknowns; ++i) product.row_signs.push_back(i == 0 ? 1 : -1);
  for (std::size_t i = 0; i < shape.channels; ++i) product.column_signs.push_back(i == 0 ? 1 : -1);
  ClassSizes rows{product.rows, 0};
  ClassSizes columns{product.columns, 0};
  if (has_parity(shape.structure)) {
    rows = class_sizes(product.row_signs, product.rows);
    columns = class_sizes(product.column_signs, product.columns);
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
  const auto add_class = [&](std::size_t height, std::size_t width) {
    const std::size_t rank = 1 + std::min(height, width) / 2;
    if (is_low_rank(shape.structure)) add(rank, width);
    add(height, is_low_rank(shape.structure) ? rank : width);
  };
  add_class(rows.even, columns.even);
  if (has_parity(shape.structure)) add_class(rows.odd, columns.odd);

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

/// y = A x by the words of product_plan.hpp, pair by pair, in long double.
inline std::vector<double> by_definition(const ProductPlan& plan, const std::vector<double>& x) {
  using Vector = std::vector<long double>;
  const bool parity = has_parity(plan.structure);
  // Whether block b belongs to class c by its sums.
  const auto sums = [](int sign, int c) { return (sign > 0) == (c == 0); };
  const auto times = [](const Factor& factor, const Vector& in) {
    Vector out(factor.rows, 0.0L);
    for (std::size_t i = 0; i < factor.rows; ++i)
      for (std::size_t j = 0; j < factor.columns; ++j)
        out[i] += static_cast<long double>(factor.values[i * factor.columns + j]) * in[j];
    return out;
  };
  Vector y(plan.rows, 0.0L);
  std::size_t next = 0;
  for (int c = 0; c < (parity ? 2 : 1); ++c) {
    Vector in(x.begin(), x.end());
    if (parity) {
      in.clear();
      const std::size_t n = plan.columns / plan.column_signs.size();
      for (std::size_t b = 0; b < plan.column_signs.size(); ++b) {
        const auto at = [&](std::size_t i) { return static_cast<long double>(x[b * n + i]); };
        const bool sum = sums(plan.column_signs[b], c);
        for (std::size_t i = 0; i < n / 2; ++i)
          in.push_back(sum ? at(i) + at(n - 1 - i) : at(i) - at(n - 1 - i));
        if (sum && n % 2 == 1) in.push_back(at(n / 2));
      }
    }
    Vector out = times(plan.factors[next++], in);
    if (is_low_rank(plan.structure)) out = times(plan.factors[next++], out);
    if (!parity) {
      y = out;
      break;
    }
    const std::size_t n = plan.rows / plan.row_signs.size();
    auto value = out.begin();
    for (std::size_t b = 0; b < plan.row_signs.size(); ++b) {
      const bool sum = sums(plan.row_signs[b], c);
      for (std::size_t i = 0; i < n / 2; ++i, ++value) {
        y[b * n + i] += *value;
        y[b * n + n - 1 - i] += sum ? *value : -*value;
      }
      if (sum && n % 2 == 1) y[b * n + n / 2] += *value++;
    }
  }
  std::vector<double> result;
  for (const long double value : y)
    result.push_back(static_cast<double>(value * static_cast<long double>(plan.scale)));
  return result;
}

}  // namespace tactile_net
