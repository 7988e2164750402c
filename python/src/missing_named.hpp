/// @file
/// What becomes of frames that miss readings, by its name in Python.
#pragma once

#include <stdexcept>
#include <string>

#include "tactile_net/lab/missing.hpp"

namespace tactile_net::python {

/// @throw std::invalid_argument  there is none of this name
[[nodiscard]] inline lab::Missing missing_of(const std::string& name) {
  if (const auto missing = lab::missing_named(name)) return *missing;
  throw std::invalid_argument("missing must be fail, skip or estimate (got '" + name + "')");
}

}  // namespace tactile_net::python
