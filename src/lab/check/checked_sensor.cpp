#include "lab/check/checked_sensor.hpp"

#include <algorithm>
#include <cmath>

#include "tactile_net/lab/scene_problem.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/skin/signal_layout.hpp"

namespace tactile_net::lab {
namespace {

/// What lines and skins have alike.
///
/// @param tractions  at each place of the surface: 1, the pressure, or more
template <typename AnyScene, typename Channels>
CheckedSensor common(const AnyScene& scene, const Channels& channels, std::size_t tractions) {
  CheckedSensor sensor{.dead_taxels = scene.dead_taxels,
                       .reads_pressure = tractions == 1,
                       .offset = scene.reconstruct.offset,
                       .youngs_modulus = scene.material.youngs_modulus};
  for (const auto& channel : channels) {
    sensor.names.push_back(channel.name);
    const Quantity quantity = channel.quantity;
    if (!is_odd(quantity, Traction::normal, Axis::y) &&
        !is_odd(quantity, Traction::normal, Axis::z))
      sensor.reads_pressure = true;
    const std::optional<double> rms =
        scene.noise ? std::optional(scene.noise->rms.at(channel.quantity)) : std::nullopt;
    sensor.stated.push_back(rms);
    sensor.weights.push_back(rms && scene.noise->weights_rows ? 1.0 / *rms : 1.0);
  }
  return sensor;
}

/// Between taxels further apart than that a load's readings may have a valley.
constexpr double most_depths = 1.0 + 1e-9;
constexpr double wide_in_depths = 2.0;

}  // namespace

CheckedSensor checked_sensor(const Scene& scene) {
  CheckedSensor sensor = common(scene, channels(scene.sensor), unknowns(scene));
  sensor.layout = SignalLayout(scene.sensor);
  sensor.noise = SceneProblem(scene).stated_noise();
  const std::vector<Site> all = sites(scene.sensor);
  for (const Site& one : all)
    sensor.is_wide =
        sensor.is_wide || std::abs(one.y - all.front().y) >= wide_in_depths * one.depth;
  for (const auto& [a, b] : sensor.layout.neighbours)
    sensor.apart.push_back(std::abs(all[b].y - all[a].y));
  sensor.around.resize(all.size());
  const double reach = 2.0 * most_depths * least_depth(scene.sensor);
  for (const Channel& channel : sensor.layout.channels)
    for (std::size_t k = 1; k + 1 < channel.count; ++k) {
      const std::size_t i = channel.first + k;
      if (all[i + 1].y - all[i - 1].y > reach) continue;
      sensor.around[i].beside = {i - 1, i + 1};
      if (k >= 2) sensor.around[i].behind.push_back(i - 2);
      if (k + 2 < channel.count) sensor.around[i].behind.push_back(i + 2);
    }
  return sensor;
}

CheckedSensor checked_sensor(const SkinScene& scene) {
  CheckedSensor sensor = common(scene, channels(scene.sensor), components(scene));
  sensor.layout = signal_layout(scene.sensor);
  sensor.has_columns = true;
  sensor.noise = SkinSceneProblem(scene).stated_noise();
  const std::vector<Site> all = sites(scene.sensor);
  for (const Site& one : all)
    sensor.is_wide = sensor.is_wide || std::hypot(one.y - all.front().y, one.z - all.front().z) >=
                                           wide_in_depths * one.depth;
  std::vector<std::vector<std::size_t>> near(all.size());
  for (const auto& [a, b] : sensor.layout.neighbours) {
    sensor.apart.push_back(std::hypot(all[b].y - all[a].y, all[b].z - all[a].z));
    near[a].push_back(b);
    near[b].push_back(a);
  }
  sensor.around.resize(all.size());
  const double reach = most_depths * least_depth(scene.sensor);
  for (std::size_t i = 0; i < all.size(); ++i) {
    // At an edge a load may lie beyond the taxel's neighbours and not beyond
    // it.
    const bool inside =
        near[i].size() >= (scene.sensor.rows > 1 && scene.sensor.columns > 1 ? 4 : 2);
    const bool dense = std::all_of(near[i].begin(), near[i].end(), [&](std::size_t k) {
      return std::hypot(all[k].y - all[i].y, all[k].z - all[i].z) <= reach;
    });
    if (!inside || !dense) continue;
    sensor.around[i].beside = near[i];
    for (const std::size_t k : near[i])
      for (const std::size_t far : near[k])
        if (far != i) sensor.around[i].behind.push_back(far);
  }
  return sensor;
}

std::vector<double> reading_weights(const CheckedSensor& sensor) {
  std::vector<double> weights;
  for (const Site& reading : sensor.layout.readings)
    weights.push_back(sensor.weights[reading.channel]);
  return weights;
}

}  // namespace tactile_net::lab
