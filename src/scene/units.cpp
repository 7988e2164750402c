#include "tactile_net/scene/units.hpp"

#include <array>

#include "numeric/named.hpp"

namespace tactile_net {
namespace {

constexpr std::array number_units = {Unit{""}};

constexpr std::array length_units = {Unit{"nm", 1.0, 1e9}, Unit{"um", 1.0, 1e6},
                                     Unit{"µm", 1.0, 1e6}, Unit{"mm", 1.0, 1e3},
                                     Unit{"cm", 1.0, 1e2}, Unit{"m"}};

constexpr std::array stress_units = {
    Unit{"Pa"},
    Unit{"mbar", 1e2},
    Unit{"hPa", 1e2},
    Unit{"kPa", 1e3},
    Unit{"psi", 4.4482216152605, 6.4516e-4},  // lbf / in^2, both exact by definition
    Unit{"N/cm^2", 1e4},
    Unit{"bar", 1e5},
    Unit{"N/mm^2", 1e6},
    Unit{"MPa", 1e6},
    Unit{"GPa", 1e9}};

constexpr std::array force_units = {
    Unit{"mN/m", 1.0, 1e3}, Unit{"mN/cm", 1.0, 10.0}, Unit{"mN/mm"},    Unit{"N/m"},
    Unit{"N/cm", 1e2},      Unit{"N/mm", 1e3},        Unit{"kN/m", 1e3}};

constexpr std::array point_force_units = {Unit{"uN", 1.0, 1e6}, Unit{"µN", 1.0, 1e6},
                                          Unit{"mN", 1.0, 1e3}, Unit{"N"}, Unit{"kN", 1e3}};

constexpr std::array moment_units = {Unit{"N m"}};

struct DimensionRow {
  Dimension value;
  std::string_view name;
  std::string_view si;
  std::span<const Unit> units;
};
constexpr DimensionRow dimension_rows[] = {
    {Dimension::none, "number", "", number_units},
    {Dimension::length, "length", "m", length_units},
    {Dimension::stress, "stress", "Pa", stress_units},
    {Dimension::force, "force", "N/m", force_units},
    {Dimension::point_force, "force", "N", point_force_units},
    {Dimension::moment, "moment", "N m", moment_units}};

}  // namespace

std::span<const Unit> units_of(Dimension dimension) noexcept {
  return row_in<dimension_rows>(dimension).units;
}

std::string_view si_unit(Dimension dimension) noexcept {
  return row_in<dimension_rows>(dimension).si;
}

Dimension dimension_of(QuantityKind kind) noexcept {
  switch (kind) {
    case QuantityKind::stress:
      return Dimension::stress;
    case QuantityKind::displacement:
      return Dimension::length;
    case QuantityKind::strain:
      break;
  }
  return Dimension::none;
}

Unit unit_of(const Units& units, QuantityKind kind) noexcept {
  switch (dimension_of(kind)) {
    case Dimension::stress:
      return units.stress;
    case Dimension::length:
      return units.length;
    default:
      return {};
  }
}

}  // namespace tactile_net
