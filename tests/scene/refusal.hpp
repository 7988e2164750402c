/// @file
/// What readers of scenes have against a text.
#pragma once

#include <string>
#include <vector>

#include "tactile_net/scene/reader.hpp"

namespace tactile_net::test {

/// Of a text that `read` reads.
std::vector<Diagnostic> diagnostics_of(const auto& read) {
  try {
    (void)read();
  } catch (const InputError& error) {
    return error.diagnostics();
  }
  return {};
}

/// The error's text, or "accepted".
std::string refusal_of(const auto& read) {
  try {
    (void)read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

inline std::string refusal(const std::string& toml, const std::string& file = "scene.toml") {
  return refusal_of([&] { return parse_scene(toml, file); });
}

}  // namespace tactile_net::test
