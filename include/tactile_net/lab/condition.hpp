/// @file
/// How much a system multiplies relative errors, and how well that is known.
#pragma once

#include <string_view>

namespace tactile_net::lab {

struct Condition {
  enum class Kind {
    exact,       ///< the 2-norm condition number
    bound,       ///< at most this
    noise_gain,  ///< dft: largest over smallest |DFT| of the kernel
  };
  /// Numbers of one matrix can be compared with each other; tables put them in one column.
  enum class Matrix {
    stacked,     ///< [W K; sqrt(alpha) L], tikhonov's; its free columns under constraints
    eliminated,  ///< closed_form's, of the slopes, the constants eliminated
    circular,    ///< `stacked` with the array taken for a ring
    kernel,      ///< K with the array taken for a ring
    normal,      ///< P, the circuit's
  };
  double value = 1.0;  ///< >= 1; may be infinite
  Kind kind = Kind::exact;
  Matrix matrix = Matrix::stacked;
};

/// The spelling in JSON: "exact", "bound", "noise_gain".
[[nodiscard]] std::string_view name(Condition::Kind kind) noexcept;
/// The spelling in JSON: "stacked", "eliminated", "circular", "kernel", "normal".
[[nodiscard]] std::string_view name(Condition::Matrix matrix) noexcept;

}  // namespace tactile_net::lab
