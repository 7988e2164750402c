#include "relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "solver.hpp"
#include "tactile_net/inverse/comparison.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "text.hpp"

namespace tactile_net::tool {
namespace {

DeckHeader header_of(const Scene& scene, const CircuitPlan& plan, double alpha) {
  const double first = position(scene.sensor, 0);
  const std::string volts = exact(plan.scale.volts);
  const bool two = unknowns(scene) == 2;
  DeckHeader header{
      .title = "tactile-net " TACTILE_NET_VERSION ": " + scene.file + ", realization " +
               std::string(name(plan.realization)),
      .comments =
          {two ? "Solves P f = b for the tractions f on the surface above a tactile array: the "
                 "normal "
                 "ones, then the tangential ones."
               : "Solves P f = b for the normal traction f on the surface above a tactile array.",
           "P = K'K + alpha (l^2/D^2 Q + I), b = K'g; K: kernel x pitch, g: readings, Q: squared "
           "differences of neighbours.",
           "Sensor: " + sensor_in_words(scene) + ".", "Material: " + material_in_words(scene) + ".",
           "alpha = " + exact(alpha) + ", l = " + exact(scene.reconstruct.smoothing_length) +
               ", D = " + exact(scene.sensor.pitch) + ".",
           "Scale: " + exact(plan.scale.siemens) + " S per unit of P, " + volts +
               " V per unit of f: f_i = v(n_i) / " + volts + ".",
           "Node n_i stands for the taxel at y = " + exact(first) + " + " +
               exact(scene.sensor.pitch) +
               (two ? " (i modulo " + std::to_string(scene.sensor.count) + ")." : " i."),
           "Expected below: the direct solve of P f = b, in volts."},
      .expected = plan.direct};
  for (double& value : header.expected) value *= plan.scale.volts;
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

}  // namespace

CircuitPlan plan_circuit(const Scene& scene, std::span<const double> readings) {
  const ReconstructOptions& options = scene.reconstruct;
  return plan_circuit(
      scene, readings,
      options.alpha ? *options.alpha : sweep_of(scene, readings).choice(options.alpha_rule).alpha);
}

CircuitPlan plan_circuit(const Scene& scene, std::span<const double> readings, double alpha) {
  const InverseProblem problem = problem_of(scene);
  NetworkProblem network = network_problem(problem, alpha, readings);
  CircuitPlan plan{.realization = scene.network.realization,
                   .scale = scene.network.parts.scale,
                   .matrix = {},
                   .circuit = {},
                   .header = {},
                   .direct = tikhonov_solve(problem, alpha, readings)};
  plan.circuit = realize(plan.realization, network, scene.network.parts);
  plan.matrix = std::move(network.matrix);
  plan.header = header_of(scene, plan, alpha);
  return plan;
}

std::string deck_text(const CircuitPlan& plan, Answer answer) {
  std::ostringstream deck;
  write_deck(deck, plan.circuit, plan.header, answer);
  return std::move(deck).str();
}

Relaxation relax(const CircuitPlan& plan, Simulator& simulator) {
  Relaxation result{.realization = plan.realization,
                    .nodes = plan.direct.size(),
                    .elements = count_elements(plan.circuit)};
  result.smallest_eigenvalue = smallest_eigenvalue(plan.matrix);
  result.stable = result.smallest_eigenvalue > 0.0;
  result.condition = result.stable ? row_sum_norm(plan.matrix) / result.smallest_eigenvalue
                                   : std::numeric_limits<double>::infinity();
  // Rounding of P's entries and of the simulator's elimination, both multiplied by the condition.
  result.limit = 1e-11 + 100.0 * std::numeric_limits<double>::epsilon() * result.condition;

  std::vector<std::string> outputs;
  for (const Node node : plan.circuit.outputs) outputs.push_back(plan.circuit.nodes[node]);
  OperatingPoint point = operating_point(simulator, deck_text(plan, Answer::raw_file), outputs);
  result.ngspice_seconds = point.seconds;
  result.voltages = std::move(point.voltages);
  for (const double voltage : result.voltages)
    result.tractions.push_back(voltage / plan.scale.volts);

  result.difference = relative_l2_error(result.tractions, plan.direct);
  if (std::isnan(result.difference))  // no load: the answer is zero, or wrong
    result.difference = std::all_of(result.voltages.begin(), result.voltages.end(),
                                    [](double v) { return v == 0.0; })
                            ? 0.0
                            : std::numeric_limits<double>::infinity();
  return result;
}

}  // namespace tactile_net::tool
