#include "tactile_net/scene/scene.hpp"

#include <algorithm>

namespace tactile_net {
namespace {

bool any_friction(const Scene& scene) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(),
                     [](const Contact& contact) { return has_friction(contact); });
}

}  // namespace

std::string_view name(ForwardModel model) noexcept {
  switch (model) {
    case ForwardModel::sampled:
      return "sampled";
    case ForwardModel::exact:
      return "exact";
  }
  return "";
}

std::string_view name(Method method) noexcept {
  switch (method) {
    case Method::dft:
      return "dft";
    case Method::tikhonov:
      return "tikhonov";
    case Method::closed_form:
      return "closed_form";
    case Method::network:
      return "network";
  }
  return "";
}

std::optional<Method> method_named(std::string_view text) noexcept {
  for (const Method method : {Method::dft, Method::tikhonov, Method::closed_form, Method::network})
    if (name(method) == text) return method;
  return std::nullopt;
}

std::size_t unknowns(const Scene& scene) {
  if (scene.sensor.reads.size() * scene.sensor.depths.size() < 2) return 1;
  const ReconstructOptions& options = scene.reconstruct;
  if (options.friction_limit) return 2;
  if (options.tangential) return *options.tangential ? 2 : 1;
  return scene.contacts.empty() || any_friction(scene) ? 2 : 1;
}

std::vector<std::pair<std::string_view, bool>> effects(const Scene& scene) {
  const bool friction = any_friction(scene);
  return {{"layer", scene.material.layer.has_value()},
          {"friction", friction},
          {"noise", scene.noise.has_value()},
          {"quantization", scene.quantization.has_value()},
          {"dead_taxels", !scene.dead_taxels.empty()}};
}

}  // namespace tactile_net
