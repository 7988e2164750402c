/// @file
/// A line's plan as the versions before 9 wrote it, by another hand.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "tactile_net/realtime/estimator_plan.hpp"
#include "tests/realtime/plan_bytes.hpp"

namespace tactile_net {

/// Where older versions say parity: structures 2 and 3, the signs of blocks in place of grids, and
/// the factors of two classes.
///
/// @param version  1 to 5, or 8: those of lines; what it has no place for is left out
inline std::vector<std::byte> older_bytes(const EstimatorPlan& plan, unsigned version) {
  std::vector<std::byte> bytes;
  const auto put = [&](std::uint64_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
  };
  const auto number = [&](double value) { put(std::bit_cast<std::uint64_t>(value), 8); };
  const auto numbers = [&](const std::vector<double>& values) {
    put(values.size(), 8);
    for (const double value : values) number(value);
  };
  const auto indices = [&](const std::vector<std::uint32_t>& values) {
    put(values.size(), 8);
    for (const std::uint32_t value : values) put(value, 4);
  };
  const auto text = [&](std::string_view value) {
    for (const char letter : value) put(static_cast<unsigned char>(letter), 1);
  };
  const auto product = [&](const ProductPlan& one) {
    const bool classes = has_reflections(one.structure);
    const std::uint64_t structure = one.structure == Structure::reflections ? 2
                                    : one.structure == Structure::reflections_low_rank
                                        ? 3
                                        : static_cast<std::uint64_t>(one.structure);
    put(structure, 1);
    put(static_cast<std::uint64_t>(one.precision), 1);
    put(one.rows, 8);
    put(one.columns, 8);
    number(one.scale);
    for (const GridBlocks* blocks : {&one.row_grid, &one.column_grid}) {
      put(blocks->signs_z.size(), 8);
      for (const std::int8_t sign : blocks->signs_z) put(static_cast<std::uint8_t>(sign), 1);
    }
    const std::size_t factors = classes ? one.factors.size() / 2 : one.factors.size();
    put(factors, 8);
    for (std::size_t i = 0; i < factors; ++i) {
      put(one.factors[i].rows, 8);
      put(one.factors[i].columns, 8);
      for (const double value : one.factors[i].values)
        if (one.precision == Precision::float64)
          number(value);
        else
          put(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
    }
    if (one.structure != Structure::fft) return;
    put(one.transform_size, 8);
    numbers(one.spectra);
  };

  text("TNETPLAN");
  put(version, 4);
  put(0, 8);  // the length
  put(plan.label.size(), 8);
  text(plan.label);
  for (const std::size_t size : {plan.count, plan.channels, plan.unknowns}) put(size, 8);
  for (const double value : {plan.spacing, plan.alpha, plan.accuracy, plan.error_bound})
    number(value);
  product(plan.reconstruction);
  put(plan.prediction ? 1 : 0, 1);
  if (plan.prediction) product(*plan.prediction);
  numbers(plan.weights);
  numbers(plan.leverages);
  number(plan.noise_rms);
  number(plan.outlier_limit);
  put(plan.friction_coefficient ? 1 : 0, 1);
  if (plan.friction_coefficient) number(*plan.friction_coefficient);
  put(plan.ranges.size(), 8);
  for (const ReadingRange& range : plan.ranges) {
    number(range.lowest);
    number(range.highest);
  }
  if (version >= 2) numbers(plan.baseline);
  if (version >= 3) {
    put(plan.values, 8);
    number(plan.centre);
  }
  if (version >= 4)
    for (const double value : {plan.residual_limit, plan.traction_limit, plan.force_deviation})
      number(value);
  if (version >= 5) indices(plan.taxels);
  if (version >= 8) {
    put(0, 1);  // no cells
    indices(plan.border);
    put(plan.known_offsets ? 1 : 0, 1);
  }
  bytes.resize(bytes.size() + 8);  // the checksum
  sign(bytes);
  return bytes;
}

}  // namespace tactile_net
