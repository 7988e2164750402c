/// @file
/// What a buried sensor reads, and which surface load causes it.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace tactile_net {

/// A component of stress [Pa] or strain [1] below the surface. x points into the material, y runs
/// along the surface; compression is positive.
enum class Quantity { stress_x, stress_y, shear_xy, strain_x, strain_y };

inline constexpr std::array quantities = {Quantity::stress_x, Quantity::stress_y,
                                          Quantity::shear_xy, Quantity::strain_x,
                                          Quantity::strain_y};

/// A component of the load on the surface [Pa]: normal pushes along +x, tangential drags along +y.
enum class Traction { normal, tangential };

/// The name as scenes, CSV headers and JSON spell it: "stress_x".
[[nodiscard]] std::string_view name(Quantity quantity) noexcept;

/// The quantity of that name, or nothing.
[[nodiscard]] std::optional<Quantity> quantity_named(std::string_view name) noexcept;

/// True for strain_x and strain_y, whose readings have no unit; the others are in Pa.
[[nodiscard]] bool is_strain(Quantity quantity) noexcept;

/// The kernel changes sign under y -> -y; otherwise it is even.
[[nodiscard]] bool is_odd(Quantity quantity, Traction component) noexcept;

}  // namespace tactile_net
