/// @file
/// Private. Axes of plots, in a scene's units.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/scene/scene.hpp"

namespace tactile_net::pages {

/// A label with its unit, and what the axis' values are multiplied by.
struct PlotAxis {
  std::string label{};  ///< "traction [kPa]"; without [units] "traction [unit of E]"
  double factor = 1.0;

  [[nodiscard]] std::vector<double> operator()(std::vector<double> values) const;
};

/// With the prefix that suits the largest of all `values`; those that are not finite do not count.
[[nodiscard]] PlotAxis axis(const std::optional<Units>& units, const std::string& what,
                            Dimension dimension,
                            std::initializer_list<const std::vector<double>*> values);

}  // namespace tactile_net::pages
