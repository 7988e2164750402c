#include <exception>
#include <memory>

#include "study/circuits.hpp"
#include "study/points.hpp"
#include "tactile_net/lab/circuit_options.hpp"
#include "tactile_net/study/jobs.hpp"

namespace tactile_net::study {

Scene with_circuit(const StudyInput& input, Realization realization,
                   std::optional<double> bandwidth) {
  Scene scene = input.scene();
  scene.network.tolerance.reset();
  scene.network.spacing.reset();  // its answer stands beside the scene's own
  scene.network.realization = realization;
  if (bandwidth) lab::give_bandwidth(scene.network, *bandwidth);
  scene.network.settling_accuracy.reset();
  return scene;
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
  // The longest first: two run at a time.
  for (const Realization realization :
       {Realization::least_squares, Realization::nic, Realization::crossbar, Realization::lattice,
        Realization::rail})
    add({Kind::settling, realization}, 20.0, [&input, stop, realization](Simulator& simulator) {
      return settling(input, realization, simulator, stop);
    });
  add({Kind::settling, Realization::ideal}, 5.0,
      [&input, stop](Simulator& simulator) { return passive_settling(input, simulator, stop); });
  add({Kind::parts}, 2.0, [&input, stop](Simulator&) { return parts_floors(input, stop); });
  add({Kind::operating_points}, 2.0,
      [&input](Simulator& simulator) { return operating_points(input, simulator); });
  return jobs;
}

}  // namespace tactile_net::study
