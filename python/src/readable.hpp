/// @file
/// The library's text as Python's.
#pragma once

#include <nanobind/nanobind.h>

#include <string_view>

namespace tactile_net::python {

/// What is no UTF-8, as names in a stranger's file may be, becomes U+FFFD.
[[nodiscard]] nanobind::str readable(std::string_view text);

}  // namespace tactile_net::python
