/// @file
/// Components are not what is printed on them: their errors and standard values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace tactile_net {

/// Preferred values of resistors (IEC 60063): 12, 24, ... a decade.
enum class Series { e12 = 12, e24 = 24, e48 = 48, e96 = 96, e192 = 192 };

struct ToleranceOptions {
  std::optional<double> relative{};  ///< uniform within +-relative, 0 < relative < 1
  std::optional<Series> series{};    ///< rounded to the nearest value of the series, first
  std::size_t trials = 1000;         ///< >= 1
  std::uint64_t seed = 1;
};

}  // namespace tactile_net
