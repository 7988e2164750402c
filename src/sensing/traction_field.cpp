#include "tactile_net/sensing/traction_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tactile_net {

namespace {

void add(const Contact& contact, Traction component, const Surface& surface,
         std::vector<double>& field) {
  // A singular point on the border of two cells is in both, however the border is rounded.
  const double half = 0.5 * surface.spacing;
  const double reach = half * (1.0 + 1e-9);
  const std::vector<double> singular = singular_points(contact);
  for (std::size_t j = 0; j < surface.count; ++j) {
    const double y = surface.position(j);
    const bool infinite = std::any_of(singular.begin(), singular.end(),
                                      [&](double point) { return std::abs(point - y) <= reach; });
    field[j] += infinite ? force_between(contact, component, y - half, y + half) / surface.spacing
                         : traction(contact, component, y);
  }
}

}  // namespace

TractionField sample(std::span<const Contact> contacts, const Surface& surface) {
  for (const Contact& contact : contacts) check(contact);

  TractionField field{.normal = std::vector<double>(surface.count), .tangential = {}};
  if (std::any_of(contacts.begin(), contacts.end(), has_friction))
    field.tangential.resize(surface.count);
  for (const Contact& contact : contacts) {
    add(contact, Traction::normal, surface, field.normal);
    if (has_friction(contact)) add(contact, Traction::tangential_y, surface, field.tangential);
  }
  return field;
}

TractionField sample(std::span<const Contact> contacts, const SensorArray& array) {
  return sample(contacts, surface_of(array));
}

}  // namespace tactile_net
