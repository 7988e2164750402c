#include "tactile_net/scene/units.hpp"

#include <array>
#include <string>
#include <utility>

#include "numeric/named.hpp"

namespace tactile_net {
namespace {

/// Of strains.
constexpr std::array number_units = {Unit{"um/m", 1.0, 1e6}, Unit{"µm/m", 1.0, 1e6},
                                     Unit{"mm/m", 1.0, 1e3}, Unit{"%", 1.0, 1e2}, Unit{""}};

constexpr std::array length_units = {Unit{"nm", 1.0, 1e9}, Unit{"um", 1.0, 1e6},
                                     Unit{"µm", 1.0, 1e6}, Unit{"mm", 1.0, 1e3},
                                     Unit{"cm", 1.0, 1e2}, Unit{"m"}};

constexpr std::array stress_units = {
    Unit{"Pa"},
    Unit{"gf/cm^2", 980665.0, 1e4},
    Unit{"mbar", 1e2},
    Unit{"hPa", 1e2},
    Unit{"mmHg", 133.322387415},  // conventional: 13.5951 g/cm^3 of mercury
    Unit{"kPa", 1e3},
    Unit{"psi", 4.4482216152605, 6.4516e-4},  // lbf / in^2, both exact by definition
    Unit{"N/cm^2", 1e4},
    Unit{"kgf/cm^2", 980665.0, 10.0},
    Unit{"bar", 1e5},
    Unit{"N/mm^2", 1e6},
    Unit{"MPa", 1e6},
    Unit{"GPa", 1e9}};

constexpr std::array force_units = {
    Unit{"nN/um", 1.0, 1e3},  Unit{"nN/µm", 1.0, 1e3}, Unit{"mN/m", 1.0, 1e3},
    Unit{"mN/cm", 1.0, 10.0}, Unit{"mN/mm"},           Unit{"N/m"},
    Unit{"N/cm", 1e2},        Unit{"N/mm", 1e3},       Unit{"kN/m", 1e3}};

constexpr std::array point_force_units = {Unit{"nN", 1.0, 1e9},
                                          Unit{"uN", 1.0, 1e6},
                                          Unit{"µN", 1.0, 1e6},
                                          Unit{"mN", 1.0, 1e3},
                                          Unit{"N"},
                                          Unit{"kN", 1e3}};

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

using Spelling = std::pair<std::string_view, std::string_view>;

/// Parts of names that people write otherwise, and as the tables have them.
constexpr Spelling spellings_of_parts[] = {
    {"μ", "µ"}, {"²", "^2"}, {"/cm2", "/cm^2"}, {"/mm2", "/mm^2"}, {"/m2", "/m^2"}};

/// The same of whole names.
constexpr Spelling spellings_of_units[] = {{"N/m^2", "Pa"},
                                           {"kN/m^2", "kPa"},
                                           {"kg/cm^2", "kgf/cm^2"},
                                           {"g/cm^2", "gf/cm^2"},
                                           {"mm Hg", "mmHg"},
                                           {"microstrain", "um/m"},
                                           {"ustrain", "um/m"},
                                           {"µstrain", "um/m"},
                                           {"µε", "um/m"},
                                           {"strain", ""},
                                           {"m/m", ""},
                                           {"mm/mm", ""},
                                           {"1", ""},
                                           {"-", ""}};

constexpr std::size_t longest_unit = 32;

}  // namespace

std::optional<Unit> unit_named(Dimension dimension, std::string_view text) {
  if (text.size() > longest_unit) return std::nullopt;
  std::string name(text);
  for (const auto& [other, ours] : spellings_of_parts)
    if (const std::size_t at = name.find(other); at != name.npos)
      name.replace(at, other.size(), ours);
  for (const auto& [other, ours] : spellings_of_units)
    if (name == other) name = ours;
  for (const Unit& unit : units_of(dimension))
    if (unit.name == name) return unit;
  return std::nullopt;
}

std::optional<Dimension> dimension_named(std::string_view text) {
  for (const DimensionRow& row : dimension_rows)
    if (unit_named(row.value, text)) return row.value;
  return std::nullopt;
}

std::string_view name(Dimension dimension) noexcept {
  return row_in<dimension_rows>(dimension).name;
}

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
