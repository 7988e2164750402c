#include "tactile_net/elasticity/material.hpp"

#include "elasticity/require.hpp"

namespace tactile_net {

void check(const Material& material) {
  require_positive("youngs_modulus", material.youngs_modulus);
  require(material.poisson_ratio >= 0.0 && material.poisson_ratio <= 0.5, "poisson_ratio",
          "lie in [0, 0.5]", material.poisson_ratio);
}

}  // namespace tactile_net
