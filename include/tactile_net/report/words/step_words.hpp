/// @file
/// What a long computation is doing, in a few words.
#pragma once

#include <string>

#include "tactile_net/lab/observer.hpp"

namespace tactile_net::report {

/// "ngspice: transient of 42 states ..."
[[nodiscard]] std::string in_words(const lab::Step& step);

}  // namespace tactile_net::report
