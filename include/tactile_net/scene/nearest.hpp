/// @file
/// "Did you mean ...?"
#pragma once

#include <span>
#include <string_view>

namespace tactile_net {

/// The known name that differs from `name` by the fewest single-letter edits (insert, delete,
/// replace, swap of neighbours), upper and lower case being alike; the first of several. Empty
/// if none is near: more than a third of the letters would have to change.
[[nodiscard]] std::string_view nearest(std::string_view name,
                                       std::span<const std::string_view> known);

}  // namespace tactile_net
