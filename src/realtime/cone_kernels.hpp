/// @file
/// The loops of a step towards tractions that contact allows (cone_plan.hpp), each compiled once
/// for every instruction set. Private.
#pragma once

#include <array>
#include <cstddef>

#include "realtime/anderson.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"

namespace tactile_net {

/// What contact allows a cell: its normal traction, and none, one or two drags, block after block.
struct Cones {
  std::size_t cells = 0;
  std::size_t drags = 0;
  double limit = 0.0;  ///< of friction; 0: none, drags are free
};

/// What a step reads and writes: vectors on cache lines, of so many values that whole lines are
/// read, zeros after the last one.
struct ConeVectors {
  const double* free;  ///< f0
  double* v;
  double* z;      ///< the point of C next to v
  double* input;  ///< 2 z - v - f0
  double* moved;  ///< S times the input; x - f0
  double* residual;
  double* change;                                ///< what v changed by last
  std::array<float*, anderson_pairs> residuals;  ///< what residuals changed by
  std::array<float*, anderson_pairs> combined;   ///< and what v changed by, added to that
};

/// Sums of a step.
struct ConeSums {
  double residual = 0.0;  ///< |r|^2
  double input = 0.0;     ///< |2 z - v - f0|^2
  AndersonSums gram{};    ///< the newest change of residuals times each
  AndersonSums right{};   ///< each times r
};

/// Over-relaxation of a step.
inline constexpr double cone_relaxation = 1.6;

struct ConeKernels {
  /// z and the input.
  void (*project)(const ConeVectors& of, Cones cones) noexcept;
  /// The residual 1.6 (f0 + moved - z).
  /// @param newest  pair to be written
  /// @param count   pairs there are then; 0: none is written
  ConeSums (*look)(const ConeVectors& of, std::size_t size, std::size_t newest,
                   std::size_t count) noexcept;
  /// v += change, change = r - sum of weights times what is combined.
  void (*go)(const ConeVectors& of, std::size_t size, const AndersonSums& weights,
             std::size_t count) noexcept;
  /// Tractions from z, over the scales, so that each cell obeys its cone as a double does: where it
  /// lies within rounding of the limit its drags are shortened. Cells that z has as f0 keep those
  /// tractions that they were scaled from, which f is to hold.
  void (*publish)(const ConeVectors& of, Cones cones, double normal, double drag,
                  double* f) noexcept;
};

/// @param set  one that this machine runs
[[nodiscard]] const ConeKernels& cone_kernels(InstructionSet set) noexcept;

}  // namespace tactile_net
