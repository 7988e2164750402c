/// @file
/// What every method makes of a hard case, beside the reference.
#pragma once

#include <string>
#include <vector>

#include "tests/hard/cases.hpp"

namespace tactile_net::hard {

struct Outcome {
  std::string method;
  std::string verdict = "ok";  ///< or "refused: ..."
  double condition = 0.0;      ///< of the system the method solves
  double error = 0.0;          ///< |f - reference|_2 / |reference|_2
  double bound = 0.0;          ///< the library's own
  double wedin = 0.0;          ///< first order, for one unit of rounding in every entry
  bool answered = true;
  bool finite = true;
};

/// tikhonov by its matrix, its direct solve and its family, closed_form, conjugate gradients by
/// FFT, and the two circular methods where they apply.
[[nodiscard]] std::vector<Outcome> outcomes(const Case& hard_case);

/// The direct solve and conjugate gradients on a large array with one unknown; its first-order
/// bound is not computed.
[[nodiscard]] std::vector<Outcome> large_outcomes(const Case& hard_case);

}  // namespace tactile_net::hard
