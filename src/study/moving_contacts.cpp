#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "study/circuits.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/lab/moved_contacts.hpp"
#include "tactile_net/network/motion.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/skin/forward.hpp"

namespace tactile_net::study {
namespace {

std::vector<double> solved(const StudyInput& input, const lab::SceneProblem& line,
                           const std::vector<double>& readings) {
  return tikhonov_solve(line.problem(), input.alpha, readings);
}
std::vector<double> solved(const StudyInput& input, const lab::SkinSceneProblem& skin,
                           const std::vector<double>& readings) {
  return skin.family().solve(skin.family().analyse(readings), input.alpha);
}

/// The answer to contacts moved by so much, without the sensor's errors.
std::vector<double> answer(const StudyInput& input, double by) {
  return std::visit(
      [&](const auto& problem) {
        const auto& scene = problem.scene();
        return solved(input, problem,
                      exact_readings(scene.sensor, scene.material, lab::moved(scene.contacts, by)));
      },
      input.problem);
}

void add_displacements(MovingContacts& moving, const StudyInput& input) {
  const std::vector<double> here = answer(input, 0.0);
  const double depth =
      input.with_scene([](const auto& scene) { return least_depth(scene.sensor); });
  // From where the answer moves in proportion to where contacts have left their place.
  for (int k = -12; k <= 4; ++k) {
    const double displacement = depth * std::pow(10.0, 0.25 * k);
    moving.displacements.push_back(displacement);
    moving.errors.push_back(relative_l2_error(answer(input, -displacement), here));
  }
}

}  // namespace

StudySection moving_contacts(const StudyInput& input, std::span<const Realization> circuits,
                             const Stop& stop) {
  StudySection section;
  if (input.with_scene([](const auto& scene) { return scene.contacts.empty(); })) return section;
  MovingContacts moving;
  add_displacements(moving, input);
  for (const Realization realization : circuits) {
    if (stop()) return section;
    const AnyScene scene = with_circuit(input, realization, compared_bandwidth);
    if (!is_small(scene)) continue;
    const lab::SceneCircuit circuit = circuit_of(input, scene);
    if (!(circuit.network().poles().front().real() < 0.0)) continue;
    const MotionLag lag = motion_lag(circuit.network(), circuit.readings_per_length());
    if (lag.seconds > 0.0)
      moving.followers.push_back({.realization = realization, .delay = lag.seconds});
  }
  for (const double hertz : compared_loops)
    moving.followers.push_back({.sampling_hertz = hertz, .delay = 0.5 / hertz});
  section.moving = std::move(moving);
  return section;
}

}  // namespace tactile_net::study
