/// @file
/// What real op-amps do to a circuit, as sentences.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/lab/certification.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net::report {

/// Slewing, errors at rest and noise: one fact a line, as far as they are known.
[[nodiscard]] std::vector<std::string> opamps_in_words(const Certificate& certificate);

/// In ratios of `scale`, since a scene writes its own in its own units.
[[nodiscard]] std::string in_words(const ScaleProposal& proposal, const Scale& scale);

/// "1.34 m/s", and a bare number where the scene states no units.
[[nodiscard]] std::string speed_in_words(double speed, const std::optional<Units>& units);

/// @param units  of the scene; absent: speeds are bare numbers
[[nodiscard]] std::string in_words(const lab::ContactMotion& motion,
                                   const std::optional<Units>& units);

/// A scale that suits the op-amps, and moving contacts: what a certificate's own lines leave out.
[[nodiscard]] std::vector<std::string> facts_in_words(const lab::Certification& certification);

}  // namespace tactile_net::report
