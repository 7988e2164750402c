/// @file
/// What real op-amps do to a circuit, as sentences.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tactile_net/lab/certification.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net::report {

/// Slewing, errors at rest and noise, a scale to take: one fact a line, as far as they are known.
[[nodiscard]] std::vector<std::string> opamps_in_words(const Certificate& certificate);

/// @param units  of the scene; absent: speeds are bare numbers
[[nodiscard]] std::string in_words(const lab::ContactMotion& motion,
                                   const std::optional<Units>& units);

/// `opamps_in_words` is part of the certificate's; these are the rest of what is known of it.
[[nodiscard]] std::vector<std::string> facts_in_words(const lab::Certification& certification);

/// "slew", "swing" or "10 V": what keeps the volts from being more.
[[nodiscard]] std::string bound_in_words(ScaleProposal::Bound bound);

}  // namespace tactile_net::report
