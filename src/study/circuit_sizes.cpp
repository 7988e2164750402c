#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "study/array_sizes.hpp"
#include "study/circuits.hpp"
#include "study/points.hpp"
#include "tactile_net/lab/circuit_options.hpp"
#include "tactile_net/network/state_space.hpp"
#include "tactile_net/skin/forward.hpp"

namespace tactile_net::study {
namespace {

/// Along the longer side; a circuit of twelve has a thousand states.
constexpr std::array<std::size_t, 5> circuit_sides = {2, 3, 4, 6, 8};

/// One traction of each kind above every taxel, and around them.
SkinScene circuit_of_size(const StudyInput& input, const ArraySize& size) {
  auto scene =
      std::get<SkinScene>(with_circuit(input, Realization::least_squares, compared_bandwidth));
  scene = with_size(std::move(scene), size);
  scene.network.spacing = std::max(scene.sensor.pitch_y, scene.sensor.pitch_z);
  return scene;
}

/// Without the sensor's errors, which are those of the study's own taxels.
std::vector<double> readings_of(const SkinScene& scene) {
  if (scene.contacts.empty()) return std::vector<double>(reading_count(scene.sensor), 1.0);
  return exact_readings(scene.sensor, scene.material, scene.contacts);
}

}  // namespace

StudySection circuit_sizes(const StudyInput& input, const Stop& stop) {
  StudySection section;
  const WorkCurve curve{.family = WorkCurve::Family::circuit,
                        .realization = Realization::least_squares,
                        .bandwidth = compared_bandwidth};
  for (const std::size_t side : circuit_sides) {
    if (stop()) return section;
    const ArraySize size = size_of(input.skin().scene(), side);
    const Knob knob{.kind = Knob::Kind::array, .rows = size.rows, .columns = size.columns};
    try {
      const SkinScene scene = circuit_of_size(input, size);
      const lab::SceneCircuit circuit(
          lab::circuit_source(lab::SkinSceneProblem(scene), readings_of(scene)),
          {.value = input.alpha});
      const StateSpace& system = circuit.network().state_space();
      const auto seconds = settling_time(system, one_percent, poles(system).front().real());
      WorkPoint result = failed(curve, knob, TimeOf::settling, {.kind = Failure::Kind::unsettled});
      if (seconds) {
        result.failure.reset();
        result.seconds = result.seconds_low = result.seconds_high = *seconds;
      }
      section.points.push_back(std::move(result));
    } catch (const std::exception&) {
      section.points.push_back(failed(curve, knob, TimeOf::settling, caught()));
    }
  }
  return section;
}

}  // namespace tactile_net::study
