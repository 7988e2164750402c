/// @file
/// A plan as bytes: planned once, at a desk; loaded by the controller (load_plan.hpp), without the
/// solver.
///
/// Layout, all little-endian: the 8 bytes "TNETPLAN", version (u32), length of the payload (u64),
/// payload, CRC-64/XZ of everything before it (u64). Doubles are stored bit by bit, factors of
/// float32 plans as floats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tactile_net/realtime/estimator_plan.hpp"

namespace tactile_net {

/// Version of a plan's file, by what it added. A plan is written as the first version that can hold
/// it; all versions are read.
enum class PlanVersion : std::uint32_t {
  readings = 1,  ///< tractions at the taxels, from readings
  baseline = 2,  ///< a baseline
  surface = 3,   ///< tractions at places of their own
  doubts = 4,    ///< limits by which a frame is doubted
  taxels = 5,    ///< taxels that do not all read the same
  skin = 6,      ///< tractions of a skin's cells
  windows = 7,   ///< deviations of sums over windows of cells
  border = 8,    ///< the border beyond which nothing is seen, and whether offsets are known
  /// Reflections of lines, and what their dead taxels are taken to read, which comes last where
  /// there is any. Before, structures 2 and 3 stood for the reflections, and the signs of blocks
  /// for their grids of one row.
  lines = 9,
  cone = 10,  ///< constraints that frames obey, and of a line its values as cells
  /// What a curved skin's tractions amount to in space. Constraints are then there or not.
  space = 11,
};
inline constexpr auto newest_plan_version = PlanVersion::space;

/// The bytes of a plan.
/// @throw std::invalid_argument  as `check(plan)`
[[nodiscard]] std::vector<std::byte> encode_plan(const EstimatorPlan& plan);

/// The plan of these bytes; any bytes at all are safe to pass.
/// @throw std::runtime_error  the bytes are no plan, truncated, corrupted, of another version, or
///                            describe a plan that `check` refuses; the text says which
[[nodiscard]] EstimatorPlan decode_plan(std::span<const std::byte> bytes);

}  // namespace tactile_net
