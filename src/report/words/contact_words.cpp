#include "tactile_net/report/words/contact_words.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "report/words/number_words.hpp"

namespace tactile_net::report {
namespace {

/// An area, in the square of the length's unit that suits it.
std::string area_in_words(const std::optional<Units>& units, const Uncertain& area) {
  if (!units) return plus_minus(area.value, area.deviation);
  const ScaledUnit side = axis_unit(units, Dimension::length, std::sqrt(area.value));
  const double factor = side.factor * side.factor;
  return plus_minus(area.value * factor, area.deviation * factor) + ' ' + side.label + "²";
}

}  // namespace

std::vector<std::vector<std::string>> patch_cells(const std::optional<Units>& units,
                                                  std::span<const ContactPatch> patches) {
  if (patches.size() < 2) return {};
  std::vector<std::vector<std::string>> rows(1 + patches.size());
  const auto add = [&](const char* what, const auto& text) {
    std::vector<std::string> column{what};
    for (const ContactPatch& patch : patches) column.push_back(text(patch));
    if (std::all_of(column.begin() + 1, column.end(), [](const auto& one) { return one == "-"; }))
      return;
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].push_back(column[i]);
  };
  const auto shown = [&](Dimension dimension, const std::optional<Uncertain>& number) {
    return number ? in_unit(units, dimension, *number) : std::string("-");
  };
  // A place across a line there is none: its forces are per metre, and its drag has a sign.
  const bool of_skin = std::any_of(patches.begin(), patches.end(), [](const auto& one) {
    return one.ellipse || one.wrench.centre_z;
  });
  const Dimension force = of_skin ? Dimension::point_force : Dimension::force;
  std::size_t number = 0;
  add("contact", [&](const ContactPatch&) { return std::to_string(++number); });
  add("force", [&](const ContactPatch& one) { return shown(force, one.wrench.normal); });
  add("drag", [&](const ContactPatch& one) {
    if (!one.wrench.tangential_y) return std::string("-");
    return shown(force, of_skin ? drag_of(one.wrench) : *one.wrench.tangential_y);
  });
  add(of_skin ? "centre, y" : "centre",
      [&](const ContactPatch& one) { return shown(Dimension::length, one.wrench.centre_y); });
  add("centre, z",
      [&](const ContactPatch& one) { return shown(Dimension::length, one.wrench.centre_z); });
  add("torsion",
      [&](const ContactPatch& one) { return shown(Dimension::moment, one.wrench.torsion); });
  add("drag / force",
      [&](const ContactPatch& one) { return shown(Dimension::none, one.friction); });
  add("margin to slipping",
      [&](const ContactPatch& one) { return shown(Dimension::none, one.slip_margin); });
  add(of_skin ? "area" : "length", [&](const ContactPatch& one) {
    if (!one.extent) return std::string("-");
    return of_skin ? area_in_words(units, *one.extent) : shown(Dimension::length, one.extent);
  });
  return rows;
}

}  // namespace tactile_net::report
