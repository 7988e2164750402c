#include "tactile_net/sensing/resampled.hpp"

#include <cmath>

namespace tactile_net {

std::vector<double> resampled(std::span<const double> tractions, const Surface& from,
                              const Surface& to) {
  std::vector<double> values;
  for (std::size_t first = 0; first < tractions.size(); first += from.count) {
    const std::span<const double> own = tractions.subspan(first, from.count);
    // Hats fall to 0 one spacing beyond the outermost points.
    const auto value = [&](double point) {
      return point >= 0.0 && point < static_cast<double>(own.size())
                 ? own[static_cast<std::size_t>(point)]
                 : 0.0;
    };
    for (std::size_t i = 0; i < to.count; ++i) {
      const double place = (to.position(i) - from.position(0)) / from.spacing;
      const double left = std::floor(place);
      values.push_back(std::lerp(value(left), value(left + 1.0), place - left));
    }
  }
  return values;
}

}  // namespace tactile_net
