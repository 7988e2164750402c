/// @file
/// Units that the header of a recording gives. Private.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tactile_net/frames/source.hpp"

namespace tactile_net::frames {

/// Whether a text names a unit: of a reading, of time, of a converter's counts.
[[nodiscard]] bool names_unit(std::string_view text);

/// What a unit in a header means for the numbers below it.
struct HeaderUnit {
  /// What makes numbers in the scene's unit of them; nothing: they are that already, or the
  /// scene's calibration takes them as they stand.
  std::optional<Unit> factor{};
  bool understood = true;  ///< false: the text is none of the units that are known
  std::string problem{};   ///< why the unit cannot be right; empty: it can
  std::string what_to_do{};
};

/// @param stated  as the header has it: "kPa"
[[nodiscard]] HeaderUnit header_unit(std::string_view stated, const WantedUnit& wanted);

}  // namespace tactile_net::frames
