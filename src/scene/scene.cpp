#include "tactile_net/scene/scene.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "numeric/named.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net {

bool any_friction(const Scene& scene) {
  const auto drags = [](const ContactTrajectory& trajectory) {
    return std::any_of(trajectory.begin(), trajectory.end(),
                       [](const ContactKnot& knot) { return has_friction(knot.contact); });
  };
  return std::any_of(scene.contacts.begin(), scene.contacts.end(),
                     [](const Contact& contact) { return has_friction(contact); }) ||
         std::any_of(scene.trajectories.begin(), scene.trajectories.end(), drags);
}

namespace {

constexpr Named<ForwardModel> forward_models[] = {{ForwardModel::sampled, "sampled"},
                                                  {ForwardModel::exact, "exact"}};
constexpr Named<Method> method_names[] = {{Method::dft, "dft"},
                                          {Method::tikhonov, "tikhonov"},
                                          {Method::closed_form, "closed_form"},
                                          {Method::network, "network"}};

}  // namespace

std::string_view name(ForwardModel model) noexcept { return name_in<forward_models>(model); }

std::string_view name(Method method) noexcept { return name_in<method_names>(method); }

std::optional<Method> method_named(std::string_view text) noexcept {
  return named_in<method_names>(text);
}

std::size_t unknowns(const Scene& scene) {
  if (channel_count(scene.sensor) < 2) return 1;
  const ReconstructOptions& options = scene.reconstruct;
  if (options.friction_limit) return 2;
  if (options.tangential) return *options.tangential ? 2 : 1;
  return scene.contacts.empty() || any_friction(scene) ? 2 : 1;
}

Surface surface(const Scene& scene) { return surface_of(scene.sensor, scene.reconstruct.surface); }

Scene of_circuit(Scene scene) {
  std::optional<double>& spacing = scene.network.spacing;
  if (!spacing) return scene;
  if (scene.reconstruct.surface.basis == SurfaceBasis::taxels)
    throw std::invalid_argument(
        "network.spacing applies to a grid, but the tractions lie at the taxels: surface = "
        "\"grid\"");
  scene.reconstruct.surface.spacing = std::exchange(spacing, std::nullopt);
  return scene;
}

std::vector<double> raw_numbers(const Scene& scene, std::span<const double> readings) {
  std::vector<double> raw(readings.begin(), readings.end());
  if (scene.calibration) uncalibrate(*scene.calibration, raw);
  return raw;
}

std::vector<Contact> contacts_at(const Scene& scene, double t) {
  std::vector<Contact> contacts = scene.contacts;
  for (std::size_t i = 0; i < scene.trajectories.size(); ++i)
    if (!scene.trajectories[i].empty()) contacts[i] = contact_at(scene.trajectories[i], t);
  return contacts;
}

Scene at_frame(Scene scene, std::size_t frame) {
  check_frame(scene.time, frame);
  scene.frame = frame;
  if (scene.time) scene.contacts = contacts_at(scene, scene.time->time(frame));
  return scene;
}

SignalPath signal_path(const Scene& scene) { return signal_path(scene, scene.sensor); }

std::vector<Instant> instants(const Scene& scene) {
  std::vector<double> knots;
  for (const ContactTrajectory& trajectory : scene.trajectories)
    for (const ContactKnot& knot : trajectory) knots.push_back(knot.time);
  return instants(scene, signal_path(scene), scene.time, scene.frame, knots);
}

}  // namespace tactile_net
