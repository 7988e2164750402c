#include "tactile_net/network/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "network/refinement_parts.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/named.hpp"
#include "numeric/robust.hpp"

namespace tactile_net {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Errors of one sign each that make |X| large, in turn with the singular vectors of X: each step
/// is an ascent to first order.
struct AdverseBuild {
  std::vector<double> siemens{};
  double deviation = 0.0;
};

AdverseBuild ascend(const Refinement::Parts& parts, Eigen::VectorXd left, Eigen::VectorXd right) {
  constexpr int most_turns = 30;
  AdverseBuild best;
  std::vector<double> siemens = parts.printed;
  for (int turn = 0; turn < most_turns; ++turn) {
    const SeenMatrix here = parts.seen(siemens);
    const Eigen::VectorXd rows = here.rows(parts.inverse_root * left);
    const Eigen::VectorXd unknowns = here.unknowns(parts.inverse_root * right);
    for (std::size_t r = 0; r < siemens.size(); ++r) {
      double law = 0.0;
      double voltage = 0.0;
      for (const auto& [row, factor] : parts.branches[r].law)
        law += factor * rows(eigen_index(row));
      for (const auto& [at, factor] : parts.branches[r].voltage)
        voltage += factor * unknowns(eigen_index(at));
      siemens[r] = parts.printed[r] / (1.0 - std::copysign(parts.within[r], law * voltage));
    }
    const SeenMatrix moved = parts.seen(siemens);
    LargestSingular found = largest_singular(parts.deviation(moved.matrix() / parts.unit));
    if (!(found.value > best.deviation)) break;
    best = {siemens, found.value};
    left = std::move(found.left);
    right = std::move(found.right);
  }
  return best;
}

AdverseBuild adverse_build(const Refinement::Parts& parts) {
  // The directions that P holds least are those that errors move most.
  const Svd svd = singular_value_decomposition(parts.inverse_root);
  constexpr Eigen::Index most_starts = 6;
  AdverseBuild best{parts.printed, 0.0};
  const Eigen::Index starts = std::min<Eigen::Index>(most_starts, svd.u.cols());
  for (Eigen::Index k = 0; k < starts; ++k) {
    AdverseBuild found = ascend(parts, svd.u.col(k), svd.u.col(k));
    if (found.deviation > best.deviation) best = std::move(found);
  }
  return best;
}

void check_sent(const Refinement::Parts& parts, std::span<const double> sent) {
  if (!sent.empty() && sent.size() != parts.reduction.outputs())
    throw std::invalid_argument("a cycle sends one current to each summing node");
}

/// A current out of the summing node of an output's amplifier; where both inputs are nodes half of
/// their difference, and what they have in common stays.
void send(const Refinement::Parts& parts, std::size_t output, double ampere,
          std::vector<CurrentSource>& sources) {
  const FlatCircuit& flat = parts.circuit.flat();
  const Node out = flat.circuit().outputs[output];
  const auto all = flat.amplifiers();
  const auto found = std::find_if(all.begin(), all.end(), [&](const FlatCircuit::Amplifier& one) {
    return one.out == out || one.inverse == out;
  });
  const std::string name = "Irefine" + std::to_string(output);
  if (found->plus != 0) sources.push_back({name + 'p', found->plus, ampere});
  sources.push_back({name + 'n', found->minus, -ampere});
}

RefinementTrials::Cycle quantiles(const std::vector<double>& errors, double adverse) {
  return {quantile(errors, 0.5), quantile(errors, 0.95),
          *std::max_element(errors.begin(), errors.end()), adverse};
}

/// Multiplications by entries that are not 0.
std::size_t entries(const Eigen::MatrixXd& matrix) {
  return static_cast<std::size_t>((matrix.array() != 0.0).count());
}

std::optional<std::size_t> rank(std::vector<double> cycles, double at) {
  const double found = quantile(std::move(cycles), at);
  if (!std::isfinite(found)) return std::nullopt;
  return static_cast<std::size_t>(found);
}

}  // namespace

std::string_view name(RefinementVerdict verdict) noexcept {
  return name_in<Enumerators<RefinementVerdict>::all>(verdict);
}

void check(const RefinementOptions& options) {
  if (options.cycles == 0 || options.cycles > most_refinement_cycles)
    throw std::invalid_argument("refinement takes from 1 to " +
                                std::to_string(most_refinement_cycles) + " cycles");
  if (!(options.accuracy > 0.0))
    throw std::invalid_argument("the accuracy to refine to must be > 0");
  if (!options.converters) return;
  const Converters& converters = *options.converters;
  if (converters.bits < 4 || converters.bits > 24)
    throw std::invalid_argument("converters have from 4 to 24 bits");
  if (!(converters.gain >= 0.0 && converters.gain < 0.5))
    throw std::invalid_argument("the converters' gain must be off by >= 0 and < 0.5");
  if (!(converters.noise >= 0.0) || !std::isfinite(converters.noise) ||
      !(converters.conversion >= 0.0) || !std::isfinite(converters.conversion))
    throw std::invalid_argument("the converters' noise and conversion must be >= 0");
}

RefinementVerdict verdict(const RefinementBound& bound, const RefinementTrials& trials,
                          bool stable) noexcept {
  if (!stable || trials.stable < trials.builds) return RefinementVerdict::refused;
  if (bound.contraction() < 1.0) return RefinementVerdict::proven;
  return bound.contraction_of_most() < 1.0 ? RefinementVerdict::proven_of_most
                                           : RefinementVerdict::refused;
}

