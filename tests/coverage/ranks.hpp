/// @file
/// Whether an answer that is a distribution is right: the truth's rank in it, the probability below
/// it, is as often between 0 and 0.1 as between 0.5 and 0.6 (simulation-based calibration; Talts
/// and others 2018). Of draws of the mixture's own model ranks must be uniform, whatever the array.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/numeric/distribution.hpp"
#include "tests/coverage/coverage.hpp"

namespace tactile_net::coverage {

/// sqrt(N) sup |ECDF - u|: above 1.63 for 1 % of uniform samples, above 1.95 for 1 of 1000.
inline constexpr double kolmogorov_99 = 1.63;
[[nodiscard]] double kolmogorov(std::vector<double> ranks);

/// The mean square of the ranks' normal scores less 1, over its own deviation if ranks are uniform:
/// beyond +-2.58 for 1 % of samples. Below 0: what is known has deviations that are too large. What
/// is rarer than 1 of 10 000 counts as that.
inline constexpr double dispersion_99 = 2.58;
[[nodiscard]] double dispersion(std::span<const double> ranks);

/// Share of ranks that lie in the central interval of a level.
[[nodiscard]] double share_within(std::span<const double> ranks, double level);

/// Deviations so many times as large in every component.
[[nodiscard]] Distribution wider(const Distribution& known, double times);

/// Bytes of what was drawn, for one name of all of it.
void add_bytes(std::string& bytes, std::span<const double> values);

struct Ranks {
  std::string name{};             ///< "force", "centre", "tangential", "friction", "place 3"
  std::vector<double> values{};   ///< of a draw each, where the mixture has a distribution
  std::vector<double> planted{};  ///< the same if deviations were a tenth too large
};

struct ModelRanks {
  std::vector<Ranks> of{};
  std::string hash{};  ///< SHA-256 of all readings and tractions
};

inline constexpr double planted_error = 1.1;

struct RankOptions {
  std::size_t draws = 1000;
  std::size_t places = 4;  ///< on the surface, evenly apart, of each traction
  std::uint64_t seed = 1;
  /// In place of those with which the scene knows its noise: 0: nobody knows it; infinity: it is
  /// certain.
  std::optional<double> degrees{};
};

/// Ranks of draws of the model of the setting's scene, which the scene's mixture answers: tractions
/// in a window, their size and weight, the noise and its level, and a constant of each channel
/// where offsets are unknown. Of all draws those count whose largest reading is 10 to 1000 times
/// the noise that is stated, as scenes have it, or where nobody knows it of what the answer leaves
/// of the readings: of a choice by readings alone ranks stay uniform.
///
/// @param setting  its noise: stated, in units of the readings
[[nodiscard]] ModelRanks model_ranks(const Setting& setting, const RankOptions& options);

/// Of a square skin on an incompressible half space. Lengths are in depths.
struct SkinSetting {
  std::size_t rows = 8;
  double pitch = 1.0;
  bool drags = true;  ///< shear is read too
};
/// The same: "force", "centre y", "centre z", "drag y", "drag z", places.
[[nodiscard]] ModelRanks model_ranks(const SkinSetting& setting, const RankOptions& options);

}  // namespace tactile_net::coverage
