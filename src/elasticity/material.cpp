#include "tactile_net/elasticity/material.hpp"

#include "numeric/named.hpp"
#include "numeric/require.hpp"

namespace tactile_net {
namespace {

constexpr Named<Base> bases[] = {{Base::bonded, "bonded"}, {Base::frictionless, "frictionless"}};

}  // namespace

std::string_view name(Base base) noexcept { return name_in<bases>(base); }

void check(const Material& material) {
  require_positive("youngs_modulus", material.youngs_modulus);
  require(material.poisson_ratio >= 0.0 && material.poisson_ratio <= 0.5, "poisson_ratio",
          "lie in [0, 0.5]", material.poisson_ratio);
  if (material.layer) require_positive("layer.thickness", material.layer->thickness);
}

void check_depth(const Material& material, double depth) {
  require_positive("depth", depth);
  if (material.layer)
    require(depth <= material.layer->thickness, "depth", "be at most the layer's thickness", depth);
}

}  // namespace tactile_net
