#include "tactile_net/scene/skin_size.hpp"

namespace tactile_net {

std::size_t most_tractions(const SkinScene& scene) {
  return is_even(scene.sensor) && !scene.reconstruct.offset ? most_large_skin_tractions
                                                            : most_skin_tractions;
}

bool is_large(const SkinScene& scene) {
  return components(scene) * grid(scene).count() > most_skin_tractions;
}

}  // namespace tactile_net
