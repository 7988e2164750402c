/// @file
/// A circuit's datasheet as a table and sentences.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/lab/datasheet.hpp"

namespace tactile_net::report {

/// A figure a row: min, typ, max, the limit, and what they come to.
[[nodiscard]] std::vector<std::vector<std::string>> cells(const lab::Datasheet& sheet);

/// What the figures hold for, and what is not told.
[[nodiscard]] std::vector<std::string> in_words(const lab::Datasheet& sheet);

/// Under which a figure was drawn.
[[nodiscard]] std::string conditions_in_words(const lab::Datasheet& sheet,
                                              const lab::DatasheetFigure& figure);

/// "s", "A"; "1": it is relative.
[[nodiscard]] std::string_view unit_of(lab::DatasheetFigure::Kind kind) noexcept;

/// "pad.datasheet.json" of "pad.toml".
[[nodiscard]] std::string datasheet_file(const std::string& scene);

}  // namespace tactile_net::report
