#include "tactile_net/scene/skin_scene.hpp"

#include <algorithm>
#include <utility>

#include "tactile_net/skin/signal_layout.hpp"

namespace tactile_net {
bool any_drag(const SkinScene& scene) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(), drags) ||
         std::any_of(scene.trajectories.begin(), scene.trajectories.end(),
                     [](const SkinContactTrajectory& trajectory) {
                       return std::any_of(
                           trajectory.begin(), trajectory.end(),
                           [](const SkinContactKnot& knot) { return drags(knot.contact); });
                     });
}

std::size_t components(const SkinScene& scene) {
  if (channel_count(scene.sensor) < 2) return 1;
  const SkinReconstructOptions& options = scene.reconstruct;
  if (options.friction_limit) return 3;
  if (options.tangential) return *options.tangential ? 3 : 1;
  return scene.contacts.empty() || any_drag(scene) ? 3 : 1;
}

SurfaceGrid grid(const SkinScene& scene) { return grid_of(scene.sensor, scene.reconstruct.grid); }

SkinScene of_circuit(SkinScene scene) {
  if (scene.network.spacing) scene.reconstruct.grid.spacing = scene.network.spacing;
  return scene;
}

SignalPath signal_path(const SkinScene& scene) {
  return signal_path(scene, signal_layout(scene.sensor));
}

std::vector<Instant> instants(const SkinScene& scene) {
  std::vector<double> knots;
  for (const SkinContactTrajectory& trajectory : scene.trajectories)
    for (const SkinContactKnot& knot : trajectory) knots.push_back(knot.time);
  return instants(scene, signal_path(scene), scene.time, scene.frame, knots);
}

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

std::vector<double> raw_numbers(const SkinScene& scene, std::span<const double> readings) {
  std::vector<double> raw(readings.begin(), readings.end());
  if (scene.calibration) uncalibrate(*scene.calibration, raw);
  return raw;
}

}  // namespace tactile_net
