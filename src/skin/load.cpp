#include "tactile_net/skin/load.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "numeric/named.hpp"
#include "numeric/require.hpp"
#include "skin/load_part.hpp"
#include "skin/patch.hpp"

namespace tactile_net {
namespace {

constexpr Named<SkinShape> shapes[] = {{SkinShape::sphere, "sphere"},
                                       {SkinShape::ellipsoid, "ellipsoid"},
                                       {SkinShape::punch, "punch"},
                                       {SkinShape::cone, "cone"}};

void check(const SkinContact& contact) {
  require_finite("y", contact.y);
  require_finite("z", contact.z);
  require_positive("radius", contact.radius);
  if (contact.shape == SkinShape::ellipsoid)
    require_positive("second_radius", contact.second_radius);
  else
    require(contact.second_radius == 0.0, "second_radius", "be 0 but for an ellipsoid",
            contact.second_radius);
  require_finite("angle", contact.angle);
  require_finite("force", contact.force);
  require_finite("friction", contact.friction);
  require_finite("direction", contact.direction);
  require(contact.stick >= 0.0 && contact.stick < 1.0, "stick", "be >= 0 and < 1", contact.stick);
  require(contact.stick == 0.0 || contact.shape != SkinShape::punch, "stick",
          "be 0 for a punch, which slides at once or not at all", contact.stick);
  require_finite("torsion", contact.torsion);
}

double traction(const SkinContact& contact, Traction component, double y, double z) noexcept {
  double sum = 0.0;
  for (const LoadPart& part : parts(contact)) sum += part.traction(component, y, z);
  return sum;
}

SkinWrench resultant(const SkinContact& contact) noexcept {
  SkinWrench sum;
  for (const LoadPart& part : parts(contact)) sum += part.resultant();
  return sum;
}

SkinSupport support(const SkinContact& contact) noexcept {
  return parts(contact).front().support();
}

bool has_traction(const SkinContact& contact, Traction component) noexcept {
  if (component == Traction::normal) return contact.force != 0.0;
  return contact.torsion != 0.0 ||
         parts(contact).front().force[static_cast<std::size_t>(component)] != 0.0;
}

// Sampled patches.

void check(const SampledPatch& patch) {
  require(patch.rows >= 1, "rows", "be >= 1", patch.rows);
  require(patch.columns >= 1, "columns", "be >= 1", patch.columns);
  require_finite("y", patch.y);
  require_finite("z", patch.z);
  require_positive("spacing_y", patch.spacing_y);
  require_positive("spacing_z", patch.spacing_z);
  const std::size_t count = patch.rows * patch.columns;
  for (const Traction component : skin_tractions) {
    const std::vector<double>& own = values(patch, component);
    const std::string what(name(component));
    require(own.size() == count || (own.empty() && component != Traction::normal), what,
            "hold one value for each rectangle, " + std::to_string(count), own.size());
    for (std::size_t i = 0; i < own.size(); ++i)
      require_finite(what + "[" + std::to_string(i) + "]", own[i]);
  }
}

double traction(const SampledPatch& patch, Traction component, double y, double z) noexcept {
  const std::vector<double>& own = values(patch, component);
  const double row =
      std::floor((y - patch.y) / patch.spacing_y + 0.5 * static_cast<double>(patch.rows));
  const double column =
      std::floor((z - patch.z) / patch.spacing_z + 0.5 * static_cast<double>(patch.columns));
  if (own.empty() || !(row >= 0.0 && row < static_cast<double>(patch.rows)) ||
      !(column >= 0.0 && column < static_cast<double>(patch.columns)))
    return 0.0;
  return own[static_cast<std::size_t>(row) * patch.columns + static_cast<std::size_t>(column)];
}

SkinWrench resultant(const SampledPatch& patch) noexcept {
  SkinWrench sum;
  const SurfaceGrid grid = grid_of(patch);
  for (std::size_t i = 0; i < patch.normal.size(); ++i) {
    const double y = grid.y(i / patch.columns);
    const double z = grid.z(i % patch.columns);
    const auto force = [&](const std::vector<double>& own) {
      return own.empty() ? 0.0 : own[i] * grid.area();
    };
    const std::array cell = {force(patch.normal), force(patch.tangential_y),
                             force(patch.tangential_z)};
    sum += {.force = cell,
            .moment_y = y * cell[0],
            .moment_z = z * cell[0],
            .torque = y * cell[2] - z * cell[1]};
  }
  return sum;
}

SkinSupport support(const SampledPatch& patch) noexcept {
  const double half_y = 0.5 * static_cast<double>(patch.rows) * patch.spacing_y;
  const double half_z = 0.5 * static_cast<double>(patch.columns) * patch.spacing_z;
  return {patch.y - half_y, patch.y + half_y, patch.z - half_z, patch.z + half_z};
}

bool has_traction(const SampledPatch& patch, Traction component) noexcept {
  const std::vector<double>& own = values(patch, component);
  return std::any_of(own.begin(), own.end(), [](double value) { return value != 0.0; });
}

/// As std::visit, which throws where a variant holds nothing; this one always holds a load.
auto of_kind(const SkinLoad& load, const auto& function) noexcept {
  if (const auto* contact = std::get_if<SkinContact>(&load)) return function(*contact);
  return function(*std::get_if<SampledPatch>(&load));
}

}  // namespace

std::string_view name(SkinShape shape) noexcept { return name_in<shapes>(shape); }

void check(const SkinLoad& load) {
  std::visit([](const auto& own) { check(own); }, load);
}

double traction(const SkinLoad& load, Traction component, double y, double z) noexcept {
  return of_kind(load, [&](const auto& own) { return traction(own, component, y, z); });
}

SkinWrench& SkinWrench::operator+=(const SkinWrench& other) noexcept {
  for (std::size_t k = 0; k < force.size(); ++k) force[k] += other.force[k];
  moment_y += other.moment_y;
  moment_z += other.moment_z;
  torque += other.torque;
  return *this;
}

SkinWrench resultant(const SkinLoad& load) noexcept {
  return of_kind(load, [](const auto& own) { return resultant(own); });
}

SkinWrench resultant(std::span<const SkinLoad> loads) noexcept {
  SkinWrench sum;
  for (const SkinLoad& load : loads) sum += resultant(load);
  return sum;
}

SkinWrench resultant(std::span<const double> tractions, const SurfaceGrid& grid) noexcept {
  const std::size_t count = grid.count();
  assert(tractions.size() == count || tractions.size() == 3 * count);
  SkinWrench sum;
  for (std::size_t i = 0; i < count; ++i) {
    const double y = grid.y(i / grid.columns);
    const double z = grid.z(i % grid.columns);
    std::array<double, 3> cell{};
    for (std::size_t k = 0; k * count < tractions.size(); ++k)
      cell[k] = tractions[k * count + i] * grid.area();
    sum += {.force = cell,
            .moment_y = y * cell[0],
            .moment_z = z * cell[0],
            .torque = y * cell[2] - z * cell[1]};
  }
  return sum;
}

SkinSupport support(const SkinLoad& load) noexcept {
  return of_kind(load, [](const auto& own) { return support(own); });
}

bool has_traction(const SkinLoad& load, Traction component) noexcept {
  return of_kind(load, [&](const auto& own) { return has_traction(own, component); });
}

bool drags(const SkinLoad& load) noexcept {
  return has_traction(load, Traction::tangential_y) || has_traction(load, Traction::tangential_z);
}

}  // namespace tactile_net
