/// @file
/// The checks that the methods of this room share. Private.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "numeric/finite.hpp"
#include "tactile_net/inverse/filter_frame.hpp"
#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {

inline constexpr const char* nothing_is_read =
    "no reading depends on the tractions: read another quantity, or read in more places";

/// @throw std::invalid_argument  the problem is a skin's
inline void require_line(const LinearProblem& problem) {
  if (!problem.is_line)
    throw std::invalid_argument(
        "this method is for lines: solve a skin's problem by a TikhonovFamily or, inside "
        "constraints, by the methods of tactile_net/skin");
}

/// @throw std::invalid_argument  alpha is not > 0 and finite
inline void check_alpha(double alpha) {
  if (alpha == 0.0)
    throw std::invalid_argument(std::string("alpha must be > 0; where a rule finds 0, ") +
                                nothing_is_read);
  if (!(alpha > 0.0) || !std::isfinite(alpha))
    throw std::invalid_argument("alpha must be > 0 and finite");
}

/// @throw std::invalid_argument  a limit of friction is not > 0 and finite
inline void check_friction_limit(double limit) {
  if (!(limit > 0.0) || !std::isfinite(limit))
    throw std::invalid_argument("friction_limit must be > 0 and finite");
}

/// @param gamma  of the family that is to solve
/// @throw std::invalid_argument  the frame is of another family
inline void check_same_family(const FilterFrame& frame, std::span<const double> gamma) {
  if (frame.beta.size() != gamma.size() ||
      !std::equal(frame.gamma.begin(), frame.gamma.end(), gamma.begin(), gamma.end()))
    throw std::invalid_argument(
        "the frame is of another family: let the family that solves it analyse its readings");
}

/// What divides one spectrum by another asks of the surface.
/// @throw std::invalid_argument  the tractions lie on a grid
inline void require_at_taxels(const SurfaceOptions& surface) {
  if (surface.basis != SurfaceBasis::taxels)
    throw std::invalid_argument(
        "dft divides the readings' spectrum by the kernel's, and so needs a traction at every "
        "taxel "
        "and nowhere else: surface = \"taxels\"");
}

/// @param what  each of which would have constants of its own: "sections of an array"
/// @throw std::invalid_argument  offsets are unknown
inline void require_known_offsets(bool unknown_offsets, std::string_view what) {
  if (unknown_offsets)
    throw std::invalid_argument(std::string(what) +
                                " cannot tell an unknown offset: leave out offset = true");
}

/// @throw std::invalid_argument  there is not one reading per row of the problem
inline void check_size(std::span<const double> readings, std::size_t rows) {
  if (readings.size() != rows)
    throw std::invalid_argument("readings have " + std::to_string(readings.size()) +
                                " values, the problem has " + std::to_string(rows) + " rows");
}

/// @throw std::invalid_argument  as `check_size`; a reading is not finite
inline void check_readings(std::span<const double> readings, std::size_t rows) {
  check_size(readings, rows);
  if (!all_finite(readings)) throw std::invalid_argument("readings are not finite");
}

/// @throw std::invalid_argument  a matrix from readings to tractions is not finite
inline void check_finite(const Matrix& reconstruction) {
  if (!all_finite(reconstruction.values))
    throw std::invalid_argument("the reconstruction matrix is not finite: scale the readings");
}

/// @throw std::invalid_argument  there is not one traction per column of the problem
inline void check_tractions(std::span<const double> tractions, std::size_t columns) {
  if (tractions.size() != columns)
    throw std::invalid_argument("tractions have " + std::to_string(tractions.size()) +
                                " values, the problem has " + std::to_string(columns) + " columns");
}

/// @throw std::invalid_argument  there is not one weight per traction
inline void check_weights(std::span<const double> weights, std::size_t tractions) {
  if (weights.size() != tractions)
    throw std::invalid_argument(
        "a sum of tractions needs one weight per traction: " + std::to_string(tractions) +
        ", not " + std::to_string(weights.size()));
}

}  // namespace tactile_net
