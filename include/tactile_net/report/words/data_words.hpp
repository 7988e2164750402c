/// @file
/// Whether readings can be true, in words.
#pragma once

#include <string>
#include <string_view>

#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/lab/remark.hpp"
#include "tactile_net/scene/skin_scene.hpp"

namespace tactile_net::report {

/// "no contact explains the readings: ...". Without a full stop.
[[nodiscard]] std::string_view in_words(DataDoubt doubt) noexcept;

/// The same of a frame, with its names and numbers.
[[nodiscard]] std::string in_words(const lab::remark::DataDoubted& doubted);

/// For a field of a table: "ok", "noise_unknown" (nothing found, and a misfit could not be),
/// "implausible+bad_taxel_12", on a skin "implausible+bad_taxel_1_2".
[[nodiscard]] std::string data_word(const DataVerdict& data);
[[nodiscard]] std::string data_word(const DataVerdict& data, const SkinScene& scene);

}  // namespace tactile_net::report
