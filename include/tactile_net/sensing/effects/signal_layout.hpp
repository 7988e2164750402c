/// @file
/// What the signal path knows of a sensor, a line or a skin: which reading is of what and whose,
/// and which lie side by side.
#pragma once

#include <cstddef>
#include <vector>

#include "tactile_net/elasticity/quantity.hpp"
#include "tactile_net/elasticity/space/skin_quantity.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// A quantity of a line or of a skin; a line's are a skin's of the same name, in the same order.
class SignalQuantity {
 public:
  SignalQuantity(Quantity quantity) noexcept;
  constexpr SignalQuantity(SkinQuantity quantity) noexcept : value_(quantity) {}
  constexpr operator SkinQuantity() const noexcept { return value_; }

  /// A material that creeps lets it grow under a load that does not: strains and displacements do.
  [[nodiscard]] constexpr bool creeps() const noexcept {
    return traits(value_).kind != QuantityKind::stress;
  }
  friend constexpr bool operator==(const SignalQuantity&, const SignalQuantity&) = default;
  friend constexpr bool operator<(const SignalQuantity& a, const SignalQuantity& b) noexcept {
    return a.value_ < b.value_;
  }

 private:
  SkinQuantity value_;
};

/// Readings of one quantity behind one another.
struct SignalChannel {
  SignalQuantity quantity = SkinQuantity::stress_x;
  std::size_t first = 0;
  std::size_t count = 0;
};

struct SignalReading {
  SignalQuantity quantity = SkinQuantity::stress_x;
  std::size_t taxel = 0;
  std::size_t channel = 0;
};

struct SignalLayout {
  SignalLayout() = default;
  /// Of a line: a reading's neighbours are the one before and the one behind it in its channel.
  SignalLayout(const SensorArray& array);

  std::size_t taxels = 0;
  std::vector<SignalChannel> channels{};
  std::vector<SignalReading> readings{};
  /// Two readings of a channel whose taxels lie side by side.
  struct Neighbours {
    std::size_t first = 0;
    std::size_t second = 0;
  };
  std::vector<Neighbours> neighbours{};
  std::size_t most_neighbours = 2;  ///< of one reading
};

}  // namespace tactile_net
