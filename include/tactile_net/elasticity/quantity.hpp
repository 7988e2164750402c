/// @file
/// What a buried sensor reads, and which surface load causes it.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace tactile_net {

/// A component of stress [Pa] or strain [1] below the surface. x points into the material, y runs
/// along the surface; compression is positive.
enum class Quantity { stress_x, stress_y, shear_xy, strain_x, strain_y };

/// A component of the load on the surface [Pa]: normal pushes along +x, tangential drags along +y.
enum class Traction { normal, tangential };

/// The components in the order in which a problem's unknowns have them.
inline constexpr std::array traction_components = {Traction::normal, Traction::tangential};

/// What the library needs to know of a quantity, besides its kernel (elasticity/hooke.hpp).
struct QuantityTraits {
  Quantity value = Quantity::stress_x;
  std::string_view name{};      ///< as scenes, CSV headers and JSON spell it
  std::string_view unit{};      ///< of a reading: "Pa" or "1"
  bool odd_for_normal = false;  ///< a normal load's readings change sign under y -> -y; those of a
                                ///< tangential load then do not, and the other way round
};

/// One row for each quantity, in their order.
inline constexpr std::array<QuantityTraits, 5> quantity_traits = {{
    {.value = Quantity::stress_x, .name = "stress_x", .unit = "Pa", .odd_for_normal = false},
    {.value = Quantity::stress_y, .name = "stress_y", .unit = "Pa", .odd_for_normal = false},
    {.value = Quantity::shear_xy, .name = "shear_xy", .unit = "Pa", .odd_for_normal = true},
    {.value = Quantity::strain_x, .name = "strain_x", .unit = "1", .odd_for_normal = false},
    {.value = Quantity::strain_y, .name = "strain_y", .unit = "1", .odd_for_normal = false},
}};

/// Every quantity, in the order of the table.
inline constexpr std::array quantities = [] {
  std::array<Quantity, quantity_traits.size()> all{};
  std::transform(quantity_traits.begin(), quantity_traits.end(), all.begin(),
                 [](const QuantityTraits& row) { return row.value; });
  return all;
}();

/// The name as scenes, CSV headers and JSON spell it: "stress_x".
[[nodiscard]] std::string_view name(Quantity quantity) noexcept;

/// The quantity of that name, or nothing.
[[nodiscard]] std::optional<Quantity> quantity_named(std::string_view name) noexcept;

/// "normal" or "tangential".
[[nodiscard]] std::string_view name(Traction component) noexcept;

/// True for strain_x and strain_y, whose readings have no unit; the others are in Pa.
[[nodiscard]] bool is_strain(Quantity quantity) noexcept;

/// The kernel changes sign under y -> -y; otherwise it is even.
[[nodiscard]] bool is_odd(Quantity quantity, Traction component) noexcept;

}  // namespace tactile_net
