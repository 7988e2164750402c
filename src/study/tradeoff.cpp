#include "tactile_net/study/tradeoff.hpp"

#include <string>
#include <utility>

#include "tactile_net/study/processor.hpp"

namespace tactile_net::study {
namespace {

/// So that a study of minutes is not without its circuits for want of a program.
void check_simulator(const lab::SimulatorChoice& choice) {
  const std::vector<std::string> node = {"a"};
  (void)operating_point(*lab::make_simulator(choice), "a resistor\nI1 0 a 1\nR1 a 0 1\n.op\n.end\n",
                        node);
}

}  // namespace

Study tradeoff(const AnyScene& scene, const TradeoffOptions& options, StudyObserver& observer) {
  if (options.circuits) check_simulator(options.simulator);
  Study study{.input = study_input(scene)};
  study.processor = processor_name();
  study.clock = processor_clock(options.clock);
  std::vector<StudyJob> jobs = digital_jobs(study.input, options.clock);
  if (options.circuits)
    for (StudyJob& job :
         circuit_jobs(study.input, options.simulator, [&observer] { return observer.stop(); }))
      jobs.push_back(std::move(job));
  run_jobs(study, jobs, options.finished, options.clock, observer);
  return study;
}

}  // namespace tactile_net::study
