#include "tactile_net/sensing/aperture.hpp"

#include <cmath>

#include "numeric/gauss_rule.hpp"
#include "numeric/require.hpp"

namespace tactile_net {

Aperture::Aperture(double width, double depth) {
  require_finite("width", width);
  require(width >= 0.0, "width", "be >= 0", width);
  require_positive("depth", depth);
  require(width <= most_depths * depth, "width",
          "be at most 10000 depths, " + shortest(most_depths * depth), width);
  width_ = width;
  if (width == 0.0) return;

  const GaussRule rule = gauss_rule<10>();
  const double panels = std::ceil(2.0 * width / depth);
  const double half = 0.5 * width / panels;
  nodes_.clear();
  const auto add = [&](double place, double weight) {
    nodes_.push_back({.offset = place * half, .weight = 0.5 / panels * weight});
    nodes_.push_back({.offset = -place * half, .weight = 0.5 / panels * weight});
  };
  for (double panel = panels - 1.0; panel >= 0.0; panel -= 2.0)  // and those mirrored about 0
    for (std::size_t i = 0; i < rule.abscissa.size(); ++i) {
      if (panel > 0.0) add(panel - rule.abscissa[i], rule.weights[i]);
      add(panel + rule.abscissa[i], rule.weights[i]);
    }
}

double Aperture::transform(double wavenumber) const noexcept {
  const double half = 0.5 * wavenumber * width_;
  return half == 0.0 ? 1.0 : std::sin(half) / half;
}

}  // namespace tactile_net
