/// @file
/// Why a line's sensors do not tell some tractions apart: a type and its numbers each. The
/// sentences are `report::in_words`.
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "tactile_net/lab/sensor_choice.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::lab {

namespace hidden_reason {

struct OneStrain {};     ///< strain_y is -strain_x at nu = 0.5: two strains at one depth are one
struct Proportional {};  ///< the quantities answer to both tractions in the same proportion
/// Every kernel of that traction is odd in what is read: its mean, and what alternates from taxel
/// to taxel, cancels left and right of each taxel.
struct OddKernels {
  Traction component = Traction::normal;
};
/// None of the quantities answers to that traction's mean.
struct MeanUnread {
  Traction component = Traction::normal;
};
/// A constant in each channel is its offset's.
struct UnknownOffsets {};
/// An odd count leaves a half of the mirrored problem one reading short (`lost_by_symmetry`).
struct Symmetry {
  std::size_t taxels = 0;
  std::size_t lost = 0;  ///< combinations
};
/// Uneven taxels that do not all read everything are fewer readings than as many tractions.
struct FewReadings {
  std::size_t readings = 0;
  std::size_t tractions = 0;
};
struct DeadTaxels {};
/// The pad smooths short waves below rounding.
struct Smoothing {
  double wavelength = 0.0;  ///< the shortest hidden [m]
  double depth = 0.0;       ///< of the sensors nearest to the surface [m]
  double left = 0.0;        ///< share of such a ripple that arrives there, about
};

}  // namespace hidden_reason

using HiddenReason =
    std::variant<hidden_reason::OneStrain, hidden_reason::Proportional, hidden_reason::OddKernels,
                 hidden_reason::MeanUnread, hidden_reason::UnknownOffsets, hidden_reason::Symmetry,
                 hidden_reason::FewReadings, hidden_reason::DeadTaxels, hidden_reason::Smoothing>;

/// All that hold for the scene's own sensors; none where nothing is hidden.
[[nodiscard]] std::vector<HiddenReason> hidden_reasons(const Scene& scene, const SensorChoice& own);

}  // namespace tactile_net::lab
