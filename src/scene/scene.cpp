#include "tactile_net/scene/scene.hpp"

#include <algorithm>

namespace tactile_net {

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

std::vector<std::pair<std::string_view, bool>> effects(const Scene& scene) {
  const bool friction = std::any_of(scene.contacts.begin(), scene.contacts.end(),
                                    [](const Contact& contact) { return has_friction(contact); });
  return {{"layer", false},
          {"friction", friction},
          {"noise", scene.noise.has_value()},
          {"quantization", scene.quantization.has_value()},
          {"dead_taxels", !scene.dead_taxels.empty()}};
}

}  // namespace tactile_net
