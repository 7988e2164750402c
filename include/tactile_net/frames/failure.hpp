/// @file
/// Failures of a command that are not bad input: exit status 1.
#pragma once

#include <stdexcept>

namespace tactile_net::frames {

/// A check did not hold; everything that could be reported has been.
class CheckFailed : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An output cannot be created where the user asked for it: wrong usage.
class CannotCreate : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace tactile_net::frames
