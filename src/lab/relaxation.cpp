#include "tactile_net/lab/relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "tactile_net/lab/beyond_curves.hpp"
#include "tactile_net/lab/workload.hpp"
#include "tactile_net/numeric/comparison.hpp"

namespace tactile_net::lab {
namespace {

using RemarkKind = RelaxationRemark::Kind;

void find_operating_point(const SceneCircuit& scene_circuit, Simulator& simulator,
                          Relaxation& result) {
  const Circuit& circuit = scene_circuit.network().circuit();
  const OperatingPoint point = operating_point(
      simulator, circuit, scene_circuit.file() + ", operating point", scene_circuit.analysis());
  result.ngspice_seconds = point.seconds;
  result.names = output_names(circuit);
  result.voltages = point.voltages;
  for (const double voltage : result.voltages)
    result.tractions.push_back(voltage / scene_circuit.options().parts.scale.volts);
  result.difference = l2_difference(result.tractions, scene_circuit.direct());
}

void add_certificate(const SceneCircuit& circuit, Relaxation& result) {
  result.certificate = circuit.certificate();
  if (result.certificate->dynamics) result.stable = result.certificate->dynamics->slowest < 0.0;
  if (result.certificate->stability != Stability::not_modelled) return;
  result.stable = false;
  result.remarks.push_back({RemarkKind::stability_not_known});
}

void run_transient(const SceneCircuit& circuit, Simulator& simulator, Relaxation& result) {
  result.transient =
      settle(simulator, circuit.network().circuit(), *result.certificate, result.voltages);
  const auto& said = result.certificate->dynamics->settling_seconds;
  const auto& seen = result.transient->settling_seconds;
  if (said && seen && std::abs(*seen / *said - 1.0) > 0.02)
    result.remarks.push_back({RemarkKind::settles_otherwise, *seen / *said - 1.0});
}

/// Draws replayed in the simulator, with ideal amplifiers as the equations have them.
void replay(const SceneCircuit& circuit, Simulator& simulator, ToleranceStudy& study) {
  const Reduction& reduction = circuit.network().reduction();
  const std::size_t most = std::min<std::size_t>(3, study.result.trials);
  const std::vector<Resistor> paths = paths_of_lines(reduction, study.options);
  for (; study.replayed < most; ++study.replayed) {
    // Draws from all over the study, not its first ones.
    const std::size_t trial = study.replayed * (study.result.trials / most);
    const std::vector<double> siemens = drawn(reduction, study.options, trial);
    const Trial expected = try_out(reduction, siemens, paths);
    Circuit built = perturbed(circuit.network().flat(), siemens, paths);
    for (AmplifierModel& model : built.amplifiers) model.opamp = {};
    built.capacitors.clear();
    const OperatingPoint point = operating_point(simulator, built, "one draw of components");
    study.difference = std::max(study.difference, l2_difference(point.voltages, expected.voltages));
  }
}

void draw_components(const SceneCircuit& circuit, Simulator& simulator, Relaxation& result) {
  const ToleranceOptions& options = *circuit.options().tolerance;
  result.tolerance =
      ToleranceStudy{.options = options, .result = tolerate(circuit.network(), options)};
  replay(circuit, simulator, *result.tolerance);
}

}  // namespace

bool Relaxation::agrees() const noexcept {
  const double predicted = explained.predicted.value_or(0.0);
  return std::abs(difference - predicted) <= explained.limit + explained.curves + 0.2 * predicted;
}

bool Relaxation::transient_as_certified() const noexcept {
  if (!transient || !certificate || !certificate->dynamics) return true;
  if (transient->end == TransientEnd::unfinished) return true;
  const bool stable_by_certificate = certificate->dynamics->slowest < 0.0;
  return (transient->end == TransientEnd::settles) == stable_by_certificate;
}

Verdict Relaxation::verdict() const noexcept {
  if (disagreement()) return Verdict::failed;
  if (!resolved()) return Verdict::ill_conditioned;
  return difference > 0.01 ? Verdict::inaccurate : Verdict::ok;
}

std::optional<Disagreement> beyond_curves(const ExplainedDifference& explained) noexcept {
  if (!(explained.curves > 0.5)) return std::nullopt;
  return Disagreement{.kind = Disagreement::Kind::curves, .value = explained.curves};
}

std::optional<Disagreement> Relaxation::disagreement() const noexcept {
  using Kind = Disagreement::Kind;
  if (const auto curves = beyond_curves(explained)) return curves;
  if (!agrees())
    return Disagreement{.kind = Kind::difference, .value = difference, .explained = explained};
  if (!transient_as_certified())
    return Disagreement{
        .kind = Kind::transient, .value = certificate->dynamics->slowest, .seen = transient->end};
  const bool not_definite =
      certificate ? certificate->stability == Stability::not_definite : smallest_eigenvalue <= 0.0;
  if (not_definite) return Disagreement{.kind = Kind::not_definite};
  if (!stable && certificate && certificate->dynamics)
    return Disagreement{.kind = Kind::unstable, .value = certificate->dynamics->slowest};
  if (tolerance && !(tolerance->difference <= 1e-6))
    return Disagreement{.kind = Kind::draws, .value = tolerance->difference};
  return std::nullopt;
}

Relaxation relax(const SceneCircuit& circuit, Simulator& simulator, Observer& observer) {
  const NetworkOptions& options = circuit.options();
  Relaxation result{.realization = options.realization,
                    .nodes = circuit.nodes(),
                    .elements = count_elements(circuit.network().flat()),
                    .explained = circuit.explained(),
                    .smallest_eigenvalue = circuit.network().eigenvalues().smallest,
                    .condition = circuit.condition()};
  result.stable = result.smallest_eigenvalue > 0.0;
  const auto remark = [&](RemarkKind kind, double value = 0.0) {
    result.remarks.push_back({kind, value});
  };

  observer.step({Step::Kind::operating_point});
  find_operating_point(circuit, simulator, result);
  if (calls_for_certificate(options)) {
    observer.step({Step::Kind::certificate});
    add_certificate(circuit, result);
  }
  const bool loaded = circuit.loaded();
  if (!loaded && (options.settling_accuracy || options.tolerance)) remark(RemarkKind::no_load);
  if (result.difference > 0.01 && loaded) remark(RemarkKind::inaccurate, result.difference);
  const bool doubtful =
      result.certificate && (result.certificate->stability == Stability::unstable ||
                             result.certificate->stability == Stability::not_modelled);
  if (doubtful && options.tolerance) remark(RemarkKind::draws_without_opamps);
  if (options.settling_accuracy && loaded && result.certificate->dynamics) {
    observer.step({Step::Kind::transient, result.certificate->dynamics->states});
    run_transient(circuit, simulator, result);
  } else if (options.settling_accuracy && !takes_time(options.realization, options.parts)) {
    remark(RemarkKind::nothing_takes_time);
  }
  if (options.tolerance && loaded) {
    if (calls_for_tolerance(options)) {
      observer.step({Step::Kind::draws});
      draw_components(circuit, simulator, result);
    } else {
      remark(RemarkKind::tolerances_not_linear);
    }
  }
  return result;
}

}  // namespace tactile_net::lab
