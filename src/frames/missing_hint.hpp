/// @file
/// What to do about a value that is missing, the same for every kind of file. Private.
#pragma once

namespace tactile_net::frames {

inline constexpr const char* missing_hint =
    "solve --missing skip leaves such frames out, solve --missing estimate takes the taxel for "
    "dead "
    "in them; one that is broken throughout belongs under [dead_taxels]";

}  // namespace tactile_net::frames
