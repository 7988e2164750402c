/// @file
/// How often central intervals hold a contact that the mixture's model does not know, how wide they
/// are, and how large the error is; of a scene's answer, be it the mixture or one alpha.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "tests/coverage/coverage.hpp"

namespace tactile_net::coverage {

inline constexpr std::array levels = {0.5, 0.8, 0.95};

/// How many truths lay within the central intervals of each level.
struct Holds {
  std::size_t count = 0;
  std::array<std::size_t, levels.size()> within{};

  Holds& operator+=(const Holds& other) {
    count += other.count;
    for (std::size_t i = 0; i < within.size(); ++i) within[i] += other.within[i];
    return *this;
  }
  /// In per cent. @pre  count > 0
  [[nodiscard]] double percent(std::size_t level) const {
    return 100.0 * static_cast<double>(within[level]) / static_cast<double>(count);
  }
};

struct IntervalScore {
  std::size_t frames = 0;
  Holds force{}, tangential{};
  Holds centre{};      ///< of frames whose force is known well enough
  Holds pressed{};     ///< values on the surface whose truth is above 2 % of the largest
  Holds unpressed{};   ///< those whose truth is 0
  double width = 0.0;  ///< median, of the force's 95 % interval over the force
  double error = 0.0;  ///< median, of the force over the force
  /// Mean, of the force over the force: the continuous ranked probability score by 20 quantiles.
  double crps = 0.0;
  std::string bytes{};  ///< of all readings and truths
};

/// Of the contacts as the setting's scene answers them: the mixture by its quantiles, one alpha by
/// value and deviation as a Gaussian, without its values on the surface.
/// @param values  whether those on the surface are looked at, which takes most of the time
/// @pre  contacts are of the setting's pad and quantity
[[nodiscard]] IntervalScore interval_score(const Setting& setting, const Contacts& contacts,
                                           bool values = false);

}  // namespace tactile_net::coverage
