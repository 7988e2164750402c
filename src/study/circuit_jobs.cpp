#include <algorithm>
#include <exception>
#include <memory>
#include <span>
#include <string>

#include "study/circuits.hpp"
#include "study/points.hpp"
#include "tactile_net/lab/circuit_options.hpp"
#include "tactile_net/lab/skin_network.hpp"
#include "tactile_net/study/jobs.hpp"

namespace tactile_net::study {
namespace {

void leave_out_constraints(Scene&) {}  // circuits of lines do not read them
void leave_out_constraints(SkinScene& scene) {
  scene.reconstruct.nonnegative = false;
  scene.reconstruct.friction_limit.reset();
}

/// Cells of a skin that leave a circuit of that kind small enough.
void widen_cells(Scene&, Realization) {}
void widen_cells(SkinScene& scene, Realization realization) {
  const std::size_t readings = reading_count(scene.sensor);
  if (!lab::too_large(realization, components(scene) * grid(scene).count(), readings)) return;
  // Margins stay as wide as they are: alpha does not follow the spacing.
  scene.network.spacing = std::max(scene.sensor.pitch_y, scene.sensor.pitch_z);
}

std::size_t nodes_of(const SkinScene& skin) {
  return components(skin) * grid(of_circuit(skin)).count();
}

/// Which are worth a minute: the longest first, since two run at a time.
constexpr Realization of_lines[] = {Realization::least_squares, Realization::nic,
                                    Realization::crossbar, Realization::lattice, Realization::rail};
constexpr Realization of_skins[] = {Realization::least_squares, Realization::lattice};

}  // namespace

NetworkOptions& network_of(AnyScene& scene) {
  return std::visit([](auto& one) -> NetworkOptions& { return one.network; }, scene);
}

bool is_small(const AnyScene& scene) {
  const auto* const skin = std::get_if<SkinScene>(&scene);
  if (skin == nullptr) return true;
  return !lab::too_large(skin->network.realization, nodes_of(*skin), reading_count(skin->sensor)) &&
         nodes_of(*skin) + reading_count(skin->sensor) <= most_drawn_amplifiers;
}

std::string why_not_drawn(const AnyScene& scene) {
  const auto& skin = std::get<SkinScene>(scene);
  return "no operating point by ngspice and no draws of its parts: its " +
         std::to_string(nodes_of(skin)) + " nodes and " +
         std::to_string(reading_count(skin.sensor)) + " residuals are more than " +
         std::to_string(most_drawn_amplifiers) + ", of which either takes minutes";
}

AnyScene with_circuit(const StudyInput& input, Realization realization,
                      std::optional<double> bandwidth) {
  return input.with_scene([&](auto scene) -> AnyScene {
    scene.network.tolerance.reset();
    scene.network.spacing.reset();  // its answer stands beside the scene's own
    scene.network.realization = realization;
    if (bandwidth) lab::give_bandwidth(scene.network, *bandwidth);
    scene.network.settling_accuracy.reset();
    leave_out_constraints(scene);
    widen_cells(scene, realization);
    return scene;
  });
}

lab::SceneCircuit circuit_of(const StudyInput& input, const AnyScene& scene) {
  if (!input.is_skin())
    return {lab::SceneFrame(lab::SceneProblem(std::get<Scene>(scene)), input.readings),
            {.value = input.alpha}};
  return {lab::circuit_source(lab::SkinSceneProblem(std::get<SkinScene>(scene)), input.readings),
          {.value = input.alpha}};
}

WorkCurve curve_of(const StudyInput& input, const AnyScene& scene,
                   std::optional<double> bandwidth) {
  WorkCurve curve{.family = WorkCurve::Family::circuit, .bandwidth = bandwidth};
  std::visit([&](const auto& one) { curve.realization = one.network.realization; }, scene);
  if (!input.is_skin()) return curve;
  const auto& skin = std::get<SkinScene>(scene);
  if (skin.network.spacing) curve.tractions = components(skin) * grid(of_circuit(skin)).count();
  return curve;
}

std::vector<StudyJob> circuit_jobs(const StudyInput& input, const lab::SimulatorChoice& choice,
                                   const std::function<bool()>& stop) {
  std::vector<StudyJob> jobs;
  const auto add = [&](const Job& job, double weight, const auto& work) {
    jobs.push_back({.job = job, .weight = weight, .timed = false, .run = [=] {
                      StudySection section;
                      try {
                        section = work(*lab::make_simulator(choice));
                      } catch (const std::exception&) {
                        section.points.push_back(
                            failed({.family = WorkCurve::Family::job, .job = job}, {},
                                   TimeOf::settling, caught()));
                      }
                      section.job = job;
                      return section;
                    }});
  };
  using Kind = Job::Kind;
  const auto realizations_of = input.is_skin() ? std::span<const Realization>(of_skins)
                                               : std::span<const Realization>(of_lines);
  for (const Realization realization : realizations_of)
    add({Kind::settling, realization}, 20.0, [&input, stop, realization](Simulator& simulator) {
      return settling(input, realization, simulator, stop);
    });
  if (!input.is_skin())
    add({Kind::settling, Realization::ideal}, 5.0,
        [&input, stop](Simulator& simulator) { return passive_settling(input, simulator, stop); });
  else if (is_even(input.skin().scene().sensor))
    add({Kind::circuit_sizes}, 10.0,
        [&input, stop](Simulator&) { return circuit_sizes(input, stop); });
  add({Kind::parts}, 2.0, [&input, stop](Simulator&) { return parts_floors(input, stop); });
  add({Kind::moving}, 2.0, [&input, stop, realizations_of](Simulator&) {
    return moving_contacts(input, realizations_of, stop);
  });
  add({Kind::operating_points}, 2.0,
      [&input](Simulator& simulator) { return operating_points(input, simulator); });
  return jobs;
}

}  // namespace tactile_net::study
