/// @file
/// Taxels that say the same again and again while the others move: dead ones that nobody listed,
/// stuck ones, saturated ones. One frame does not show them where taxels lie far apart.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/sensing/array.hpp"
#include "tactile_net/skin/array.hpp"

namespace tactile_net::lab {

class RepeatingTaxels {
 public:
  /// So many frames after one another, bit by bit: noise never does.
  static constexpr std::size_t least_repeats = 5;

  /// @param dead  taxels that are listed, and not asked for
  RepeatingTaxels(const SensorArray& array, std::span<const std::size_t> dead);
  RepeatingTaxels(const SkinArray& skin, std::span<const std::size_t> dead);

  /// The next frame; one of another size does not count. A repeat counts where at least three
  /// quarters of the living readings have changed: so neither coarse steps nor readings without
  /// noise are taken for it.
  void add(std::span<const double> readings);

  /// The first taxel of which all readings repeat in the frame last added.
  [[nodiscard]] std::optional<std::size_t> first() const;

 private:
  RepeatingTaxels(std::vector<Site> sites, std::size_t taxels, std::span<const std::size_t> dead);

  std::vector<Site> sites_;             // per reading
  std::vector<bool> living_;            // per taxel
  std::vector<std::size_t> repeats_{};  // per reading
  std::vector<double> last_{};
};

}  // namespace tactile_net::lab
