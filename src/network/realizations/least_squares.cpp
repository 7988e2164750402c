/// @file
/// Residual amplifiers e_i = -rho (K f - g)_i and main amplifiers that hold K'e = rho R f: the
/// fixed point is K'K f + R f = K'g. Takes the readings themselves.
///
/// Conductances are siemens * scale^2 * K/scale, scale = the largest 2-norm of a column of K, and
/// rho * siemens * R: the answer is free of K's unit. The outputs are the main amplifiers'. A
/// reading's voltage comes through a resistor as large as the largest row of K together.
///
/// With a ladder the main amplifiers deliver y, and hold K'e = rho d y. Resistors from +-y to the
/// nodes +-f, between neighbours and to ground make R f = d y of it (ladder.hpp); K's own load is
/// part of what goes to ground. Every main row has the same total conductance, which the proof of
/// T6L asks for; the outputs are the nodes +f.
#include <algorithm>
#include <cmath>
#include <limits>

#include "network/ladder.hpp"
#include "network/realizations/nodes.hpp"
#include "network/realizations/traits.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

/// A resistor that makes up what is missing to ground, if that is more than rounding.
void fill_up(Circuit& circuit, std::string name, Node node, double wanted, double present) {
  const double missing = wanted - present;
  if (missing > 100.0 * std::numeric_limits<double>::epsilon() * wanted)
    circuit.resistors.push_back({std::move(name), node, 0, missing});
}

/// The nodes of the tractions, fed by the main amplifiers `y`.
class LadderNodes {
 public:
  /// @param siemens  per unit of K
  LadderNodes(const NetworkProblem& problem, double siemens) : problem_(problem) {
    const Matrix& k = problem.kernel;
    positive_.resize(k.columns);
    negative_.resize(k.columns);
    for (std::size_t i = 0; i < k.rows; ++i)
      for (std::size_t j = 0; j < k.columns; ++j)
        (k(i, j) > 0.0 ? positive_ : negative_)[j] += siemens * std::abs(k(i, j));
    std::vector<double> loads;
    for (std::size_t j = 0; j < k.columns; ++j)
      loads.push_back(std::max(positive_[j], negative_[j]));
    nodes_ = ladder_of(problem.stabiliser, loads);
  }

