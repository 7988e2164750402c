/// @file
/// What a long computation is doing, in a few words.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "tactile_net/lab/observer.hpp"

namespace tactile_net::report {

/// "ngspice: transient of 42 states ..."
[[nodiscard]] std::string in_words(const lab::Step& step);

/// "5203 frames, 12 %, about 40 s left", as much of it as is known.
///
/// @param share    of the recording that is done, 0 to 1; nothing where its length is not known
/// @param seconds  since its beginning
[[nodiscard]] std::string frames_in_words(std::size_t done, std::optional<double> share,
                                          double seconds);

}  // namespace tactile_net::report
