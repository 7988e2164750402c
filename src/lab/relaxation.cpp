#include "tactile_net/lab/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/scene_parts.hpp"
#include "tactile_net/lab/workload.hpp"
#include "tactile_net/network/reduction.hpp"
#include "tactile_net/network/state_space.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/report/words/scene_words.hpp"

namespace tactile_net::lab {
namespace {

DeckHeader header_of(const Scene& scene, const CircuitPlan& plan, double alpha) {
  const double first = position(scene.sensor, 0);
  const Scale& scale = plan.options.parts.scale;
  const std::string volts = shortest(scale.volts);
  const bool two = unknowns(scene) == 2;
  DeckHeader header{
      .title = "tactile-net " + std::string(version()) + ": " + scene.file + ", realization " +
               std::string(name(plan.options.realization)),
      .comments =
          {two ? "Solves P f = b for the tractions f on the surface above a tactile array: the "
                 "normal "
                 "ones, then the tangential ones."
               : "Solves P f = b for the normal traction f on the surface above a tactile array.",
           "P = K'K + alpha (l^2/D^2 Q + I), b = K'g; K: kernel x pitch, g: readings, Q: squared "
           "differences of neighbours.",
           "Sensor: " + report::sensor_in_words(scene) + ".",
           "Material: " + report::material_in_words(scene) + ".",
           "alpha = " + shortest(alpha) + ", l = " + shortest(scene.reconstruct.smoothing_length) +
               ", D = " + shortest(scene.sensor.pitch) + ".",
           "Scale: " + shortest(scale.siemens) + " S per unit of P, " + volts +
               " V per unit of f: f_i = v(n_i) / " + volts + ".",
           "Node n_i stands for the taxel at y = " + shortest(first) + " + " +
               shortest(scene.sensor.pitch) +
               (two ? " (i modulo " + std::to_string(scene.sensor.count) + ")." : " i."),
           "Expected below: the direct solve of P f = b, in volts."},
      .expected = plan.direct};
  for (double& value : header.expected) value *= scale.volts;
  return header;
}

/// Largest row sum of |P|, which bounds its largest eigenvalue.
double row_sum_norm(const Matrix& matrix) {
  double largest = 0.0;
  for (std::size_t i = 0; i < matrix.rows; ++i) {
    double sum = 0.0;
    for (const double value : matrix.row(i)) sum += std::abs(value);
    largest = std::max(largest, sum);
  }
  return largest;
}

/// Every relaxation but `lc`'s is an operating point.
Analysis analysis_of(const NetworkOptions& options) {
  if (options.realization == Realization::lc) return SingleFrequency{options.parts.frequency};
  return DirectCurrent{};
}

/// What the devices' curves do to the answer, to first order: P dv = -(their currents beyond
/// -g v), and twice that for the orders left out.
double bound_of_curves(const CircuitPlan& plan) {
  const double volts = plan.options.parts.scale.volts;
  const double own = plan.options.parts.device_volts;
  const ConductanceNetwork network = conductances(plan.problem.matrix);
  std::vector<double> extra(network.nodes);  // in units of P and f
  const auto add = [&](std::size_t i, double g, double v) {
    const double u = v * volts / own;
    const double beyond =
        plan.options.parts.curve == Curve::cubic ? u * u * u : (2.0 + u) * std::exp(-u) - 2.0 + u;
    extra[i] += g * own / volts * beyond;
  };
  for (const Branch& branch : network.branches)
    if (branch.conductance < 0.0) {
      const double v = plan.direct[branch.from] - plan.direct[branch.to];
      add(branch.from, -branch.conductance, v);
      add(branch.to, branch.conductance, v);  // the same current, out of the other end
    }
  for (std::size_t i = 0; i < network.nodes; ++i)
    if (network.ground[i] < 0.0) add(i, -network.ground[i], plan.direct[i]);
  const std::vector<double> moved = solve_symmetric(plan.problem.matrix, extra);
  const double size = l2_norm(plan.direct);
  return size > 0.0 ? 2.0 * l2_norm(moved) / size : 0.0;
}

/// What finite gain and offset do to the answer, from the linear equations of the same parts.
std::optional<double> predicted_difference(const CircuitPlan& plan) {
  const OpAmp& opamp = plan.options.parts.opamp;
  if (opamp.is_nullor() || !has_amplifiers(plan.options.realization)) return std::nullopt;
  std::vector<double> v = operating_voltages(plan.circuit);
  for (double& value : v) value /= plan.options.parts.scale.volts;
  return l2_difference(v, plan.direct);
}

/// What may stand between the circuit's answer and the direct solve.
struct Explained {
  double limit = 0.0;                 // by rounding
  double curves = 0.0;                // by the devices' curves
  std::optional<double> predicted{};  // by the op-amps' gain and offset
};

Explained explained(const CircuitPlan& plan, double condition) {
  // Rounding of P's entries and of the simulator's elimination, both multiplied by the condition;
  // amplifiers make it eliminate more.
  const bool alone = plan.options.realization == Realization::ideal;
  Explained result{
      .limit = (alone ? 1e-11 : 1e-10) + 100.0 * std::numeric_limits<double>::epsilon() * condition,
      .predicted = predicted_difference(plan)};
  if (plan.options.realization == Realization::ndr) result.curves = bound_of_curves(plan);
  return result;
}

double condition_bound(const Matrix& matrix, double smallest) {
  return smallest > 0.0 ? row_sum_norm(matrix) / smallest : std::numeric_limits<double>::infinity();
}

/// Draws replayed in the simulator, with ideal amplifiers as the equations have them.
void replay(const CircuitPlan& plan, const Reduction& reduction, Simulator& simulator,
            ToleranceStudy& study) {
  Circuit circuit = plan.circuit;
  for (AmplifierModel& model : circuit.amplifiers) model.opamp = {};
  circuit.capacitors.clear();
  const std::size_t most = std::min<std::size_t>(3, study.result.trials);
  for (; study.replayed < most; ++study.replayed) {
    // Draws from all over the study, not its first ones.
    const std::size_t trial = study.replayed * (study.result.trials / most);
    const std::vector<double> siemens = drawn(reduction, study.options, trial);
    const Trial expected = try_out(reduction, siemens);
    std::ostringstream deck;
    write_deck(deck, perturbed(circuit, siemens), {.title = "one draw of components"},
               Answer::raw_file);
    const OperatingPoint point = operating_point(simulator, deck.str(), output_names(circuit));
    study.difference = std::max(study.difference, l2_difference(point.voltages, expected.voltages));
  }
}

}  // namespace

CircuitPlan plan_circuit(const Scene& scene, std::span<const double> readings) {
  const ReconstructOptions& options = scene.reconstruct;
  return plan_circuit(
      scene, readings,
      options.alpha ? *options.alpha : sweep_of(scene, readings).choice(options.alpha_rule).alpha);
}

CircuitPlan plan_circuit(const Scene& scene, std::span<const double> readings, double alpha) {
  const InverseProblem problem = problem_of(scene);
  CircuitPlan plan{.options = scene.network,
                   .problem = network_problem(problem, alpha, readings),
                   .circuit = {},
                   .header = {},
                   .direct = tikhonov_solve(problem, alpha, readings)};
  plan.circuit = realize(plan.options.realization, plan.problem, plan.options.parts);
  plan.header = header_of(scene, plan, alpha);
  return plan;
}

std::string deck_text(const CircuitPlan& plan, Answer answer) {
  std::ostringstream deck;
  DeckHeader header = plan.header;
  if (answer == Answer::printed) {
    const Matrix& matrix = plan.problem.matrix;
    const Explained difference =
        explained(plan, condition_bound(matrix, smallest_eigenvalue(matrix)));
    double within = difference.limit + difference.curves + 1.2 * difference.predicted.value_or(0.0);
    if (l2_norm(plan.direct) == 0.0) within *= plan.options.parts.scale.volts;
    if (std::isfinite(within)) header.within = within;
  }
  write_deck(deck, plan.circuit, header, answer, analysis_of(plan.options));
  return std::move(deck).str();
}

Certificate certify(const CircuitPlan& plan) {
  return tactile_net::certify(plan.options.realization, plan.problem, plan.options.parts,
                              plan.options.settling_accuracy.value_or(1e-3));
}

ToleranceResult tolerate(const CircuitPlan& plan) {
  return tactile_net::tolerate(Reduction(plan.circuit), *plan.options.tolerance);
}

bool Relaxation::agrees() const noexcept {
  return std::abs(difference - predicted.value_or(0.0)) <=
         limit + curves + 0.2 * predicted.value_or(0.0);
}

bool Relaxation::judged_as_certified() const noexcept {
  if (!judged || !certificate || !certificate->dynamics) return true;
  if (judged->judgement == Judgement::unfinished) return true;
  const bool stable_by_certificate = certificate->dynamics->slowest < 0.0;
  return (judged->judgement == Judgement::settles) == stable_by_certificate;
}

std::string Relaxation::failure() const {
  if (curves > 0.5)
    return "node voltages are too large for the devices, whose curves may change the answer by " +
           brief(curves) + " of itself: raise device_volts, or lower volts";
  if (!agrees())
    return "the circuit differs from the direct solve by " + brief(difference) + ", more than " +
           (predicted ? "its op-amps (" + brief(*predicted) + ") and " : "") +
           (curves > 0.0 ? "its devices (" + brief(curves) + ") and " : "") + "rounding explain (" +
           brief(limit) + ")";
  if (!judged_as_certified())
    return std::string("the certificate says ") +
           (certificate->dynamics->slowest < 0.0 ? "stable" : "unstable") +
           ", the simulator's transient " + std::string(name(judged->judgement));
  const bool not_definite =
      certificate ? certificate->stability == Stability::not_definite : smallest_eigenvalue <= 0.0;
  if (not_definite) return "P is not positive definite: the circuit would not settle";
  if (!stable)
    return "the circuit is unstable: its slowest pole is at " +
           brief(certificate->dynamics->slowest) + " 1/s";
  if (tolerance && !(tolerance->difference <= 1e-6))
    return "draws of components differ in the simulator by " + brief(tolerance->difference);
  return {};
}

Relaxation relax(const CircuitPlan& plan, Simulator& simulator, Observer& observer) {
  const NetworkOptions& options = plan.options;
  const Matrix& matrix = plan.problem.matrix;
  Relaxation result{.realization = options.realization,
                    .nodes = plan.direct.size(),
                    .elements = count_elements(plan.circuit)};
  result.smallest_eigenvalue = smallest_eigenvalue(matrix);
  result.stable = result.smallest_eigenvalue > 0.0;
  result.condition = condition_bound(matrix, result.smallest_eigenvalue);
  const Explained difference = explained(plan, result.condition);
  result.limit = difference.limit;
  result.curves = difference.curves;
  result.predicted = difference.predicted;

  observer.step({Step::Kind::operating_point});
  const OperatingPoint point =
      operating_point(simulator, deck_text(plan, Answer::raw_file), output_names(plan.circuit));
  result.ngspice_seconds = point.seconds;
  result.voltages = point.voltages;
  for (const double voltage : result.voltages)
    result.tractions.push_back(voltage / options.parts.scale.volts);
  result.difference = l2_difference(result.tractions, plan.direct);

  if (calls_for_certificate(options)) {
    observer.step({Step::Kind::certificate});
    result.certificate = certify(plan);
    result.warnings = result.certificate->warnings;
    if (result.certificate->dynamics) result.stable = result.certificate->dynamics->slowest < 0.0;
  }
  const bool loaded = l2_norm(plan.direct) > 0.0;
  if (!loaded && (options.settling_accuracy || options.tolerance))
    result.warnings.emplace_back(
        "there is no load: nothing to settle to, and nothing for components to change");
  if (result.difference > 0.01 && loaded)
    result.warnings.push_back("the circuit's answer is " + brief(100.0 * result.difference) +
                              " % off the direct solve: not accurate, though its parts explain it");
  if (result.certificate && result.certificate->stability == Stability::unstable &&
      options.tolerance)
    result.warnings.emplace_back(
        "draws of components are judged without the op-amps' dynamics, which are unstable here");
  if (options.settling_accuracy && loaded && result.certificate->dynamics) {
    observer.step({Step::Kind::transient, result.certificate->dynamics->states});
    result.judged = judge(simulator, plan.circuit, *result.certificate, result.voltages);
    const auto& said = result.certificate->dynamics->settling_seconds;
    const auto& seen = result.judged->settling_seconds;
    if (said && seen && std::abs(*seen / *said - 1.0) > 0.02)
      result.warnings.push_back(
          "ngspice's settling time is " + brief(100.0 * (*seen / *said - 1.0)) +
          " % off the certificate's, which is for linear parts that start from zero: offsets, "
          "rails and curves are not in it");
  } else if (options.settling_accuracy && !takes_time(options.realization, options.parts)) {
    result.warnings.emplace_back(
        "settling is asked for, and nothing here takes a time that is modelled: give the op-amps "
        "a bandwidth, opamp = { bandwidth = 10e6 }, or the nodes a capacitance, parasitic = { node "
        "= 1e-11 }");
  }
  if (options.tolerance && loaded) {
    if (!calls_for_tolerance(options)) {
      result.warnings.emplace_back("tolerances are studied for networks of resistors and op-amps");
    } else {
      observer.step({Step::Kind::draws});
      const Reduction reduction(plan.circuit);
      result.tolerance =
          ToleranceStudy{.options = *options.tolerance,
                         .result = tactile_net::tolerate(reduction, *options.tolerance)};
      replay(plan, reduction, simulator, *result.tolerance);
    }
  }
  return result;
}

ToleranceOptions drawn_options(const CircuitPlan& plan) {
  return plan.options.tolerance.value_or(ToleranceOptions{.relative = 0.01});
}

Recommendation recommend(const CircuitPlan& plan) {
  ToleranceOptions options = drawn_options(plan);
  // Enough to tell 95 of 100; fewer where a trial of a large network takes its time.
  const std::size_t nodes = plan.direct.size();
  options.trials = std::min<std::size_t>(options.trials, nodes <= 60    ? 200
                                                         : nodes <= 130 ? 60
                                                                        : 20);
  Recommendation result;
  for (const Realization one :
       {Realization::crossbar, Realization::rail, Realization::least_squares, Realization::nic}) {
    if (one == Realization::nic && nodes > 130) continue;  // tens of thousands of op-amps
    RealizationOptions parts = plan.options.parts;
    parts.inverters = false;
    const Circuit circuit = realize(one, plan.problem, parts);
    result.candidates.push_back({.realization = one,
                                 .opamps = count_elements(circuit).opamps,
                                 .tolerance = tactile_net::tolerate(Reduction(circuit), options)});
  }
  std::stable_sort(result.candidates.begin(), result.candidates.end(),
                   [](const auto& a, const auto& b) { return a.opamps < b.opamps; });
  std::string parts_in_words = options.relative
                                   ? "parts of " + brief(100.0 * *options.relative) + " %"
                                   : "parts of the series";
  if (plan.options.parts.inverters)
    parts_in_words += ", complementary outputs instead of the scene's inverters,";
  const std::string accuracy = brief(100.0 * options.accuracy) + " %";
  const auto good = std::find_if(result.candidates.begin(), result.candidates.end(),
                                 [](const auto& c) { return c.tolerance.yield() >= 0.95; });
  if (good != result.candidates.end()) {
    result.text = "With " + parts_in_words + " and an accuracy of " + accuracy + ": " +
                  std::string(name(good->realization)) + ", the fewest amplifiers (" +
                  std::to_string(good->opamps) + ") of those that reach it in 95 of 100 builds.";
    return result;
  }
  const auto best = std::min_element(
      result.candidates.begin(), result.candidates.end(),
      [](const auto& a, const auto& b) { return a.tolerance.p95 < b.tolerance.p95; });
  result.text = "With " + parts_in_words + " no realisation is within " + accuracy +
                " in 95 of 100 builds; " + std::string(name(best->realization)) + " comes nearest" +
                (std::isfinite(best->tolerance.p95)
                     ? " (95 of 100 within " + brief(100.0 * best->tolerance.p95) + " %)."
                     : ", and is not stable in 95 of 100 either.");
  if (options.relative && std::isfinite(best->tolerance.p95))
    result.text += " It would take parts of about " +
                   brief(100.0 * *options.relative * options.accuracy / best->tolerance.p95) +
                   " %, or a larger alpha.";
  return result;
}

}  // namespace tactile_net::lab
