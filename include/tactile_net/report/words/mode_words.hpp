/// @file
/// Combinations of tractions that readings do not show, in words.
#pragma once

#include <optional>
#include <string>

#include "tactile_net/inverse/identifiability.hpp"
#include "tactile_net/inverse/thesis/dft_tikhonov.hpp"
#include "tactile_net/scene/units.hpp"

namespace tactile_net::report {

/// "tangential traction, alternating from taxel to taxel (Nyquist), even about the centre"
[[nodiscard]] std::string in_words(const TractionMode& mode,
                                   const std::optional<Units>& units = {});

/// The first mode, how many more there are and over which wavelengths; empty for dimension 0.
[[nodiscard]] std::string in_words(const ModeSpace& space, const std::optional<Units>& units = {});

/// "-", "tangential, alternating", "81 modes, wavelengths 1 to 40"
[[nodiscard]] std::string in_short(const ModeSpace& space, const std::optional<Units>& units = {});

/// ", wavelengths 1 to 40"; empty where no wave is half of a combination
[[nodiscard]] std::string wavelengths_in_short(const ModeSpace& space,
                                               const std::optional<Units>& units = {});

/// "the mean of the tangential traction (k = 0)"
[[nodiscard]] std::string in_words(const DftNullMode& mode);

}  // namespace tactile_net::report
