#include "tactile_net/lab/scene_circuit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>

#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_network.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/scene/opamp_part.hpp"
#include "tactile_net/scene/scale_units.hpp"

namespace tactile_net::lab {
namespace {

/// What the devices' curves do to the answer, to first order: P dv = -(their currents beyond
/// -g v), and twice that for the orders left out.
double bound_of_curves(const SceneCircuit& circuit) {
  const RealizationOptions& parts = circuit.options().parts;
  const std::vector<double>& direct = circuit.direct();
  const double volts = parts.scale.volts;
  const double own = parts.device_volts;
  const Matrix& matrix = circuit.network().problem().matrix;
  const ConductanceNetwork network = conductances(matrix);
  std::vector<double> extra(network.nodes);  // in units of P and f
  const auto add = [&](std::size_t i, double g, double v) {
    const double u = v * volts / own;
    const double beyond =
        parts.curve == Curve::cubic ? u * u * u : (2.0 + u) * std::exp(-u) - 2.0 + u;
    extra[i] += g * own / volts * beyond;
  };
  for (const Branch& branch : network.branches)
    if (branch.conductance < 0.0) {
      const double v = direct[branch.from] - direct[branch.to];
      add(branch.from, -branch.conductance, v);
      add(branch.to, branch.conductance, v);  // the same current, out of the other end
    }
  for (std::size_t i = 0; i < network.nodes; ++i)
    if (network.ground[i] < 0.0) add(i, -network.ground[i], direct[i]);
  const std::vector<double> moved = solve_symmetric(matrix, extra);
  const double size = l2_norm(direct);
  return size > 0.0 ? 2.0 * l2_norm(moved) / size : 0.0;
}

/// In which the scene writes what mends a circuit; 1 where that is no scale's number.
double unit_of_repair(CircuitRemark::Kind kind, const ScaleUnits& units) {
  using Kind = CircuitRemark::Kind;
  switch (kind) {
    case Kind::clamps:
    case Kind::odd_voltage:
    case Kind::slews:
    case Kind::output_current:
      return units.volts.to_si(1.0);
    case Kind::summing_lag:
    case Kind::node_lag:
    case Kind::floating_input_capacitance:
    case Kind::not_for_sale:
      return units.siemens.to_si(1.0);
    case Kind::capacitance_at_outputs:
    case Kind::outputs_without_load:
    case Kind::figures_not_known:
    case Kind::capacitance_at_one_frequency:
    case Kind::divider_rings:
    case Kind::beyond_digits:
    case Kind::too_many_states:
    case Kind::slewing_left_out:
    case Kind::noise_without_capacitance:
      return 1.0;
  }
  return 1.0;
}

/// "second_pole and output_resistance of THS4551"; empty: all are known, or no part is named.
std::string lacking_figures(const NetworkOptions& options) {
  if (options.opamp_part == nullptr || !has_amplifiers(options.realization)) return {};
  std::string text;
  for (const std::string_view figure : figures_not_known(options.parts.opamp))
    text += (text.empty() ? "" : ", ") + std::string(figure);
  return text.empty() ? text : text + " of " + options.opamp_part->name;
}

/// Between what a circuit like this one gives at rest and the direct solve, from linear equations.
double difference_at_rest(const SceneCircuit& scene_circuit, const FlatCircuit& circuit) {
  std::vector<double> v = operating_voltages(circuit);
  for (double& value : v) value /= scene_circuit.options().parts.scale.volts;
  return l2_difference(v, scene_circuit.direct());
}

/// What finite gain and offset do to the answer.
std::optional<double> predicted_difference(const SceneCircuit& circuit) {
  const RealizationOptions& parts = circuit.options().parts;
  if (parts.opamp.is_nullor() || !has_amplifiers(circuit.network().realization()))
    return std::nullopt;
  return difference_at_rest(circuit, circuit.network().flat());
}

const NetworkOptions& network_of(const AnyScene& any) {
  return std::visit([](const auto& scene) -> const NetworkOptions& { return scene.network; }, any);
}

const std::shared_ptr<const CircuitSource>& checked(
    const std::shared_ptr<const CircuitSource>& source) {
  if (const auto why = source->refusal(network_of(source->scene()).realization))
    throw std::invalid_argument(*why);
  return source;
}

}  // namespace

SceneCircuit::SceneCircuit(const SceneFrame& frame) : SceneCircuit(frame, frame.alpha()) {}

SceneCircuit::SceneCircuit(const SceneFrame& frame, const ChosenAlpha& alpha)
    : SceneCircuit(circuit_source(frame), alpha) {}

SceneCircuit::SceneCircuit(const std::shared_ptr<const CircuitSource>& source,
                           const ChosenAlpha& alpha)
    : source_(checked(source)),
      alpha_(alpha),
      options_(scaled()),
      network_(std::make_shared<const NetworkCircuit>(
          options().realization,
          std::make_shared<const NetworkProblem>(source_->problem(alpha.value)), options().parts)) {
}

SceneCircuit::SceneCircuit(const SceneCircuit& other, std::shared_ptr<const NetworkCircuit> network)
    : source_(other.source_),
      alpha_(other.alpha_),
      direct_(other.direct_),
      options_(other.options_),
      network_(std::move(network)) {
  options_.realization = network_->realization();
  options_.parts = network_->options();
}

const std::string& SceneCircuit::file() const noexcept {
  if (const auto* line = std::get_if<Scene>(&scene())) return line->file;
  return std::get_if<SkinScene>(&scene())->file;
}

NetworkOptions SceneCircuit::scaled() const {
  NetworkOptions options = network_of(scene());
  if (!options.one_volt) return options;
  double one_volt =
      0.1 * std::visit([](const auto& one) { return one.material.youngs_modulus; }, scene());
  if (std::visit([](const auto& one) { return !one.contacts.empty(); }, scene())) {
    one_volt = 0.0;
    for (const double f : direct()) one_volt = std::max(one_volt, std::abs(f));
  }
  const double volts = 1.0 / one_volt;
  if (volts > 0.0 && std::isfinite(volts)) options.parts.scale.volts = volts;
  return options;
}

bool SceneCircuit::loaded() const noexcept {
  const std::vector<double>& b = network_->problem().right_side;
  return std::any_of(b.begin(), b.end(), [](double value) { return value != 0.0; });
}

const std::vector<double>& SceneCircuit::direct() const {
  return direct_.get([&] { return source_->direct(alpha_.value); });
}

Condition SceneCircuit::condition() const {
  const double smallest = network_->eigenvalues().smallest;
  return {smallest > 0.0 ? largest_row_sum(network_->problem().matrix) / smallest
                         : std::numeric_limits<double>::infinity(),
          Condition::Kind::bound, Condition::Matrix::normal};
}

const ExplainedDifference& SceneCircuit::explained() const {
  return explained_.get([&] {
    const RealizationTraits& realization = traits(network_->realization());
    // Rounding of P's entries and of the simulator's elimination, both multiplied by the condition.
    ExplainedDifference result{
        .limit = realization.rounding +
                 100.0 * std::numeric_limits<double>::epsilon() * condition().value,
        .predicted = predicted_difference(*this)};
    if (realization.parts == RealizationTraits::Parts::curved)
      result.curves = bound_of_curves(*this);
    return result;
  });
}

const std::optional<SceneCircuit::Ordered>& SceneCircuit::ordered() const {
  return ordered_.get([&]() -> std::optional<Ordered> {
    if (!options_.tolerance || !options_.tolerance->series) return std::nullopt;
    const Series series = *options_.tolerance->series;
    Ordered result{.series = series, .circuit = with_parts_of(series, network_->circuit())};
    if (std::holds_alternative<DirectCurrent>(analysis()) && loaded())
      result.moved = difference_at_rest(*this, FlatCircuit(result.circuit));
    return result;
  });
}

const Certificate& SceneCircuit::certificate() const {
  return certificate_.get([&] {
    Certificate result =
        tactile_net::certify(*network_, options().settling_accuracy.value_or(1e-3));
    const ScaleUnits units = std::visit([](const auto& one) { return scale_units(one); }, scene());
    for (CircuitRemark& remark : result.remarks) remark.unit = unit_of_repair(remark.kind, units);
    if (const auto lacking = lacking_figures(options()); !lacking.empty())
      result.remarks.push_back({.kind = CircuitRemark::Kind::figures_not_known, .part = lacking});
    return result;
  });
}

Analysis SceneCircuit::analysis() const {
  if (traits(network_->realization()).parts == RealizationTraits::Parts::lossless)
    return SingleFrequency{options().parts.frequency};
  return DirectCurrent{};
}

ToleranceOptions SceneCircuit::tolerance() const {
  return options().tolerance.value_or(ToleranceOptions{.relative = 0.01});
}

namespace {

SceneCircuit circuit_of(const Scene& scene) {
  return SceneCircuit(SceneFrame(SceneProblem(scene), simulate(scene).readings));
}

/// Before anything is made of what is too large.
void refuse_large(const SkinScene& scene) {
  if (const auto why =
          too_large(scene.network.realization, components(scene) * grid(of_circuit(scene)).count(),
                    reading_count(scene.sensor)))
    throw std::invalid_argument(*why);
}

SceneCircuit circuit_of(const SkinScene& scene) {
  refuse_large(scene);
  return skin_circuit(scene, simulate(scene).readings);
}

/// What such a circuit is made of would be noise too.
void refuse_noise(const auto& scene) {
  if (scene.contacts.empty() && !scene.reconstruct.alpha)
    throw std::invalid_argument(
        "the scene has no contact, so alpha and with it every part would be chosen on noise: "
        "give alpha a number in [reconstruct], or the scene a contact");
}

}  // namespace

SceneCircuit skin_circuit(const SkinScene& scene, std::vector<double> readings) {
  refuse_noise(scene);
  refuse_large(scene);
  SkinSceneProblem problem(scene);
  std::optional<double> weight;
  if (problem.estimates_weight()) {
    weight = problem.likeliest_weight(readings);
    problem = problem.weighed(*weight);
  }
  ChosenAlpha alpha = problem.alpha(readings);
  alpha.tangential_weight = weight;
  return SceneCircuit(circuit_source(problem, std::move(readings)), alpha);
}

SceneCircuit simulated_circuit(const AnyScene& scene) {
  return std::visit(
      [](const auto& one) {
        refuse_noise(one);
        return circuit_of(one);
      },
      scene);
}

}  // namespace tactile_net::lab
