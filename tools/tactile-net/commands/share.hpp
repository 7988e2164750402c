/// @file
/// A share of something, as people write it.
#pragma once

namespace tactile_net::tool {

/// "0.3%", "0.3 %" or 0.003.
struct Share {
  double value = 0.0;
};

}  // namespace tactile_net::tool
