/// @file
/// "Did you mean": the nearest of some known words.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tactile_net {

/// The known word with the fewest insertions, deletions, replacements and swaps of neighbours to
/// `word`; empty if even that one needs more than a third of its letters (at least two) changed.
[[nodiscard]] std::string_view nearest(std::string_view word, std::span<const std::string> known);

}  // namespace tactile_net
