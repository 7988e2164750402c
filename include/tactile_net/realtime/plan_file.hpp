/// @file
/// A plan on disk: planned once, at a desk; loaded by the controller, without the solver.
///
/// Layout, all little-endian: the 8 bytes "TNETPLAN", version (u32), length of the payload (u64),
/// payload, CRC-64/XZ of everything before it (u64). Doubles are stored bit by bit, factors of
/// float32 plans as floats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "tactile_net/realtime/estimator_plan.hpp"

namespace tactile_net {

inline constexpr std::uint32_t plan_version = 1;

/// @throw std::invalid_argument  `check(plan)` does
[[nodiscard]] std::vector<std::byte> encode_plan(const EstimatorPlan& plan);

/// Any bytes at all are safe to pass.
/// @throw std::runtime_error  the bytes are no plan, truncated, corrupted, of another version, or
///                            describe a plan that `check` refuses; the text says which
[[nodiscard]] EstimatorPlan decode_plan(std::span<const std::byte> bytes);

/// For start-up: the only place here that touches a file, in the caller's own object code.
/// @throw std::runtime_error  as `decode_plan`, or the file cannot be read; names the file
[[nodiscard]] inline EstimatorPlan load_plan(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be opened");
  std::ostringstream content;
  if (file.peek() != std::ifstream::traits_type::eof()) content << file.rdbuf();
  if (file.bad() || !content) throw std::runtime_error(path.string() + ": cannot be read");
  try {
    return decode_plan(std::as_bytes(std::span(content.view())));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace tactile_net
