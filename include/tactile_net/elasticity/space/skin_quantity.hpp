/// @file
/// What a sensor inside a skin reads, and which traction on its surface causes it: the quantities
/// of three-dimensional elasticity. Those of a line array, in plane strain, are in
/// elasticity/quantity.hpp.
///
/// Frame: x points into the skin, y and z lie along its surface, right-handed; x = 0 is the
/// surface. Stresses and strains are positive in compression, shear strains are engineering strains
/// (stress / G), displacements are the material's, positive along their axis. Tractions act on the
/// skin and are positive along +x (a push), +y and +z (drags).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace tactile_net {

enum class Axis { x, y, z };

/// The axis of the surface across `along`, which is y or z.
[[nodiscard]] constexpr Axis across(Axis along) noexcept {
  return along == Axis::y ? Axis::z : Axis::y;
}

enum class SkinQuantity {
  stress_x,
  stress_y,
  stress_z,
  shear_xy,
  shear_xz,
  shear_yz,
  strain_x,
  strain_y,
  strain_z,
  shear_strain_xy,
  shear_strain_xz,
  shear_strain_yz,
  displacement_x,
  displacement_y,
  displacement_z
};

enum class SkinTraction { normal, tangential_y, tangential_z };

/// The components in the order in which a problem's unknowns have them.
inline constexpr std::array skin_tractions = {SkinTraction::normal, SkinTraction::tangential_y,
                                              SkinTraction::tangential_z};

enum class QuantityKind { stress, strain, displacement };

/// What the library needs to know of a quantity, besides its kernel.
struct SkinQuantityTraits {
  SkinQuantity value = SkinQuantity::stress_x;
  std::string_view name{};  ///< as scenes, CSV headers and JSON spell it
  std::string_view unit{};  ///< of a reading: "Pa", "1" or "m"
  QuantityKind kind = QuantityKind::stress;
  Axis first = Axis::x;   ///< the component's two axes;
  Axis second = Axis::x;  ///< a displacement has the first alone, and x here
};

/// One row for each quantity, in their order.
inline constexpr std::array<SkinQuantityTraits, 15> skin_quantity_traits = {{
    {SkinQuantity::stress_x, "stress_x", "Pa", QuantityKind::stress, Axis::x, Axis::x},
    {SkinQuantity::stress_y, "stress_y", "Pa", QuantityKind::stress, Axis::y, Axis::y},
    {SkinQuantity::stress_z, "stress_z", "Pa", QuantityKind::stress, Axis::z, Axis::z},
    {SkinQuantity::shear_xy, "shear_xy", "Pa", QuantityKind::stress, Axis::x, Axis::y},
    {SkinQuantity::shear_xz, "shear_xz", "Pa", QuantityKind::stress, Axis::x, Axis::z},
    {SkinQuantity::shear_yz, "shear_yz", "Pa", QuantityKind::stress, Axis::y, Axis::z},
    {SkinQuantity::strain_x, "strain_x", "1", QuantityKind::strain, Axis::x, Axis::x},
    {SkinQuantity::strain_y, "strain_y", "1", QuantityKind::strain, Axis::y, Axis::y},
    {SkinQuantity::strain_z, "strain_z", "1", QuantityKind::strain, Axis::z, Axis::z},
    {SkinQuantity::shear_strain_xy, "shear_strain_xy", "1", QuantityKind::strain, Axis::x, Axis::y},
    {SkinQuantity::shear_strain_xz, "shear_strain_xz", "1", QuantityKind::strain, Axis::x, Axis::z},
    {SkinQuantity::shear_strain_yz, "shear_strain_yz", "1", QuantityKind::strain, Axis::y, Axis::z},
    {SkinQuantity::displacement_x, "displacement_x", "m", QuantityKind::displacement, Axis::x,
     Axis::x},
    {SkinQuantity::displacement_y, "displacement_y", "m", QuantityKind::displacement, Axis::y,
     Axis::x},
    {SkinQuantity::displacement_z, "displacement_z", "m", QuantityKind::displacement, Axis::z,
     Axis::x},
}};

/// Every quantity, in the order of the table.
inline constexpr std::array skin_quantities = [] {
  std::array<SkinQuantity, skin_quantity_traits.size()> all{};
  std::transform(skin_quantity_traits.begin(), skin_quantity_traits.end(), all.begin(),
                 [](const SkinQuantityTraits& row) { return row.value; });
  return all;
}();

/// The row of the table.
[[nodiscard]] constexpr const SkinQuantityTraits& traits(SkinQuantity quantity) noexcept {
  return skin_quantity_traits[static_cast<std::size_t>(quantity)];
}

/// The axis along which a traction acts.
[[nodiscard]] constexpr Axis axis(SkinTraction component) noexcept {
  return static_cast<Axis>(component);
}

/// "stress_x" and so on.
[[nodiscard]] std::string_view name(SkinQuantity quantity) noexcept;

/// The quantity of that name, or nothing.
[[nodiscard]] std::optional<SkinQuantity> skin_quantity_named(std::string_view text) noexcept;

/// "normal", "tangential_y" or "tangential_z".
[[nodiscard]] std::string_view name(SkinTraction component) noexcept;

/// The kernel changes sign under a reflection of `along`, y or z; otherwise it is even: the sign
/// turns once for each index of the quantity and of the traction that is `along`.
[[nodiscard]] constexpr bool is_odd(SkinQuantity quantity, SkinTraction component,
                                    Axis along) noexcept {
  const SkinQuantityTraits& row = traits(quantity);
  return ((row.first == along) != (row.second == along)) != (axis(component) == along);
}

}  // namespace tactile_net
