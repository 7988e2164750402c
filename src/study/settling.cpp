#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "study/circuits.hpp"
#include "study/points.hpp"
#include "tactile_net/network/state_space.hpp"
#include "tactile_net/simulator/step_response.hpp"

namespace tactile_net::study {
namespace {

/// The answer once it is off f* by a share of its 2-norm: its error to the truth is bounded by
/// both.
WorkPoint settled(const WorkCurve& curve, std::size_t level, double seconds, bool by_poles) {
  WorkPoint result;
  result.curve = curve;
  result.knob = {.kind = Knob::Kind::settled, .level = level, .by_poles = by_poles};
  result.time_of = TimeOf::settling;
  result.seconds = result.seconds_low = result.seconds_high = seconds;
  result.error_to_solution = settling_levels[level];
  return result;
}

/// Why there is nothing to time, if so.
std::optional<Failure> without_settling(const Certificate& certificate) {
  if (certificate.stability != Stability::stable || !certificate.dynamics)
    return Failure{.kind = Failure::Kind::not_stable, .stability = certificate.stability};
  const std::optional<double> last = certificate.dynamics->settling_seconds;
  if (!last) return Failure{.kind = Failure::Kind::unsettled};
  if (!(*last > 0.0)) return Failure{.kind = Failure::Kind::no_time};
  return std::nullopt;
}

/// By the simulator's waveforms, up to 1.2 times `last` [s], when the last level is reached.
void add_simulated(StudySection& section, const WorkCurve& curve, const lab::SceneCircuit& circuit,
                   double last, Simulator& simulator) {
  std::vector<double> end = circuit.direct();
  for (double& value : end) value *= circuit.options().parts.scale.volts;
  const double stop = 1.2 * last;
  const double step = stop / 4000.0;
  const std::vector<double> errors = step_errors(circuit.network().state_space(), 4.0 * step, 1000);
  const auto instant = [&](double level) {  // when the error is within it for good
    const auto late =
        std::find_if(errors.rbegin(), errors.rend(), [=](double error) { return error > level; });
    return 4.0 * step * static_cast<double>(errors.rend() - late);
  };
  // Ten steps to the first level, but not beyond what ngspice can bear.
  const Waveforms waveforms = step_response(
      simulator, circuit.network().circuit(),
      {.step = std::clamp(instant(settling_levels[0]) / 10.0, step, stop / 400.0), .stop = stop});
  for (std::size_t level = 0; level < settling_levels.size(); ++level) {
    const double error = settling_levels[level];
    if (instant(error) == 0.0) continue;  // what the first instant reaches takes no time
    if (const auto seconds = settling_time(waveforms, end, error))
      section.points.push_back(settled(curve, level, *seconds, false));
  }
}

/// By the circuit's poles, where the simulator runs out of time.
void add_by_poles(StudySection& section, const WorkCurve& curve, const StateSpace& system,
                  double slowest) {
  for (std::size_t level = 0; level < settling_levels.size(); ++level)
    if (const auto seconds = settling_time(system, settling_levels[level], slowest);
        seconds.value_or(0.0) > 0.0)
      section.points.push_back(settled(curve, level, *seconds, true));
}

/// A circuit's answer to a step of all its inputs: when it has come within each level of f*.
void add_settling(StudySection& section, const WorkCurve& curve, const StudyInput& input,
                  AnyScene scene, Simulator& simulator, const Stop& stop) {
  network_of(scene).settling_accuracy = settling_levels.back();
  const lab::SceneCircuit circuit = circuit_of(input, scene);
  const Certificate& certificate = circuit.certificate();
  if (auto failure = without_settling(certificate)) {
    section.points.push_back(failed(curve, {}, TimeOf::settling, std::move(*failure)));
    return;
  }
  if (stop()) return;
  const Dynamics& dynamics = *certificate.dynamics;
  if (certificate.elements.resistors > most_simulated_resistors) {
    add_by_poles(section, curve, circuit.network().state_space(), dynamics.slowest);
    return;
  }
  try {
    add_simulated(section, curve, circuit, *dynamics.settling_seconds, simulator);
  } catch (const SimulatorError& error) {
    if (error.cause() != SimulatorError::Cause::timed_out) throw;
    error.discard();
    add_by_poles(section, curve, circuit.network().state_space(), dynamics.slowest);
  }
}

/// At another bandwidth, where the op-amps' poles are the only time constants: time is in units of
/// 1/bandwidth.
WorkPoint scaled(WorkPoint point, double bandwidth) {
  point.curve.bandwidth = bandwidth;
  point.knob.scaled = true;
  point.seconds *= compared_bandwidth / bandwidth;
  point.seconds_low = point.seconds_high = point.seconds;
  return point;
}

}  // namespace

StudySection settling(const StudyInput& input, Realization realization, Simulator& simulator,
                      const Stop& stop) {
  StudySection section;
  const auto simulate = [&](double bandwidth) {
    const AnyScene scene = with_circuit(input, realization, bandwidth);
    add_settling(section, curve_of(input, scene, bandwidth), input, scene, simulator, stop);
  };
  simulate(compared_bandwidth);
  const std::vector<WorkPoint> measured = section.points;
  AnyScene scene = with_circuit(input, realization);
  const RealizationOptions& given = network_of(scene).parts;
  const bool alone = !given.has_capacitance() && !given.opamp.second_pole && !given.opamp.slew;
  for (const double bandwidth : bandwidths) {
    if (bandwidth == compared_bandwidth) continue;
    if (!alone) {
      simulate(bandwidth);
      continue;
    }
    for (const WorkPoint& point : measured)
      if (point.measured()) section.points.push_back(scaled(point, bandwidth));
  }
  return section;
}

StudySection passive_settling(const StudyInput& input, Simulator& simulator, const Stop& stop) {
  StudySection section;
  AnyScene scene = with_circuit(input, Realization::ideal);
  std::optional<double>& capacitance = network_of(scene).parts.node_capacitance;
  const double farad = capacitance.value_or(10e-12);
  capacitance = farad;
  const WorkCurve curve{.family = WorkCurve::Family::circuit,
                        .realization = Realization::ideal,
                        .node_capacitance = farad};
  add_settling(section, curve, input, scene, simulator, stop);
  return section;
}

}  // namespace tactile_net::study
