#include "tactile_net/sensing/aperture.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "numeric/require.hpp"

namespace tactile_net {

Aperture::Aperture(double width, double depth) {
  require_finite("width", width);
  require(width >= 0.0, "width", "be >= 0", width);
  require_positive("depth", depth);
  require(width <= 1e4 * depth, "width", "be at most 10000 depths, " + shortest(1e4 * depth),
          width);
  if (width == 0.0) return;

  using Rule = boost::math::quadrature::gauss<double, 10>;
  const double panels = std::ceil(2.0 * width / depth);
  const double half = 0.5 * width / panels;
  nodes_.clear();
  for (double panel = 1.0 - panels; panel < panels; panel += 2.0)
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      const double weight = 0.5 / panels * Rule::weights()[i];
      nodes_.push_back({.offset = (panel - Rule::abscissa()[i]) * half, .weight = weight});
      nodes_.push_back({.offset = (panel + Rule::abscissa()[i]) * half, .weight = weight});
    }
}

}  // namespace tactile_net
