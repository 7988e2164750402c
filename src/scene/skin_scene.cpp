#include "tactile_net/scene/skin_scene.hpp"

#include <algorithm>
#include <utility>

namespace tactile_net {
namespace {

bool any_drag(const SkinScene& scene) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(), drags) ||
         std::any_of(scene.trajectories.begin(), scene.trajectories.end(),
                     [](const SkinContactTrajectory& trajectory) {
                       return std::any_of(
                           trajectory.begin(), trajectory.end(),
                           [](const SkinContactKnot& knot) { return drags(knot.contact); });
                     });
}

Unit unit_of(const Units& units, SkinQuantity quantity) {
  switch (traits(quantity).kind) {
    case QuantityKind::stress:
      return units.stress;
    case QuantityKind::displacement:
      return units.length;
    case QuantityKind::strain:
      break;
  }
  return {};
}

}  // namespace

std::size_t components(const SkinScene& scene) {
  if (channel_count(scene.sensor) < 2) return 1;
  const SkinReconstructOptions& options = scene.reconstruct;
  if (options.friction_limit) return 3;
  if (options.tangential) return *options.tangential ? 3 : 1;
  return scene.contacts.empty() || any_drag(scene) ? 3 : 1;
}

SkinGrid grid(const SkinScene& scene) { return grid_of(scene.sensor, scene.reconstruct.grid); }

std::vector<SkinLoad> contacts_at(const SkinScene& scene, double t) {
  std::vector<SkinLoad> contacts = scene.contacts;
  for (std::size_t i = 0; i < scene.trajectories.size(); ++i)
    if (!scene.trajectories[i].empty()) contacts[i] = contact_at(scene.trajectories[i], t);
  return contacts;
}

SkinScene at_frame(SkinScene scene, std::size_t frame) {
  check_frame(scene.time, frame);
  scene.frame = frame;
  if (scene.time) scene.contacts = contacts_at(scene, scene.time->time(frame));
  return scene;
}

std::optional<Calibration> calibration(const SkinScene& scene) {
  if (!scene.units) return std::nullopt;
  Calibration result;
  for (const SkinSite& site : sites(scene.sensor))
    result.gain.push_back(unit_of(*scene.units, site.quantity).to_si(1.0));
  result.baseline.resize(result.gain.size());
  result.offset.resize(result.gain.size());
  return result;
}

std::vector<double> raw_numbers(const SkinScene& scene, std::span<const double> readings) {
  std::vector<double> raw(readings.begin(), readings.end());
  if (const auto units = calibration(scene)) uncalibrate(*units, raw);
  return raw;
}

}  // namespace tactile_net