std::optional<std::size_t> proven_cycles(const RefinementBound& bound,
                                         const RefinementTrials& trials, RefinementVerdict verdict,
                                         double accuracy) {
  if (verdict == RefinementVerdict::refused) return std::nullopt;
  const double rate =
      verdict == RefinementVerdict::proven ? bound.contraction() : bound.contraction_of_most();
  // |e|_2 / |f*|_2 <= condition^1/2 |e|_P / |f*|_P.
  const double first = std::sqrt(bound.condition) * trials.first_energy;
  if (first <= accuracy) return 1;
  return 1 + static_cast<std::size_t>(std::ceil(std::log(accuracy / first) / std::log(rate)));
}

Refinement::Refinement(const NetworkCircuit& circuit, const ToleranceOptions& tolerances,
                       const RefinementOptions& options)
    : parts_(std::make_unique<const Parts>(circuit, tolerances, options)) {}
Refinement::Refinement(Refinement&&) noexcept = default;
Refinement::~Refinement() = default;

Refined Refinement::build(std::size_t trial) const {
  return build(drawn(parts_->reduction, parts_->tolerances, trial), trial);
}

Refined Refinement::build(std::span<const double> siemens, std::size_t trial) const {
  const SeenBuild one = parts_->built(siemens);
  return refined(*parts_, one, trial, one);
}

Refined Refinement::build(std::span<const double> siemens, std::size_t trial,
                          const Answers& answers) const {
  return refined(*parts_, parts_->built(siemens), trial, answers);
}

std::vector<double> Refinement::answer(std::span<const double> siemens,
                                       std::span<const double> sent) const {
  check_sent(*parts_, sent);
  return parts_->built(siemens)(sent);
}

Circuit Refinement::circuit(std::span<const double> siemens, std::span<const double> sent,
                            double size) const {
  check_sent(*parts_, sent);
  Circuit built = perturbed(parts_->circuit.flat(), siemens);
  for (AmplifierModel& model : built.amplifiers) {
    model.opamp.offset.reset();
    model.opamp.offset_limit.reset();
    model.opamp.bias_current.reset();
    model.opamp.bias_limit.reset();
  }
  if (sent.empty()) return built;
  for (CurrentSource& source : built.sources) {
    source.ampere = 0.0;
    if (source.volts) source.volts = 0.0;
  }
  const std::size_t n = sent.size();
  std::vector<CurrentSource> units;
  for (std::size_t j = 0; j < n; ++j) send(*parts_, j, 1.0, units);
  const std::vector<double> driven = parts_->reduction.right_side(units);
  for (std::size_t j = 0; j < n; ++j)
    send(*parts_, j, size * sent[j] * parts_->unit * parts_->volts / driven[j], built.sources);
  return built;
}

std::vector<double> Refinement::adverse_siemens() const { return adverse_build(*parts_).siemens; }

RefinementTrials Refinement::trials() const {
  const Parts& parts = *parts_;
  const std::size_t cycles = parts.options.cycles;
  RefinementTrials result{.builds = parts.tolerances.trials};
  std::vector<std::vector<double>> errors(cycles);
  std::vector<double> deviations;
  std::vector<double> needed;
  std::vector<double> shown;
  std::vector<double> apart;
  for (std::size_t trial = 0; trial < result.builds; ++trial) {
    const Refined one = build(trial);
    result.stable += one.stable ? 1 : 0;
    deviations.push_back(one.deviation);
    for (std::size_t k = 0; k < cycles; ++k) errors[k].push_back(one.errors[k]);
    const auto there = std::find_if(one.errors.begin(), one.errors.end(),
                                    [&](double error) { return error <= parts.options.accuracy; });
    needed.push_back(
        there != one.errors.end() ? static_cast<double>(there - one.errors.begin()) + 1.0 : never);
    if (!one.stable) {
      shown.push_back(never);
      continue;
    }
    result.first_energy = std::max(result.first_energy, one.energies.front());
    if (one.steps.empty()) continue;
    shown.push_back(one.steps.front());
    apart.push_back(std::abs(one.steps.front() / one.errors.front() - 1.0));
  }
  result.median_deviation = quantile(deviations, 0.5);
  result.worst_deviation = *std::max_element(deviations.begin(), deviations.end());
  result.median_cycles = rank(needed, 0.5);
  result.p95_cycles = rank(needed, 0.95);
  result.self_test = {quantile(shown, 0.95), quantile(shown, 0.5), quantile(apart, 0.95)};

  const AdverseBuild adverse = adverse_build(parts);
  const Refined conspired = build(adverse.siemens);
  result.adverse_deviation = adverse.deviation;
  for (std::size_t k = 0; k < cycles; ++k)
    result.cycles.push_back(quantiles(errors[k], conspired.errors[k]));

  const SeenBuild printed = parts.built(parts.printed);
  result.single_floor = single_floor(parts, printed);
  result.double_floor = double_floor(parts, printed);
  const auto tractions = static_cast<std::size_t>(parts.kernel.cols());
  const auto taxels = static_cast<std::size_t>(parts.kernel.rows());
  // K and K', R, then r'd, d'P d and what moves along d.
  result.cycle_products =
      2 * entries(parts.kernel) + entries(parts.stabiliser) + 3 * tractions + 2 * taxels;
  result.frame_products = taxels * tractions;
  return result;
}

}  // namespace tactile_net
