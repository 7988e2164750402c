/// @file
/// Files that a hand refers to: whoever wrote the hand has chosen them. Private.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "tactile_net/lab/fingertip.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::lab {

/// The diagnostics without what the file holds: only where something is wrong, and the advice.
[[nodiscard]] InputError without_quotes(const InputError& error, const char* advice);

/// Reads a file that the hand refers to. What such a file holds is not told: whoever wrote the hand
/// would have chosen whose. Of what is wrong inside it only the place is left.
auto unquoted(const char* advice, const auto& read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw without_quotes(error, advice);
  }
}

/// A device never ends, a pipe may never begin. @throw InputError
void require_regular(const std::filesystem::path& file);

/// That a scene has no contact and the hand names no readings.
[[nodiscard]] InputError nothing_presses(const std::filesystem::path& scene);

/// Of a fingertip, on a line or a skin, that its file does not make.
[[noreturn]] void fail_fingertip(const auto& tip, const std::string& what) {
  const bool has_frames = tip.source != Fingertip::Source::simulated;
  throw std::domain_error("finger '" + tip.finger.name + "', " + tip.file.string() +
                          (has_frames ? ", frame " + std::to_string(tip.frame) : "") + ": " + what);
}

inline constexpr const char* explain_scene = "read that scene by itself: that says what is wrong";
inline constexpr const char* explain_readings =
    "solve those readings by themselves: that says what is wrong";

}  // namespace tactile_net::lab
