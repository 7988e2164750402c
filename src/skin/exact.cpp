#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "elasticity/space/reading_size.hpp"
#include "skin/curved_kernel.hpp"
#include "skin/load_part.hpp"
#include "skin/part_quadrature.hpp"
#include "skin/patch.hpp"
#include "tactile_net/elasticity/space/disc.hpp"
#include "tactile_net/elasticity/space/half_space.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/skin/forward.hpp"

namespace tactile_net {
namespace {

constexpr double tolerance = 1e-10;
/// Nearer below the surface, in radii, sources at imaginary depth lose digits.
constexpr double shallow = 1.0 / 64.0;

/// About the largest reading of a contact at a depth.
double scale(const SkinContact& contact, const Material& material, double depth,
             Quantity quantity) noexcept {
  const double b = contact.shape == SkinShape::ellipsoid ? contact.second_radius : contact.radius;
  const double r = std::hypot(std::sqrt(contact.radius) * std::sqrt(b), depth);
  const double force = std::abs(contact.force) * (1.0 + std::abs(contact.friction));
  const double stress = 1.5 / std::numbers::pi * (force + std::abs(contact.torsion) / r) / r / r;
  return reading_size(quantity, stress, r, material);
}

bool is_disc(const LoadPart& part) noexcept { return part.a == part.b && part.torsion == 0.0; }

}  // namespace

/// The loads at one depth.
class ExactSkinModel::Summation {
 public:
  Summation(const ExactSkinModel& model, const Depth& depth, std::span<double> readings)
      : model_(model),
        depth_(depth),
        readings_(readings),
        half_space_(
            [this](Quantity quantity, Traction component, std::span<const double> y,
                   std::span<const double> z, std::span<double> values) {
              half_space_kernel(quantity, component, model_.material_, depth_.depth, y, z, values);
            },
            depth.depth),
        base_(
            [this](Quantity quantity, Traction component, std::span<const double> y,
                   std::span<const double> z, std::span<double> values) {
              depth_.kernel.base_part(quantity, component, y, z, values);
            },
            model.material_.layer ? 2.0 * model.material_.layer->thickness - depth.depth : 1.0) {}
  Summation(const Summation&) = delete;
  Summation& operator=(const Summation&) = delete;

  void add(const SkinContact& contact) {
    const LoadParts all = parts(contact);
    std::vector<double> tolerances;
    std::vector<double> sums;
    for (const Place& place : depth_.places) {
      tolerances.clear();
      for (const Quantity quantity : place.quantities)
        tolerances.push_back(tolerance * scale(contact, model_.material_, depth_.depth, quantity));
      sums.assign(place.quantities.size(), 0.0);
      for (const LoadPart& part : all)
        if (!add(part, place, tolerances, sums))
          throw std::runtime_error(
              "taxel " + taxel_name(model_.skin_, place.taxel) + " at the depth " +
              shortest(depth_.depth) + " lies too near below a contact of radius " +
              shortest(contact.radius) +
              " for an exact reading: take deeper taxels, or sampled readings");
      for (std::size_t q = 0; q < sums.size(); ++q) readings_[place.targets[q]] += sums[q];
    }
  }

  void add(const SampledPatch& patch) {
    const SurfaceGrid grid = grid_of(patch);
    const Rectangle rectangle{patch.spacing_y, patch.spacing_z};
    for (const Traction component : skin_tractions) {
      const std::vector<double>& own = values(patch, component);
      for (std::size_t i = 0; i < own.size(); ++i) {
        if (own[i] == 0.0) continue;
        const double y = grid.y(i / grid.columns);
        const double z = grid.z(i % grid.columns);
        for (const Place& place : depth_.places)
          for (std::size_t q = 0; q < place.quantities.size(); ++q)
            readings_[place.targets[q]] +=
                own[i] *
                depth_.kernel(place.quantities[q], component, rectangle, place.y - y, place.z - z);
      }
    }
  }

 private:
  bool add(const LoadPart& part, const Place& place, std::span<const double> tolerances,
           std::span<double> sums) {
    if (is_disc(part) && depth_.depth >= shallow * part.a)
      add_disc(part, place, sums);
    else if (!half_space_.add(part, place.y, place.z, place.quantities, tolerances, sums))
      return false;
    return !model_.material_.layer ||
           base_.add(part, place.y, place.z, place.quantities, tolerances, sums);
  }

  void add_disc(const LoadPart& part, const Place& place, std::span<double> sums) const {
    for (const Traction component : skin_tractions) {
      const double force = part.force[static_cast<std::size_t>(component)];
      if (force == 0.0) continue;
      const Disc disc{part.profile, part.a, force};
      for (std::size_t q = 0; q < sums.size(); ++q)
        sums[q] += disc_reading(place.quantities[q], component, model_.material_, disc,
                                depth_.depth, place.y - part.y, place.z - part.z);
    }
  }

  const ExactSkinModel& model_;
  const Depth& depth_;
  std::span<double> readings_;
  PartQuadrature half_space_;
  PartQuadrature base_;
};

ExactSkinModel::ExactSkinModel(const SkinArray& skin, const Material& material)
    : skin_(skin), material_(material) {
  check(skin, material);
  if (skin.curved) {
    curved_ = std::make_shared<const CurvedReadings>(skin, material);
    return;
  }
  std::map<double, std::size_t> depths;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> places;  // by depth and taxel
  for (std::size_t reading = 0; const Site& site : sites(skin)) {
    const auto [depth, is_new_depth] = depths.try_emplace(site.depth, depths_.size());
    if (is_new_depth) depths_.push_back({site.depth, SkinKernel(material, site.depth)});
    std::vector<Place>& own = depths_[depth->second].places;
    const auto [place, is_new_place] = places.try_emplace({depth->second, site.taxel}, own.size());
    if (is_new_place) own.push_back({site.y, site.z, site.taxel});
    own[place->second].quantities.push_back(site.quantity);
    own[place->second].targets.push_back(reading++);
  }
}

std::vector<double> ExactSkinModel::readings(std::span<const SkinLoad> loads) const {
  for (const SkinLoad& load : loads) {
    check(load);
    for (const Traction component : skin_tractions)
      if (has_traction(load, component))
        for (const Quantity quantity : skin_.reads) check_quantity(quantity, component, material_);
  }
  if (curved_) return curved_->readings(loads);
  std::vector<double> all(reading_count(skin_));
  for (const Depth& depth : depths_) {
    Summation sum(*this, depth, all);
    for (const SkinLoad& load : loads) std::visit([&](const auto& own) { sum.add(own); }, load);
  }
  return all;
}

std::vector<double> exact_readings(const SkinArray& skin, const Material& material,
                                   std::span<const SkinLoad> loads) {
  return ExactSkinModel(skin, material).readings(loads);
}

}  // namespace tactile_net
