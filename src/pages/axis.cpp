#include "pages/axis.hpp"

#include <algorithm>
#include <cmath>

#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::pages {

std::vector<double> PlotAxis::operator()(std::vector<double> values) const {
  if (factor != 1.0)
    for (double& value : values) value *= factor;
  return values;
}

PlotAxis axis(const std::optional<Units>& units, const std::string& what, Dimension dimension,
              std::initializer_list<const std::vector<double>*> values) {
  double largest = 0.0;
  for (const std::vector<double>* some : values)
    for (const double value : *some)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  const ScaledUnit unit = report::axis_unit(units, dimension, largest);
  return {what + (unit.label.empty() ? "" : " [" + unit.label + "]"), unit.factor};
}

}  // namespace tactile_net::pages
