#include "tactile_net/scene/scene.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "numeric/named.hpp"
#include "tactile_net/scene/scene_effects.hpp"
#include "tactile_net/scene/skin_scene.hpp"
#include "tactile_net/skin/signal_layout.hpp"

namespace tactile_net {

namespace {

constexpr Named<ForwardModel> forward_models[] = {{ForwardModel::sampled, "sampled"},
                                                  {ForwardModel::exact, "exact"}};

/// A contact is such at any time.
bool any_contact(const SceneKind auto& scene, const auto& is_such) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(), is_such) ||
         std::any_of(scene.trajectories.begin(), scene.trajectories.end(),
                     [&](const auto& trajectory) {
                       return std::any_of(trajectory.begin(), trajectory.end(),
                                          [&](const auto& knot) { return is_such(knot.contact); });
                     });
}

/// Whether the tangential traction is solved for too. @param dragged  by a contact, at any time
bool solves_tangential(const SceneKind auto& scene, bool dragged) {
  if (channel_count(scene.sensor) < 2) return false;
  const SharedReconstructOptions& options = scene.reconstruct;
  if (options.friction_limit) return true;
  return options.tangential.value_or(scene.contacts.empty() || dragged);
}

}  // namespace

bool any_friction(const Scene& scene) { return any_contact(scene, has_friction); }

bool any_drag(const SkinScene& scene) { return any_contact(scene, drags); }

std::string_view name(ForwardModel model) noexcept { return name_in<forward_models>(model); }

std::string_view name(Method method) noexcept { return name_in<Enumerators<Method>::all>(method); }

std::string_view name(AnswerKind kind) noexcept {
  return name_in<Enumerators<AnswerKind>::all>(kind);
}

std::optional<Method> method_named(std::string_view text) noexcept {
  return named_in<Enumerators<Method>::all>(text);
}

std::size_t unknowns(const Scene& scene) {
  return solves_tangential(scene, any_friction(scene)) ? 2 : 1;
}

std::size_t components(const SkinScene& scene) {
  return solves_tangential(scene, any_drag(scene)) ? 3 : 1;
}

Surface surface(const Scene& scene) { return surface_of(scene.sensor, scene.reconstruct.surface); }

SurfaceGrid grid(const SkinScene& scene) { return grid_of(scene.sensor, scene.reconstruct.grid); }

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

SkinScene of_circuit(SkinScene scene) {
  if (scene.network.spacing) scene.reconstruct.grid.spacing = scene.network.spacing;
  return scene;
}

std::vector<double> raw_numbers(const SharedScene& scene, std::span<const double> readings) {
  std::vector<double> raw(readings.begin(), readings.end());
  if (scene.calibration) uncalibrate(*scene.calibration, raw);
  return raw;
}

SignalPath signal_path(const Scene& scene) { return signal_path(scene, scene.sensor); }

SignalPath signal_path(const SkinScene& scene) {
  return signal_path(scene, signal_layout(scene.sensor));
}

}  // namespace tactile_net
