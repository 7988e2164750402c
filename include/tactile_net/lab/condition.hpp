/// @file
/// How much a system multiplies relative errors, and how well that is known.
#pragma once

#include <string_view>

namespace tactile_net::lab {

struct Condition {
  enum class Kind {
    exact,       ///< the 2-norm condition number
    bound,       ///< at most this: largest row sum over the smallest eigenvalue
    noise_gain,  ///< dft: largest over smallest |DFT| of the kernel
  };
  double value = 1.0;  ///< >= 1; may be infinite
  Kind kind = Kind::exact;
};

/// The spelling in JSON: "exact", "bound", "noise_gain".
[[nodiscard]] std::string_view name(Condition::Kind kind) noexcept;

}  // namespace tactile_net::lab
