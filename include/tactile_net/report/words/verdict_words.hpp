/// @file
/// What a verdict means, in a sentence.
#pragma once

#include <string_view>

#include "tactile_net/lab/verdict.hpp"

namespace tactile_net::report {

/// "the rules for alpha disagree: the data do not fix how much to smooth". Without a full stop.
[[nodiscard]] std::string_view in_words(lab::Verdict verdict) noexcept;

}  // namespace tactile_net::report
