/// @file
/// The version of this library, as CMake's `project()` states it.
#pragma once

#include <string_view>

namespace tactile_net {

/// "0.1.0": stands in every document and deck that the library writes.
[[nodiscard]] std::string_view version() noexcept;

}  // namespace tactile_net
