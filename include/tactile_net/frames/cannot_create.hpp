/// @file
/// An output that cannot be made, known before anything is computed.
#pragma once

#include <stdexcept>

namespace tactile_net::frames {

/// An output cannot be created where the user asked for it.
class CannotCreate : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace tactile_net::frames
