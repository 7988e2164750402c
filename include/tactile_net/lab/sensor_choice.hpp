/// @file
/// One choice of quantities and depths, and how two of them compare.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tactile_net/inverse/identifiability.hpp"
#include "tactile_net/inverse/resolution.hpp"

namespace tactile_net::lab {

struct SensorChoice {
  std::vector<Quantity> reads{};
  std::vector<double> depths{};  ///< [m]
  std::size_t unknowns = 1;
  Identifiability identifiability{};
  std::vector<Resolution> resolutions{};  ///< from the mean, k = 0, to the shortest wavelength
  std::optional<double> normal{};         ///< resolvable wavelength [m]; absent: none is
  std::optional<double> tangential{};     ///< the same; absent with one unknown too
  /// Width of the contact between two taxels that no reading shows [m].
  std::optional<double> unseen{};
};

/// True if the mean of that traction shows in no kernel: `resolutions` at k = 0.
[[nodiscard]] bool hides_mean(const SensorChoice& choice, Traction component);

/// True if a combination of tractions shows in no reading, or a traction's mean in no kernel.
[[nodiscard]] bool hides_anything(const SensorChoice& choice);

/// The coarser of the resolvable wavelengths [m]; infinite: there is none.
[[nodiscard]] double coarsest(const SensorChoice& choice);

/// By what counts first: no hidden mean, the coarsest resolvable wavelength, no hidden combination
/// (a short one is below the noise anyway), the condition.
[[nodiscard]] bool tells_more(const SensorChoice& a, const SensorChoice& b);

}  // namespace tactile_net::lab
