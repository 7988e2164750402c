#include <algorithm>
#include <utility>
#include <vector>

#include "tactile_net/scene/sensor_effects.hpp"

namespace tactile_net {
namespace {

/// Puts moments in order and makes one of those that rounding alone tells apart.
void merge(std::vector<Instant>& instants, double apart) {
  std::stable_sort(instants.begin(), instants.end(),
                   [](const Instant& a, const Instant& b) { return a.time < b.time; });
  std::vector<Instant> merged;
  for (const Instant& instant : instants) {
    if (merged.empty() || instant.time - merged.back().time > apart) {
      merged.push_back(instant);
      continue;
    }
    Instant& same = merged.back();
    if (instant.recorded && !same.recorded) same.time = instant.time;
    same.recorded = same.recorded || instant.recorded;
    same.opens = same.opens || instant.opens;
  }
  instants = std::move(merged);
}

}  // namespace

std::vector<Instant> instants(const SensorEffects& effects, const SignalPath& path,
                              const std::optional<Timing>& time, std::size_t frame,
                              std::span<const double> knots) {
  if (!time) return {Instant{}};
  std::vector<Instant> result;
  for (std::size_t k = 0; k <= frame; ++k)
    result.push_back({.time = time->time(k), .recorded = true});
  if (path.has_memory()) {
    const auto between = [&](double t, bool opens) {
      if (t > 0.0 && t < time->time(frame))
        result.push_back({.time = t, .recorded = false, .opens = opens});
    };
    for (const double t : knots) between(t, false);
    if (effects.temperature)
      for (const double t : effects.temperature->change.times) between(t, false);
    if (effects.sampling && effects.sampling->aperture > 0.0)
      for (std::size_t k = 1; k <= frame; ++k)
        between(time->time(k) - effects.sampling->aperture, true);
    merge(result, 1e-9 / time->rate);
  }
  for (std::size_t i = 1; i < result.size(); ++i)
    result[i].since = result[i].time - result[i - 1].time;
  return result;
}

}  // namespace tactile_net
