#include "inverse/sections.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {
namespace {

constexpr double section_depths = 48.0;
constexpr double fewest_tractions = 256.0;  // of a section: less saves no time
constexpr double most_tractions = 768.0;
constexpr double fewest_taxels = 8.0;

}  // namespace

double Sections::weight(std::size_t s, double place) const noexcept {
  return risen(s, place) - risen(s + 1, place);
}

/// 0 before section s takes over from the one before it, 1 after: halfway between where that one
/// ends and s begins, over a third of a section, so that a sixth at either end has no say.
double Sections::risen(std::size_t s, double place) const noexcept {
  if (s == 0) return 1.0;
  if (s == starts.size()) return 0.0;
  const auto size = static_cast<double>(length);
  const double middle = 0.5 * (static_cast<double>(starts[s - 1] + starts[s]) + size - 1.0);
  const double way = std::clamp(3.0 * (place - middle) / size + 0.5, 0.0, 1.0);
  return std::pow(std::sin(0.5 * std::numbers::pi * way), 2);
}

Sections sections_of(const SensorArray& array, const LineProblemOptions& options) {
  check(array);
  require_even(array, "a division into sections");
  const double depth = *std::max_element(array.depths.begin(), array.depths.end());
  const auto per_taxel =
      static_cast<double>(options.unknowns * surface_of(array, options.surface).stride);
  const double wanted =
      std::max(std::clamp(section_depths * depth / array.pitch, fewest_tractions / per_taxel,
                          most_tractions / per_taxel),
               fewest_taxels);
  const auto count = static_cast<double>(array.count);
  if (count <= 1.25 * wanted) return {array.count, {0}};

  Sections sections{.length = static_cast<std::size_t>(std::ceil(wanted))};
  const auto length = static_cast<double>(sections.length);
  const double steps = std::ceil((count - length) / (length / 3.0));
  for (double s = 0.0; s <= steps; ++s)
    sections.starts.push_back(static_cast<std::size_t>(std::round(s * (count - length) / steps)));
  return sections;
}

}  // namespace tactile_net
