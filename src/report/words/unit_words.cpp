#include "tactile_net/report/words/unit_words.hpp"

#include <algorithm>
#include <string_view>

#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::report {
namespace {

/// What a number is a multiple of where any consistent set of units will do.
std::string_view own_unit(Dimension dimension) noexcept {
  switch (dimension) {
    case Dimension::none:
      return "";
    case Dimension::length:
      return "unit of length";
    case Dimension::stress:
      return "unit of E";
    case Dimension::force:
      return "unit of E x length";
    case Dimension::point_force:
      return "unit of E x length^2";
    case Dimension::moment:
      return "unit of E x length^3";
  }
  return "";
}

}  // namespace

ScaledUnit axis_unit(const std::optional<Units>& units, Dimension dimension, double largest) {
  if (!units) return {.label = std::string(own_unit(dimension))};
  return scaled_unit(largest, si_unit(dimension));
}

ScaledUnit axis_unit(const Scene& scene, Dimension dimension, double largest) {
  return axis_unit(scene.units, dimension, largest);
}

std::string in_unit(const std::optional<Units>& units, Dimension dimension, double number) {
  return units ? with_unit(number, si_unit(dimension)) : brief(number);
}

std::string in_unit(const Scene& scene, Dimension dimension, double number) {
  return in_unit(scene.units, dimension, number);
}

std::string in_unit(const std::optional<Units>& units, Dimension dimension, double value,
                    double deviation) {
  return units ? with_unit(value, deviation, si_unit(dimension)) : plus_minus(value, deviation);
}

std::string in_unit(const Scene& scene, Dimension dimension, double value, double deviation) {
  return in_unit(scene.units, dimension, value, deviation);
}

Dimension residual_dimension(const Scene& scene) noexcept {
  const auto& reads = scene.sensor.reads;
  const bool weighted = scene.noise && scene.noise->weights_rows;
  return weighted || std::any_of(reads.begin(), reads.end(), is_strain) ? Dimension::none
                                                                        : Dimension::stress;
}

Dimension residual_dimension(const SkinScene& scene) noexcept {
  // Kinds of readings are mixed only where they are divided by their noise.
  const bool weighted = scene.noise && scene.noise->weights_rows;
  return weighted ? Dimension::none : dimension_of(traits(scene.sensor.reads.front()).kind);
}

}  // namespace tactile_net::report
