/// @file
/// What the numbers of a scene and of its recordings are measured in: the table [units].
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// What a number of a scene measures.
enum class Dimension {
  none,         ///< a strain, a ratio
  length,       ///< SI: m
  stress,       ///< SI: Pa; tractions and moduli too
  force,        ///< SI: N/m, a load per unit of depth
  point_force,  ///< SI: N, a load on a skin
  moment,       ///< SI: N m
};

/// A unit as people write it. Converting is one multiplication and one division by numbers that a
/// double holds exactly, where there are such: 0.25 mm is the same double as 0.25e-3 m.
struct Unit {
  std::string_view name{};
  double multiplier = 1.0;
  double divisor = 1.0;

  [[nodiscard]] constexpr double to_si(double number) const noexcept {
    return number * multiplier / divisor;
  }
  [[nodiscard]] constexpr double from_si(double number) const noexcept {
    return number * divisor / multiplier;
  }
  [[nodiscard]] constexpr bool is_si() const noexcept { return multiplier == divisor; }
};

/// "Per" this unit.
[[nodiscard]] constexpr Unit inverse(const Unit& unit) noexcept {
  return {unit.name, unit.divisor, unit.multiplier};
}

/// The units of a dimension, from small to large; "um" and "µm" are two spellings of one.
[[nodiscard]] std::span<const Unit> units_of(Dimension dimension) noexcept;

/// The unit of a dimension that a text names, in any usual spelling: "kgf/cm2", "μm"; nothing: it
/// names none.
[[nodiscard]] std::optional<Unit> unit_named(Dimension dimension, std::string_view text);

/// What a unit's name measures; nothing: it is not known.
[[nodiscard]] std::optional<Dimension> dimension_named(std::string_view text);

/// "length", "stress", "force", of a strain "number".
[[nodiscard]] std::string_view name(Dimension dimension) noexcept;

/// "m", "Pa", "N/m", "".
[[nodiscard]] std::string_view si_unit(Dimension dimension) noexcept;

/// What the file states. Everything read from it is in SI by then: this is for those who write in
/// its units again, and for reports.
struct Units {
  Unit length{.name = "m"};
  Unit modulus{.name = "Pa"};  ///< of E
  Unit stress{.name = "Pa"};   ///< of readings, their noise, and tractions
  Unit force{.name = "N/m"};   ///< of contacts' loads; on a skin N
};

/// What readings of a kind measure: stresses a stress, strains nothing, displacements a length.
[[nodiscard]] Dimension dimension_of(QuantityKind kind) noexcept;

/// The unit of readings of that kind.
[[nodiscard]] Unit unit_of(const Units& units, QuantityKind kind) noexcept;

}  // namespace tactile_net
