/// @file
/// The contest of rules for alpha: many frames of white noise on one contact, or on many, the error
/// with each rule's alpha over that with the best.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/sensing/array.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace bench {

/// One array, its contacts, one size of noise.
struct AlphaSetting {
  std::string array{};  ///< as the table names it
  std::string reads{};  ///< likewise
  double noise = 0.01;  ///< rms over the peak of each channel
  tactile_net::SensorArray sensor{};
  std::size_t unknowns = 1;
  tactile_net::SurfaceBasis basis = tactile_net::SurfaceBasis::taxels;
  std::vector<tactile_net::RigidContact> contacts{};  ///< frame after frame, from the first again

  /// "dense", "coarse" or "uneven".
  [[nodiscard]] std::string_view kind() const noexcept {
    if (!tactile_net::is_even(sensor)) return "uneven";
    return basis == tactile_net::SurfaceBasis::hats ? "coarse" : "dense";
  }
};

/// 61 taxels a third of their depth apart under one contact; 17 taxels their depth apart and 9
/// twice that, with the tractions on a grid, under 400 contacts drawn at random; and 24 taxels with
/// gaps of 0.3 to 2 depths, 0.7 to 1.4 times as deep as they are on average. Four sets of readings,
/// three sizes of noise.
[[nodiscard]] std::vector<AlphaSetting> alpha_settings();

/// How one rule did: errors over the best alpha's, ascending.
struct AlphaScore {
  std::string rule{};
  std::vector<double> ratios{};
  std::size_t ok = 0;     ///< frames with that verdict
  double worst_ok = 0.0;  ///< the largest ratio of these

  [[nodiscard]] double percentile(double p) const;
  [[nodiscard]] std::size_t above(double limit) const;
};

/// The scores of every rule in the order of `alpha_rules`, then of the default where the noise is
/// known and where it is not.
[[nodiscard]] std::vector<AlphaScore> contest(const AlphaSetting& setting, std::size_t frames);

/// The page docs/internals/alpha.md: every score of every setting, and the floors that hold.
/// Returns whether all do.
/// @param kind  of the arrays; empty: all
bool write_contest(std::size_t frames, bool page, std::string_view kind = {});

}  // namespace bench
