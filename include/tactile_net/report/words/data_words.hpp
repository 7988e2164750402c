/// @file
/// Whether readings can be true, in words.
#pragma once

#include <string>
#include <string_view>

#include "tactile_net/inverse/data_verdict.hpp"

namespace tactile_net::report {

/// "no contact explains the readings: ...". Without a full stop.
[[nodiscard]] std::string_view in_words(DataDoubt doubt) noexcept;

/// The same of a frame, with its numbers; empty where nothing is doubtful.
[[nodiscard]] std::string in_words(const DataVerdict& data);

/// For a field of a table: "ok", "noise_unknown" (nothing found, and a misfit could not be),
/// "implausible+bad_taxel_12".
[[nodiscard]] std::string data_word(const DataVerdict& data);

}  // namespace tactile_net::report
