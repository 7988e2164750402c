/// @file
/// What a buried sensor reads, and which traction on the surface causes it, for line arrays and
/// skins alike.
///
/// Frame: x points into the material, y and z lie along its surface, right-handed; x = 0 is the
/// surface. Stresses and strains are positive in compression, shear strains are engineering strains
/// (stress / G), displacements are the material's, positive along their axis. Tractions act on the
/// surface and are positive along +x (a push), +y and +z (drags).
///
/// A skin reads every quantity and bears every traction. A line array lies along y in plane strain:
/// it reads `line_quantities` and bears `line_tractions`.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace tactile_net {

enum class Axis { x, y, z };

/// The axis of the surface across `along`, which is y or z.
[[nodiscard]] constexpr Axis across(Axis along) noexcept {
  return along == Axis::y ? Axis::z : Axis::y;
}

/// The axis with y and z exchanged.
[[nodiscard]] constexpr Axis exchanged(Axis axis) noexcept {
  return axis == Axis::x ? axis : across(axis);
}

/// A component of stress [Pa], strain [1] or displacement [m] below the surface.
enum class Quantity {
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

/// A component of the load on the surface [Pa]. A line's tangential traction is `tangential_y`.
enum class Traction { normal, tangential_y, tangential_z };

/// The components of a skin's load, in the order in which a problem's unknowns have them.
inline constexpr std::array skin_tractions = {Traction::normal, Traction::tangential_y,
                                              Traction::tangential_z};

/// The components of a line's load, in the order in which a problem's unknowns have them.
inline constexpr std::array line_tractions = {Traction::normal, Traction::tangential_y};

enum class QuantityKind { stress, strain, displacement };

/// What the library needs to know of a quantity, besides its kernel.
struct QuantityTraits {
  Quantity value = Quantity::stress_x;
  std::string_view name{};  ///< as scenes, CSV headers and JSON spell it
  std::string_view unit{};  ///< of a reading: "Pa", "1" or "m"
  QuantityKind kind = QuantityKind::stress;
  Axis first = Axis::x;   ///< first axis of the component
  Axis second = Axis::x;  ///< second axis; of a displacement, which has one axis, x
};

/// One row for each quantity, in their order.
inline constexpr std::array<QuantityTraits, 15> quantity_traits = {{
    {Quantity::stress_x, "stress_x", "Pa", QuantityKind::stress, Axis::x, Axis::x},
    {Quantity::stress_y, "stress_y", "Pa", QuantityKind::stress, Axis::y, Axis::y},
    {Quantity::stress_z, "stress_z", "Pa", QuantityKind::stress, Axis::z, Axis::z},
    {Quantity::shear_xy, "shear_xy", "Pa", QuantityKind::stress, Axis::x, Axis::y},
    {Quantity::shear_xz, "shear_xz", "Pa", QuantityKind::stress, Axis::x, Axis::z},
    {Quantity::shear_yz, "shear_yz", "Pa", QuantityKind::stress, Axis::y, Axis::z},
    {Quantity::strain_x, "strain_x", "1", QuantityKind::strain, Axis::x, Axis::x},
    {Quantity::strain_y, "strain_y", "1", QuantityKind::strain, Axis::y, Axis::y},
    {Quantity::strain_z, "strain_z", "1", QuantityKind::strain, Axis::z, Axis::z},
    {Quantity::shear_strain_xy, "shear_strain_xy", "1", QuantityKind::strain, Axis::x, Axis::y},
    {Quantity::shear_strain_xz, "shear_strain_xz", "1", QuantityKind::strain, Axis::x, Axis::z},
    {Quantity::shear_strain_yz, "shear_strain_yz", "1", QuantityKind::strain, Axis::y, Axis::z},
    {Quantity::displacement_x, "displacement_x", "m", QuantityKind::displacement, Axis::x, Axis::x},
    {Quantity::displacement_y, "displacement_y", "m", QuantityKind::displacement, Axis::y, Axis::x},
    {Quantity::displacement_z, "displacement_z", "m", QuantityKind::displacement, Axis::z, Axis::x},
}};

/// The quantities of a skin: every one, in the order of the table.
inline constexpr std::array skin_quantities = [] {
  std::array<Quantity, quantity_traits.size()> all{};
  std::transform(quantity_traits.begin(), quantity_traits.end(), all.begin(),
                 [](const QuantityTraits& row) { return row.value; });
  return all;
}();

/// The quantities of a line array, in the order of the table: those whose kernels in plane strain
/// the library has.
inline constexpr std::array line_quantities = {Quantity::stress_x, Quantity::stress_y,
                                               Quantity::shear_xy, Quantity::strain_x,
                                               Quantity::strain_y};

/// The quantity's row in `quantity_traits`.
[[nodiscard]] constexpr const QuantityTraits& traits(Quantity quantity) noexcept {
  return quantity_traits[static_cast<std::size_t>(quantity)];
}

/// The axis along which a traction acts.
[[nodiscard]] constexpr Axis axis(Traction component) noexcept {
  return static_cast<Axis>(component);
}

/// The name as scenes, CSV headers and JSON spell it: "stress_x".
[[nodiscard]] std::string_view name(Quantity quantity) noexcept;

/// The quantity of that name, or nothing.
///
/// @param among  the quantities that may be meant: `line_quantities` for a line array
[[nodiscard]] std::optional<Quantity> quantity_named(
    std::string_view text, std::span<const Quantity> among = skin_quantities) noexcept;

/// "normal", "tangential_y" or "tangential_z": as a skin's CSV headers and JSON spell it.
[[nodiscard]] std::string_view name(Traction component) noexcept;

/// "normal" or "tangential": as a line's CSV headers, JSON and texts spell it.
[[nodiscard]] std::string_view line_name(Traction component) noexcept;

/// Refuses a quantity that a line array cannot read.
/// @throw std::invalid_argument  a line array cannot read it: it is none of `line_quantities`
void check_line(Quantity quantity);

/// Refuses a component that a line's load cannot have.
/// @throw std::invalid_argument  a line's load cannot have it: it is none of `line_tractions`
void check_line(Traction component);

/// True for strains, whose readings have no unit.
[[nodiscard]] constexpr bool is_strain(Quantity quantity) noexcept {
  return traits(quantity).kind == QuantityKind::strain;
}

/// True if a material that creeps lets the reading grow under a load that does not: strains and
/// displacements do.
[[nodiscard]] constexpr bool creeps(Quantity quantity) noexcept {
  return traits(quantity).kind != QuantityKind::stress;
}

/// The quantity with y and z exchanged: shear_xz of shear_xy.
[[nodiscard]] Quantity exchanged(Quantity quantity) noexcept;

/// True if the kernel has odd parity: it changes sign under a reflection of `along`, y or z.
/// Otherwise its parity is even. The sign turns once for each index of the quantity and of the
/// traction that is `along`. A line lies along y.
[[nodiscard]] constexpr bool is_odd(Quantity quantity, Traction component,
                                    Axis along = Axis::y) noexcept {
  const QuantityTraits& row = traits(quantity);
  return ((row.first == along) != (row.second == along)) != (axis(component) == along);
}

}  // namespace tactile_net