  /// Adds the nodes and their resistors; returns where K's columns are taken from.
  [[nodiscard]] std::vector<Signed> add(Circuit& circuit, const std::vector<Signed>& y,
                                        const RealizationOptions& options) const {
    std::vector<Signed> f;
    for (std::size_t j = 0; j < nodes_.size(); ++j) {
      const std::string index = std::to_string(j);
      f.push_back({0, add_node(circuit, "n" + index), add_node(circuit, "r" + index)});
      circuit.outputs.push_back(f[j].plus);
      circuit.resistors.push_back({"Rs" + index + 'p', y[j].plus, f[j].plus, nodes_[j].feed});
      circuit.resistors.push_back({"Rs" + index + 'n', y[j].minus, f[j].minus, nodes_[j].feed});
      fill_up(circuit, "Rg" + index + 'p', f[j].plus, nodes_[j].to_ground, positive_[j]);
      fill_up(circuit, "Rg" + index + 'n', f[j].minus, nodes_[j].to_ground, negative_[j]);
      if (options.node_capacitance) {
        circuit.capacitors.push_back({"C" + index + 'p', f[j].plus, 0, *options.node_capacitance});
        circuit.capacitors.push_back({"C" + index + 'n', f[j].minus, 0, *options.node_capacitance});
      }
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      for (std::size_t j = i + 1; j < nodes_.size(); ++j) {
        if (problem_.stabiliser(i, j) == 0.0) continue;
        const std::string pair = "Rs" + std::to_string(i) + '_' + std::to_string(j);
        const double segment = nodes_[i].feed * (-problem_.stabiliser(i, j) / nodes_[i].d);
        circuit.resistors.push_back({pair + 'p', f[i].plus, f[j].plus, segment});
        circuit.resistors.push_back({pair + 'n', f[i].minus, f[j].minus, segment});
      }
    return f;
  }

  /// The main amplifiers' feedback, and what makes the totals of a block's rows equal.
  void close(Circuit& circuit, const std::vector<Signed>& y, double stabiliser_siemens) const {
    std::vector<double> largest(nodes_.size());
    for (std::size_t j = 0; j < nodes_.size(); ++j) {
      double& of_block = largest[nodes_[j].block];
      of_block = std::max(of_block, positive_[j] + negative_[j]);
    }
    for (std::size_t j = 0; j < nodes_.size(); ++j) {
      const std::string index = std::to_string(j);
      circuit.resistors.push_back(
          {"Rs" + index, y[j].plus, y[j].summing, stabiliser_siemens * nodes_[j].d});
      fill_up(circuit, "Rg" + index, y[j].summing, largest[nodes_[j].block],
              positive_[j] + negative_[j]);
    }
  }

 private:
  const NetworkProblem& problem_;
  std::vector<double> positive_, negative_;  // K's load on +f and -f [S]
  std::vector<LadderNode> nodes_;
};

Circuit least_squares_circuit(const NetworkProblem& problem, const RealizationOptions& options) {
  check(options);
  const Matrix& k = problem.kernel;
  const double scale = as_eigen(k).colwise().norm().maxCoeff();
  if (!(scale > 0.0)) throw std::invalid_argument("K must not be zero");
  const double siemens = options.scale.siemens * scale * scale;  // per unit of K / scale
  const double rho = options.residual_gain;
  const double stabiliser_siemens = rho * options.scale.siemens;  // per unit of R

  Circuit circuit;
  circuit.divider = options.divider;
  const std::string main = add_models(circuit, Realization::least_squares, options);
  const std::string others = circuit.amplifiers.front().name;
  std::vector<Signed> y;
  for (std::size_t j = 0; j < k.columns; ++j) {
    const std::string index = std::to_string(j);
    y.push_back(add_amplifier(circuit, "s" + index, (options.ladder ? "y" : "n") + index,
                              (options.ladder ? "z" : "r") + index, main, options.inverters));
    if (!options.ladder) circuit.outputs.push_back(y[j].plus);
  }
  std::optional<LadderNodes> ladder;
  if (options.ladder) ladder.emplace(problem, siemens / scale);
  const std::vector<Signed> f = ladder ? ladder->add(circuit, y, options) : y;
  std::vector<Signed> e;
  for (std::size_t i = 0; i < k.rows; ++i) {
    const auto row = k.row(i);
    if (std::all_of(row.begin(), row.end(), [](double value) { return value == 0.0; })) {
      e.push_back({});  // a dead taxel has no residual
      continue;
    }
    const std::string index = std::to_string(i);
    e.push_back(
        add_amplifier(circuit, "t" + index, "e" + index, "q" + index, others, options.inverters));
  }

  const double input =
      options.inputs == Inputs::voltage ? siemens * (largest_row_sum(k) / scale) : 0.0;
  for (std::size_t i = 0; i < k.rows; ++i) {
    if (e[i].summing == 0) continue;
    const std::string row = std::to_string(i);
    for (std::size_t j = 0; j < k.columns; ++j) {
      const std::string pair = row + "_" + std::to_string(j);
      const double conductance = siemens * (k(i, j) / scale);
      add_signed(circuit, "Rk" + pair, f[j], e[i].summing, conductance);
      add_signed(circuit, "Rt" + pair, e[i], y[j].summing, -conductance);
    }
    circuit.resistors.push_back({"Re" + row, e[i].plus, e[i].summing, siemens / rho});
    add_reading(circuit, row, e[i].summing,
                0.0 - siemens * options.scale.volts * (problem.readings[i] / scale), input);
  }
  if (ladder) {
    ladder->close(circuit, y, stabiliser_siemens);
    return circuit;
  }
  for (std::size_t i = 0; i < k.columns; ++i)
    for (std::size_t j = 0; j < k.columns; ++j)
      add_signed(circuit, "Rs" + std::to_string(i) + "_" + std::to_string(j), f[j], f[i].summing,
                 stabiliser_siemens * problem.stabiliser(i, j));
  return circuit;
}

constexpr TheoremCondition least_squares_conditions[] = {
    TheoremCondition::definite, TheoremCondition::lag_within_bound,
    TheoremCondition::no_resistor_capacitance, TheoremCondition::no_output_resistance};
constexpr TheoremCondition least_squares_conditions_with_ladder[] = {
    TheoremCondition::definite, TheoremCondition::one_lag, TheoremCondition::lag_within_bound,
    TheoremCondition::no_resistor_capacitance, TheoremCondition::no_output_resistance};
constexpr TheoremCondition least_squares_conditions_with_inverters[] = {
    TheoremCondition::main_slow_enough,        TheoremCondition::definite,
    TheoremCondition::no_input_capacitance,    TheoremCondition::no_second_pole,
    TheoremCondition::no_resistor_capacitance, TheoremCondition::no_output_resistance};

}  // namespace

constexpr RealizationTraits least_squares_traits{
    .realization = Realization::least_squares,
    .uses_opamps = true,
    .drives_nodes = true,
    .takes_readings = true,
    .theorem =
        {"T6",
         "Complementary outputs: stable for every gain rho and any bandwidths, and for a lag of "
         "summing nodes and second poles within its bound.",
         least_squares_conditions},
    .theorem_with_inverters =
        {"T4",
         "Main op-amps slow enough: stable. How slow is not proven; 0.2/rho of "
         "the others' bandwidth is a rule of thumb.",
         least_squares_conditions_with_inverters},
    .theorem_with_ladder =
        {"T6L",
         "Complementary outputs, one bandwidth of the main amplifiers and one of the residuals': "
         "stable for every gain rho, and for a lag of summing nodes and second poles, or of the "
         "ladder's nodes, within its bound.",
         least_squares_conditions_with_ladder},
    .bandwidth_ratio =
        [](const RealizationOptions& options) { return 0.2 / options.residual_gain; },
    .build = least_squares_circuit};

}  // namespace tactile_net
