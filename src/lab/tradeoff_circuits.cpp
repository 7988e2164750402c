#include <algorithm>
#include <cmath>

#include "tactile_net/lab/circuit_options.hpp"
#include "tactile_net/lab/observer.hpp"
#include "tactile_net/lab/relaxation.hpp"
#include "tactile_net/lab/tradeoff.hpp"
#include "tactile_net/network/state_space.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/scene_words.hpp"

namespace tactile_net::lab {
namespace {

constexpr double levels[] = {0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4, 1e-4};

Scene with(const StudyInput& input, Realization realization, std::optional<double> bandwidth) {
  Scene scene = input.scene;
  scene.network.tolerance.reset();
  scene.network.realization = realization;
  if (bandwidth) give_bandwidth(scene, *bandwidth);
  scene.network.settling_accuracy.reset();
  return scene;
}

WorkPoint empty_point(std::string curve, std::string knob, TimeOf time_of) {
  WorkPoint result;
  result.curve = std::move(curve);
  result.knob = std::move(knob);
  result.time_of = time_of;
  return result;
}

/// The answer once it is off f* by a share of its 2-norm: its error to the truth is bounded by
/// both.
WorkPoint settled(const std::string& curve, double level, double seconds, bool by_poles) {
  WorkPoint result = empty_point(curve, "settled to " + brief(level), TimeOf::settling);
  if (by_poles) result.knob += ", by its poles";
  result.seconds = result.seconds_low = result.seconds_high = seconds;
  result.error_to_solution = level;
  return result;
}

/// A circuit's answer to a step of all its inputs: when it has come within each level of f*.
void add_settling(StudySection& section, const std::string& curve, CircuitPlan plan,
                  Simulator& simulator, const Observer& observer) {
  plan.options.settling_accuracy = levels[std::size(levels) - 1];
  const auto failed = [&](std::string why) {
    WorkPoint result = empty_point(curve, "", TimeOf::settling);
    result.failure = std::move(why);
    section.points.push_back(std::move(result));
  };
  const Certificate certificate = certify(plan);
  if (certificate.stability != Stability::stable || !certificate.dynamics) {
    failed("no settling: " + std::string(name(certificate.stability)));
    return;
  }
  const std::optional<double> last = certificate.dynamics->settling_seconds;
  if (!last || !(*last > 0.0)) {
    failed(last ? "it takes no time" : "it does not settle");
    return;
  }
  if (observer.stop()) return;
  const StateSpace system = state_space(plan.circuit);
  std::vector<double> end = plan.direct;
  for (double& value : end) value *= plan.options.parts.scale.volts;
  try {
    // Ten steps to the first level, but not beyond what ngspice can bear.
    const double stop = 1.2 * *last;
    const double step = stop / 4000.0;
    const std::vector<double> errors = step_errors(system, 4.0 * step, 1000);
    const auto instant = [&](double level) {  // when the error is within it for good
      const auto late =
          std::find_if(errors.rbegin(), errors.rend(), [=](double error) { return error > level; });
      return 4.0 * step * static_cast<double>(errors.rend() - late);
    };
    const Waveforms waveforms = step_response(
        simulator, plan.circuit,
        {.step = std::clamp(instant(levels[0]) / 10.0, step, stop / 400.0), .stop = stop});
    for (const double level : levels) {
      if (instant(level) == 0.0) continue;  // what the first instant reaches takes no time
      if (const auto seconds = settling_time(waveforms, end, level))
        section.points.push_back(settled(curve, level, *seconds, false));
    }
  } catch (const SimulatorError& error) {
    if (error.cause() != SimulatorError::Cause::timed_out) throw;
    for (const double level : levels)
      if (const auto seconds = settling_time(system, level, certificate.dynamics->slowest);
          seconds.value_or(0.0) > 0.0)
        section.points.push_back(settled(curve, level, *seconds, true));
  }
}

/// One realisation at every bandwidth. Where the op-amps' poles are the only time constants, time
/// is in units of 1/bandwidth: one simulation tells all.
StudySection settling(const StudyInput& input, Realization realization, Simulator& simulator,
                      const Observer& observer) {
  StudySection section;
  const auto curve = [&](double bandwidth) {
    return std::string(name(realization)) + ", " + brief(bandwidth / 1e6) + " MHz";
  };
  const auto simulate = [&](double bandwidth) {
    const Scene scene = with(input, realization, bandwidth);
    add_settling(section, curve(bandwidth), plan_circuit(scene, input.readings), simulator,
                 observer);
  };
  simulate(compared_bandwidth);
  const std::vector<WorkPoint> measured = section.points;
  const RealizationOptions& given = input.scene.network.parts;
  const bool alone =
      !given.node_capacitance && !given.opamp.second_pole && !given.opamp.input_capacitance;
  for (const double bandwidth : {1e6, 100e6}) {
    if (!alone) {
      simulate(bandwidth);
      continue;
    }
    for (WorkPoint point : measured) {
      if (!point.measured()) continue;
      point.curve = curve(bandwidth);
      point.knob += ", scaled from 10 MHz";
      point.seconds *= compared_bandwidth / bandwidth;
      point.seconds_low = point.seconds_high = point.seconds;
      section.points.push_back(std::move(point));
    }
  }
  return section;
}

/// The thesis' own network: resistors, some negative, and the capacitance of its nodes.
StudySection passive_settling(const StudyInput& input, Simulator& simulator,
                              const Observer& observer) {
  StudySection section;
  Scene scene = with(input, Realization::ideal, std::nullopt);
  const double farad = scene.network.parts.node_capacitance.value_or(10e-12);
  scene.network.parts.node_capacitance = farad;
  const std::string curve = "ideal, " + brief(farad * 1e12) + " pF a node";
  add_settling(section, curve, plan_circuit(scene, input.readings), simulator, observer);
  return section;
}

/// What ngspice takes for the operating point, and how well it agrees.
StudySection operating_points(const StudyInput& input, Simulator& simulator) {
  StudySection section;
  for (const Realization realization : {Realization::ideal, Realization::nic, Realization::rail,
                                        Realization::crossbar, Realization::least_squares}) {
    WorkPoint result =
        empty_point(std::string(name(realization)), "operating point", TimeOf::simulator);
    try {
      const Relaxation relaxation =
          relax(plan_circuit(with(input, realization, std::nullopt), input.readings), simulator);
      result.seconds = result.seconds_low = result.seconds_high = relaxation.ngspice_seconds;
      result.error_to_solution = relaxation.difference;
      result.failure = relaxation.failure();
    } catch (const std::exception& error) {
      result.failure = error.what();
    }
    section.points.push_back(std::move(result));
  }
  return section;
}

StudySection parts(const StudyInput& input, const Observer& observer) {
  StudySection section;
  for (const Realization realization :
       {Realization::nic, Realization::rail, Realization::crossbar, Realization::least_squares})
    for (const double relative : {0.01, 0.001}) {
      if (observer.stop()) return section;
      Scene scene = with(input, realization, std::nullopt);
      scene.network.tolerance = ToleranceOptions{.relative = relative, .trials = 40};
      const ToleranceResult result = tolerate(plan_circuit(scene, input.readings));
      PartsFloor floor{.realization = std::string(name(realization)), .relative = relative};
      if (2 * result.stable > result.trials) floor.median = result.median;
      section.floors.push_back(std::move(floor));
    }
  return section;
}

}  // namespace

std::pair<std::string, double> circuit_of(const WorkPoint& point) {
  const std::size_t comma = point.curve.find(", ");
  const bool opamps = point.curve.ends_with(" MHz");
  return {point.curve.substr(0, comma),
          opamps ? 1e6 * std::stod(point.curve.substr(comma + 2)) : 0.0};
}

std::vector<StudyJob> circuit_jobs(const StudyInput& input, const SimulatorChoice& choice,
                                   const Observer& observer) {
  std::vector<StudyJob> jobs;
  const auto add = [&](const std::string& name, double weight, const auto& work) {
    jobs.push_back({name, weight, [name, work, choice] {
                      StudySection section;
                      try {
                        section = work(*make_simulator(choice));
                      } catch (const std::exception& error) {
                        WorkPoint failed = empty_point(name, "", TimeOf::settling);
                        failed.failure = error.what();
                        section.points.push_back(std::move(failed));
                      }
                      section.job = name;
                      return section;
                    }});
  };
  // The longest first: two run at a time.
  for (const Realization realization :
       {Realization::least_squares, Realization::nic, Realization::crossbar, Realization::rail})
    add("settling, " + std::string(name(realization)), 20.0,
        [&input, &observer, realization](Simulator& simulator) {
          return settling(input, realization, simulator, observer);
        });
  add("settling, ideal", 5.0, [&input, &observer](Simulator& simulator) {
    return passive_settling(input, simulator, observer);
  });
  add("accuracy of parts", 2.0, [&input, &observer](Simulator&) { return parts(input, observer); });
  add("ngspice, operating points", 2.0,
      [&input](Simulator& simulator) { return operating_points(input, simulator); });
  return jobs;
}

}  // namespace tactile_net::lab
