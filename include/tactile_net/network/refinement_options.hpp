/// @file
/// How a circuit's answer is refined in numbers: through which converters, and how far.
#pragma once

#include <cstddef>
#include <optional>

#include "tactile_net/numeric/fields.hpp"

namespace tactile_net {

/// How far a cycle goes along the circuit's answer d.
enum class RefinementStep { plain, search, conjugate };

template <>
struct Enumerators<RefinementStep> {
  static constexpr Enumerator<RefinementStep> all[] = {
      {RefinementStep::plain, "plain", "All of it."},
      {RefinementStep::search, "search", "As far as the energy of the error falls."},
      {RefinementStep::conjugate, "conjugate",
       "The same, of the part of it that no cycle before has gone along."}};
};

/// Between the circuit and whoever computes: one to each summing node, one from each output. Their
/// ranges are the largest value of the cycle. Each code is within half a step of its place (INL).
struct Converters {
  int bits = 12;             ///< 4 to 24
  double gain = 1e-3;        ///< each channel's own error, within +-gain, >= 0, < 0.5
  double noise = 1e-3;       ///< of the circuit's answer: standard deviation over the range, >= 0
  double conversion = 1e-6;  ///< how long one takes [s], >= 0
};

struct RefinementOptions {
  std::optional<Converters> converters{Converters{}};  ///< absent: exact ones
  std::size_t cycles = 4;  ///< the circuit's own answer is the first; 1 to `most_refinement_cycles`
  RefinementStep step = RefinementStep::search;
  double accuracy = 1e-6;  ///< relative error to come to, > 0
};

inline constexpr std::size_t most_refinement_cycles = 64;

/// @throw std::invalid_argument  an option is out of range
void check(const RefinementOptions& options);

}  // namespace tactile_net
