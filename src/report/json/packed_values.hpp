/// @file
/// Private. The values of many frames as text that a page's script reads (pages/web/numbers.js):
/// what a picture needs, in about a character a value.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace tactile_net::report {

/// What values are: of either sign, or sizes, which are not negative.
enum class Packing { either_sign, sizes };

/// Values of frames, one after the other, each a multiple of its frame's step. The characters of
/// `text` are 92 symbols, '#' to '~' with ' ' for '<' and '!' for '\', so that it stands in JSON
/// and in HTML as it is.
///
/// Sizes are a symbol each, 0 to 85 steps. Of either sign symbols 0 to 85 stand for -43 to 42
/// steps; a greater symbol s and the one behind it, t, are the number 92 (s - 86) + t: below 276
/// they stand for 43 steps and more, from 276 on for -44 and less, and 551 for what is not known.
struct PackedValues {
  std::size_t size = 0;         ///< values of a frame
  std::vector<double> steps{};  ///< one per frame, or one of what all frames share
  std::string text{};
  bool sizes = false;
};

/// A step is a 300th of the frame's largest value, of many values a 150th, but no less than a 500th
/// of the largest of all: a frame of noise needs no more. Of sizes it is an 85th of the frame's
/// largest. Frames that are all the same are packed once.
///
/// @param frames  of equal size, one at least
[[nodiscard]] PackedValues packed(const std::vector<std::span<const double>>& frames,
                                  Packing packing = Packing::either_sign);

}  // namespace tactile_net::report
